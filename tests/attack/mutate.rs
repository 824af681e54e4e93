//! Mutations: of a design by its structure and by its text, of tables and journals by their bytes, of flags.

use fastrand::Rng;
use toml_edit::{DocumentMut, Item, TableLike, Value};

/// What stands in place of a number.
const NUMBERS: &[&str] = &[
    "0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "1.0",
    "-1.5",
    "2",
    "3",
    "1e-30",
    "1e-12",
    "1e-6",
    "1e-3",
    "1e3",
    "1e6",
    "1e12",
    "1e15",
    "-1e15",
    "1e308",
    "1e999",
    "5e-324",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "99999999999999999999",
    "0x10",
    "1_000",
    "true",
    "\"6.0\"",
    "[]",
    "{}",
    "1979-05-27",
    "0.3333333333333333",
    "1e-9",
    "100",
    "0.5",
];
/// What stands in place of a text.
const TEXTS: &[&str] = &[
    "\"\"",
    "\" \"",
    "\"x\"",
    "\"high-6\"",
    "\"\\u001b[31mred\"",
    "\"\\u009b31m\"",
    "\"a\\nb\"",
    "\"a\\tb\"",
    "\"\\u0000\"",
    "\"=1+1\"",
    "\"@x\"",
    "\"<script>alert(1)</script>\"",
    "\"]]>-->\"",
    "\"\u{202e}drehum\"",
    "\"Größe 🦀\"",
    "\"a,b\"",
    "\"a\\\"b'c\"",
    "\"../x\"",
    "\"slice\"",
    "\"elastic\"",
    "\"hertz\"",
    "\"overrun\"",
    "\"static\"",
    "\"transient\"",
    "\"engagement\"",
    "\"torsional-excitation\"",
    "\"vernay\"",
    "\"torque-capacity\"",
    "\"r_i1_mm\"",
    "\"junction_1_rad\"",
    "\"no-such.csv\"",
    "\"design.toml\"",
    "\"sub\"",
    "\"data.csv\"",
    "7",
];
/// Options of a design that the files at hand do not all use: table, key, value.
const GRAFTS: &[(&str, &str, &str)] = &[
    ("contact", "law", "\"slice\""),
    ("contact", "law", "\"hertz\""),
    ("contact", "law", "\"elastic\""),
    ("contact", "law", "\"din26281\""),
    ("contact", "slices", "10"),
    ("contact", "tilt_mrad", "1.0"),
    ("contact", "tilt_mrad", "100.0"),
    ("contact", "axial_offset_mm", "0.5"),
    ("contact", "hunt_crossley_s_per_m", "0.2"),
    ("contact", "end_profile", "{ kind = \"lundberg\", design_load_n = 1000.0 }"),
    ("contact", "end_profile", "{ kind = \"crown\", radius_mm = 500.0 }"),
    ("contact", "end_profile", "{ kind = \"end-relief\", length_mm = 1.0, radius_mm = 50.0 }"),
    ("races", "eccentricity", "{ offset_mm = 0.01 }"),
    ("races", "eccentricity", "{ offset_mm = 0.02, turning = true, bearing_stiffness_n_per_um = 200.0 }"),
    ("races", "press_fit", "{ inner_interference_um = 10.0 }"),
    ("races", "press_fit", "{ outer_interference_um = 10.0, housing_outside_radius_mm = 90.0 }"),
    ("material", "expansion_um_per_m_k", "12.0"),
    ("", "thermal", "{ inner_race_c = 90.0, outer_race_c = 60.0, sprags_c = 80.0 }"),
    ("", "tolerances", "{ inner_race_radius_mm = 0.003, sprag_inner_radius_mm = 0.002, friction = 0.01 }"),
    ("limits", "body_yield_mpa", "1500.0"),
    ("limits", "lift_off_by_rpm", "9000.0"),
    ("limits", "keep_contact_to_rpm", "3000.0"),
    ("limits", "slip_margin", "0.9"),
    ("limits", "from_material", "true"),
    ("friction", "model", "\"vernay\""),
    ("friction", "decay_s_per_m", "0.0"),
    ("friction", "static", "0.5"),
    ("spring", "stiffness_nm_per_rad", "0.0"),
    ("sprags", "count", "3"),
    ("races", "inner_bore_radius_mm", "0.0"),
    ("optimize", "objective", "\"torque-capacity\""),
    ("optimize", "objective", "\"overrun-speed\""),
];
/// What is put between two characters of a text.
const WILD: &[&str] = &[
    "\u{0}",
    "\u{feff}",
    "\u{1b}[2J",
    "\"",
    "'",
    "=",
    "[",
    "]",
    "{",
    "}",
    ",",
    "#",
    "-",
    ".",
    "e",
    "9",
    "\n",
    "\r\n",
    "\u{e9}",
    "\u{202e}",
    "🦀",
    "\\",
    "\\u001b",
    "[[scenarios]]\n",
    "[sprags]\n",
    ";",
    "\t",
    "nan",
];
/// Values of flags.
const WORDS: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "1e-300",
    "1e-9",
    "1e9",
    "1e300",
    "",
    " ",
    "x",
    "1,2,3",
    "1,,2",
    ",",
    "٣",
    "0x10",
    "18446744073709551616",
    "4294967296",
    "-0",
    "1e-5",
    "\u{1b}[31m",
    "a\nb",
    "--json",
    "=1",
    "0.1",
    "100",
    "🦀",
];

