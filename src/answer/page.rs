//! What the pages of all answers share: head, drawings of a clutch, the inputs.

use super::{TOOL, VERSION};
use crate::design::Design;
use crate::file::{Input, inputs, unit_of_key};
use crate::profile::Profile;
use crate::report::{Cell, Column, Drawing, Page, PageHead, Plot, Rows, SpragPose, Table, Unit};
use crate::wedge::{Closure, WedgeCurve};

/// A page with its head; `title` names the kind of answer, e.g. `"Margin check"`, `command` who asked for it.
pub fn begun(title: &str, design: &Design, command: &str) -> Page {
    Page::new(PageHead {
        title: title.to_owned(),
        tool: TOOL.to_owned(),
        version: VERSION.to_owned(),
        command: command.to_owned(),
        design: design.name.clone(),
        design_hash: design.hash.clone(),
    })
}

/// The sprag of `design` at first contact at rest.
pub fn pose_at_rest(label: &str, design: &Design, profile: &Profile) -> SpragPose {
    SpragPose::at_rest(label, &design.clutch, profile)
}

/// The same sprag under load, as the equilibrium `state` (of [`WedgeCurve::closure_at_torque`]) has it.
pub fn pose_loaded(label: &str, at_rest: &SpragPose, state: &Closure) -> SpragPose {
    at_rest.clone().moved(label, state.rotation.v, state.lengths.oc_e.v)
}

/// The same sprag at `torque_nm`, N m, or at the curve's end where that comes first; none where neither has
/// an equilibrium. The label names the torque.
pub fn pose_at_torque(at_rest: &SpragPose, curve: &WedgeCurve, torque_nm: f64) -> Option<SpragPose> {
    let end = curve.end_torque_nm();
    let (torque, tail) = if torque_nm <= end { (torque_nm, "") } else { (end, ", end of the curve") };
    let last = curve.arc_end_n(curve.arc_count() - 1);
    let (_, state) = curve.closure_at_torque(torque).or_else(|| curve.closure_at_normal(last))?;
    let label = format!("at {}{tail}", Unit::NewtonMetre.show_plain(torque, 4));
    Some(pose_loaded(&label, at_rest, &state))
}

/// The races of `design` with `poses` of its sprags (the first in full, the others dashed over it).
pub fn drawing(design: &Design, poses: Vec<SpragPose>) -> Drawing {
    Drawing::of(&design.clutch, poses)
}

/// Below the drawing of the points of a sprag.
pub const CENTRES: &str =
    "Arc centres, centroid (G) and, where a cage holds the sprags, pivot (P) in the body frame (origin Cₑ).";

/// Section of a page with drawings to scale: one sprag in its poses, its arc centres.
pub fn draw(page: &mut Page, drawing: &Drawing) {
    page.heading("Geometry");
    let caption = if drawing.poses.len() > 1 {
        "One sprag between its races, to scale. The races are drawn without load: a loaded sprag overlaps them by \
         what yields."
    } else {
        "One sprag between its races, to scale."
    };
    page.drawings(&[(drawing.detail_figure(), caption), (drawing.centres_figure(), CENTRES)]);
}

/// A page that opens with `answer`, its banner and what belongs to that, and the dimensioned drawing: both in the first screen.
pub fn opened(title: &str, design: &Design, command: &str, answer: impl FnOnce(&mut Page)) -> Page {
    let mut page = begun(title, design, command);
    answer(&mut page);
    draw_sheet(&mut page, design, "");
    page
}

/// The dimensioned drawing: clutch, section, one sprag, masses. `whose`: of which of several designs.
pub fn draw_sheet(page: &mut Page, design: &Design, whose: &str) {
    let Ok(profile) = design.clutch.profile() else { return };
    let (s, r) = (&design.clutch.sprags, &design.clutch.races);
    let mm = |m: f64| Unit::Millimetre.show_plain(m, 6);
    let gram = |kg: f64| Unit::Gram.show(kg, 4);
    let [sprags, inner, outer] = design.clutch.masses_kg();
    let notes = [
        format!("{} sprags {} long,", s.count, mm(s.length_m)),
        format!("races {} wide,", mm(r.width_m)),
        format!("mass {}: sprags {},", gram(sprags + inner + outer), gram(sprags)),
        format!("inner race {}, outer race {}", gram(inner), gram(outer)),
    ];
    let rest = pose_at_rest("first contact, no load", design, &profile);
    let svg = drawing(design, vec![rest]).sheet_figure([r.width_m, s.length_m], &notes);
    let said = "Radii as run; inner, outer: the tracks. ν, ω: angles of the strut AB to the radii at B and A; junctions \
        1|2 … and the end by the turn of the contact; lengths in mm; races as plain rings.";
    page.true_figure(&svg, &if whose.is_empty() { said.to_owned() } else { format!("{whose}. {said}") });
}

/// As many columns of the scenes' table fit a page.
const SCENE_COLUMNS: usize = 8;

/// As many scenes stand side by side.
const SCENES_ABREAST: usize = 11;