/// One of a list.
pub fn one<'a>(list: &[&'a str], rng: &mut Rng) -> &'a str {
    list[rng.usize(..list.len())]
}

/// A value of a flag.
pub fn word(rng: &mut Rng) -> String {
    one(WORDS, rng).to_owned()
}

/// A design with one thing changed, mildly so that most such designs are accepted; where it is no TOML already, its text.
pub fn design(text: &str, mild: bool, rng: &mut Rng) -> String {
    let Ok(mut file) = text.parse::<DocumentMut>() else { return string(text, rng) };
    let graft = rng.u8(..3) == 0;
    match if mild { if graft { 13 } else { 0 } } else { rng.u8(..16) } {
        0..8 => on_value(
            file.as_item_mut(),
            rng,
            |v| v.is_float() || v.is_integer(),
            |v, rng| {
                let old = v.as_float().or(v.as_integer().map(|i| i as f64)).unwrap_or(1.0);
                let factor =
                    [0.0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999, 1.0001, 1.001, 1.01, 1.1, 1.5, 2.0, 10.0]
                        [rng.usize(..14)];
                *v = if v.is_integer() {
                    Value::from((old * factor) as i64)
                } else {
                    Value::from(old * factor)
                };
            },
        ),
        8 | 9 => on_value(
            file.as_item_mut(),
            rng,
            |v| v.is_float() || v.is_integer(),
            |v, rng| {
                *v = one(NUMBERS, rng).parse().unwrap_or(Value::from(f64::INFINITY));
            },
        ),
        10 => {
            on_value(file.as_item_mut(), rng, Value::is_str, |v, rng| *v = one(TEXTS, rng).parse().unwrap())
        }
        11 => on_value(
            file.as_item_mut(),
            rng,
            |v| v.is_array(),
            |v, rng| {
                let array = v.as_array_mut().unwrap();
                if array.is_empty() {
                    return;
                }
                let (from, to) = (rng.usize(..array.len()), rng.usize(..array.len()));
                let value = array.get(from).unwrap().clone();
                match rng.u8(..4) {
                    0 => drop(array.remove(from)),
                    1 => array.push_formatted(value),
                    2 => (0..40).for_each(|_| array.push_formatted(value.clone())),
                    _ => drop(array.replace_formatted(to, value)),
                }
            },
        ),
        12 => remove_key(&mut file, rng),
        13..15 => {
            let (table, key, value) = GRAFTS[rng.usize(..GRAFTS.len())];
            let value: Value = value.parse().unwrap();
            let place = if table.is_empty() {
                Some(file.as_table_mut())
            } else {
                file.get_mut(table).and_then(Item::as_table_mut)
            };
            if let Some(place) = place {
                place.insert(key, Item::Value(value));
            }
        }
        _ => return string(text, rng),
    }
    file.to_string()
}

/// Change one of the values that `fits`.
fn on_value(root: &mut Item, rng: &mut Rng, fits: fn(&Value) -> bool, change: fn(&mut Value, &mut Rng)) {
    let mut count = 0;
    each_value(root, &mut |v| count += usize::from(fits(v)));
    if count == 0 {
        return;
    }
    let mut until = rng.usize(..count) as isize;
    each_value(root, &mut |v| {
        if fits(v) {
            if until == 0 {
                let decor = v.decor().clone();
                change(v, rng);
                *v.decor_mut() = decor;
            }
            until -= 1;
        }
    });
}