/// Every value of the design file: a short table for each of its parts, one for the scenes, or one for each where there are too
/// many of them. Of a page about one scene, by its name, that alone.
pub fn draw_inputs(page: &mut Page, design: &Design, about: Option<&str>) {
    let all = inputs(&design.source);
    let (scenes, others): (Vec<&Input>, Vec<&Input>) =
        all.iter().partition(|i| i.path.starts_with("scenarios["));
    let mut tables = short_tables(&others);
    let table = scene_table(&scenes);
    let names = |row: &&Vec<Cell>| matches!((row.first(), about), (Some(Cell::Text(a)), Some(b)) if a == b);
    if let Some(row) = table.rows.iter().find(names) {
        tables.extend(each_scene(&Table { rows: vec![row.clone()], ..table.clone() }));
        page.columns(&tables);
        return;
    }
    page.columns(&tables);
    if scenes.is_empty() {
        return;
    }
    if table.columns.len() <= SCENE_COLUMNS {
        page.table("scenarios", &table);
    } else if table.rows.len() <= SCENES_ABREAST {
        page.table("scenarios", &scenes_abreast(&table));
    } else {
        page.columns(&each_scene(&table));
    }
}

/// A short table for each row of the scenes' table: what it says of that scene.
fn each_scene(scenes: &Table) -> Vec<(String, Table)> {
    let one = |row: &Vec<Cell>| {
        let table =
            Rows::of(scenes.columns.iter().zip(row).skip(1).filter(|(_, cell)| **cell != Cell::Empty))
                .text("key", "Key", |(column, _)| column.heading.as_str())
                .text("value", "Value", |(_, cell)| Cell::clone(cell))
                .table();
        let name = match row.first() {
            Some(Cell::Text(name)) => format!("scenario {name}"),
            _ => "scenario".to_owned(),
        };
        (name, table)
    };
    scenes.rows.iter().map(one).collect()
}

/// The scenes' table with a row for each key and a column for each scene.
fn scenes_abreast(scenes: &Table) -> Table {
    let mut columns = vec![Column::text("key", "scene")];
    columns.extend(scenes.rows.iter().map(|row| match row.first() {
        Some(Cell::Text(name)) => Column::text(name, name),
        _ => Column::text("", ""),
    }));
    let mut table = Table::new(columns);
    for (at, column) in scenes.columns.iter().enumerate().skip(1) {
        let mut cells: Vec<Cell> = vec![column.heading.as_str().into()];
        cells.extend(scenes.rows.iter().map(|row| row.get(at).cloned().unwrap_or(Cell::Empty)));
        table.row(cells);
    }
    table
}

/// A table for each part of the file; a row of a list (arc, variable) in one line.
fn short_tables(inputs: &[&Input]) -> Vec<(String, Table)> {
    let mut tables: Vec<(String, Table)> = Vec::new();
    for input in inputs {
        let path = input.path.as_str();
        let (group, key) = match path.find(['.', '[']) {
            Some(at) => (&path[..at], path[at..].trim_start_matches('.')),
            None => ("design", path),
        };
        if tables.last().is_none_or(|(last, _)| last != group) {
            let columns = vec![Column::text("key", "Key"), Column::text("value", "Value")];
            tables.push((group.to_owned(), Table::new(columns)));
        }
        let Some((_, table)) = tables.last_mut() else { continue };
        let value = if input.unit.is_empty() {
            input.text.clone()
        } else {
            format!("{} {}", input.text, power(input.unit))
        };
        // A row of a list: its name stands in its path already.
        let Some((row, inner)) = key.split_once(']') else {
            table.row(vec![key.into(), value.into()]);
            continue;
        };
        let (row, inner) = (row.replacen('[', " ", 1).trim().to_owned(), inner.trim_start_matches('.'));
        if !matches!(table.rows.last(), Some(cells) if cells.first() == Some(&Cell::Text(row.clone()))) {
            table.row(vec![row.into(), "".into()]);
        }
        if let Some(Cell::Text(text)) =
            table.rows.last_mut().and_then(|cells| cells.get_mut(1)).filter(|_| inner != "name")
        {
            let between = if text.is_empty() { "" } else { "; " };
            text.push_str(&format!("{between}{inner} {value}"));
        }
    }
    tables
}

/// A unit with its powers raised.
fn power(unit: &str) -> String {
    unit.replace("^2", "²").replace("^3", "³")
}

/// A key of a scene in words, its unit behind a comma.
fn words_of_key(key: &str) -> String {
    let endings = ["_nm_per_rad", "_kg_m2", "_nm", "_rpm", "_hz", "_s"];
    let name = endings.iter().find_map(|end| key.strip_suffix(end));
    match (name, unit_of_key(key).filter(|unit| !unit.is_empty())) {
        (Some(name), Some(unit)) => format!("{}, {}", name.replace('_', " "), power(unit)),
        _ => key.replace('_', " "),
    }
}

/// A row for each scene, a column for each key that one of them has.
fn scene_table(inputs: &[&Input]) -> Table {
    let mut table = Table::new(vec![Column::text("name", "scene")]);
    for input in inputs {
        let Some((name, key)) = input.path.trim_start_matches("scenarios[").split_once("].") else {
            continue;
        };
        if key == "name" {
            table.row(vec![name.into()]);
            continue;
        }
        let at = table.columns.iter().position(|c| c.key == key).unwrap_or_else(|| {
            table.columns.push(Column::text(key, &words_of_key(key)));
            table.columns.len() - 1
        });
        if !table.rows.iter().any(|cells| cells.first() == Some(&Cell::Text(name.to_owned()))) {
            table.row(vec![name.into()]);
        }
        if let Some(cells) =
            table.rows.iter_mut().find(|cells| cells.first() == Some(&Cell::Text(name.to_owned())))
        {
            while cells.len() <= at {
                cells.push(Cell::Empty);
            }
            cells[at] = input.text.as_str().into();
        }
    }
    table
}

/// A plot at the size it has beside another on a page, so that its letters keep theirs.
pub fn half(plot: Plot) -> String {
    plot.sized(500.0, 320.0).to_figure()
}