fn each_value(item: &mut Item, act: &mut dyn FnMut(&mut Value)) {
    match item {
        Item::None => {}
        Item::Value(value) => each_within(value, act),
        Item::Table(table) => table.iter_mut().for_each(|(_, item)| each_value(item, act)),
        Item::ArrayOfTables(tables) => {
            tables.iter_mut().for_each(|table| table.iter_mut().for_each(|(_, item)| each_value(item, act)));
        }
    }
}

fn each_within(value: &mut Value, act: &mut dyn FnMut(&mut Value)) {
    match value {
        Value::Array(array) => array.iter_mut().for_each(|v| each_within(v, act)),
        Value::InlineTable(table) => table.iter_mut().for_each(|(_, v)| each_within(v, act)),
        _ => {}
    }
    act(value);
}

/// Take a key out of one of the tables, or a whole table.
fn remove_key(file: &mut DocumentMut, rng: &mut Rng) {
    let tables: Vec<String> = file.iter().map(|(key, _)| key.to_owned()).collect();
    let name = &tables[rng.usize(..tables.len())];
    let remove = |table: &mut dyn TableLike, rng: &mut Rng| {
        let keys: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
        if !keys.is_empty() {
            table.remove(&keys[rng.usize(..keys.len())]);
        }
    };
    match file.get_mut(name) {
        Some(Item::Table(table)) if rng.u8(..5) > 0 => remove(table, rng),
        Some(Item::ArrayOfTables(tables)) => {
            let at = rng.usize(..tables.len());
            remove(tables.get_mut(at).unwrap(), rng);
        }
        _ => drop(file.remove(name)),
    }
}

/// A text with one thing changed.
pub fn string(text: &str, rng: &mut Rng) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    if lines.is_empty() {
        return one(WILD, rng).to_owned();
    }
    let (a, b) = (rng.usize(..lines.len()), rng.usize(..lines.len()));
    let mut at = rng.usize(..=text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    match rng.u8(..8) {
        0 => text[..at].to_owned(),
        1 => [&lines[..a], &lines[a + 1..]].concat().concat(),
        2 => [&lines[..a], &lines[b..=b], &lines[a..]].concat().concat(),
        3 => {
            let mut lines = lines.clone();
            lines.swap(a, b);
            lines.concat()
        }
        4 => text.replace('\n', "\r\n"),
        5 => format!("\u{feff}{text}"),
        _ => [&text[..at], one(WILD, rng), &text[at..]].concat(),
    }
}

/// Numbers of a table, line or data file: one of them changed, or its bytes.
pub fn table(text: &str, rng: &mut Rng) -> Vec<u8> {
    let cells: Vec<(usize, &str)> = text
        .match_indices(|c: char| c.is_ascii_digit() || "+-.e".contains(c))
        .map(|(at, _)| at)
        .filter(|&at| at == 0 || b",\n [".contains(&text.as_bytes()[at - 1]))
        .map(|at| (at, &text[at..at + text[at..].find([',', '\n', ']']).unwrap_or(text.len() - at)]))
        .filter(|(_, cell)| cell.parse::<f64>().is_ok())
        .collect();
    if cells.is_empty() || rng.u8(..3) == 0 {
        return bytes(text.as_bytes(), rng);
    }
    let (at, cell) = cells[rng.usize(..cells.len())];
    [&text[..at], one(NUMBERS, rng), &text[at + cell.len()..]].concat().into_bytes()
}

/// Bytes with something changed: cut, flipped, doubled, foreign, of another version.
pub fn bytes(bytes: &[u8], rng: &mut Rng) -> Vec<u8> {
    if bytes.is_empty() {
        return b"\xff\x00".to_vec();
    }
    let at = rng.usize(..bytes.len());
    let mut out = bytes.to_vec();
    match rng.u8(..9) {
        0 => out.truncate(at),
        1 => out[at] ^= 1 << rng.u8(..8),
        2 => out[at] = rng.u8(..),
        3 => out.extend_from_slice(bytes),
        4 => out.extend_from_slice(&bytes[..at]),
        5 => out = b"Dear Sir,\nthis is a letter; K\xe4fig\nand its last line".to_vec(),
        6 => return String::from_utf8_lossy(bytes).replace("0.1.0", "0.0.9").into_bytes(),
        7 => drop(out.drain(at..(at + 40).min(bytes.len()))),
        _ => return string(&String::from_utf8_lossy(bytes), rng).into_bytes(),
    }
    out
}
