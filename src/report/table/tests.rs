//! Tables on paper, on screens of a width, as CSV, JSON and HTML.

use super::*;

fn margins() -> Table {
    let mut table = Table::new(vec![
        Column::text("name", "Limit"),
        Column::number("demand", "Demand", Unit::One, 4),
        Column::number("margin", "Margin", Unit::Percent, 3),
        Column::text("verdict", "Verdict"),
    ]);
    table.row(vec![
        "Hertz, nominal".into(),
        Cell::In(3.91e9, Unit::Megapascal),
        0.0742.into(),
        Cell::Verdict(true, "held".into()),
    ]);
    table.row(vec![
        "Hoop <outer>, \"mean\"".into(),
        Cell::In(7.6e8, Unit::Megapascal),
        (-0.013).into(),
        Cell::Verdict(false, "broken".into()),
    ]);
    table
}

#[test]
fn text_columns_line_up_and_end_without_blanks() {
    let text = margins().to_text(Screen::default());
    let lines: Vec<Vec<char>> = text.lines().map(|l| l.chars().collect()).collect();
    assert_eq!(
        text,
        "Limit                    Demand  Margin, %  Verdict\n\
                      ────────────────────  ─────────  ─────────  ───────\n\
                      Hertz, nominal         3910 MPa       7.42  held\n\
                      Hoop <outer>, \"mean\"  760.0 MPa      −1.30  broken\n"
    );
    assert!(lines.iter().all(|l| l.last() != Some(&' ')));
}

#[test]
fn colour_adds_nothing_but_escape_codes() {
    let table = margins();
    let painted = table.to_text(Screen { colour: true, columns: None });
    assert_ne!(painted, table.to_text(Screen::default()));
    let plain = ["\u{1b}[32m", "\u{1b}[31m", "\u{1b}[0m"].iter().fold(painted, |s, code| s.replace(code, ""));
    assert_eq!(plain, table.to_text(Screen::default()));
}

#[test]
fn a_narrow_screen_gets_every_column_below_one_another() {
    let at = |columns: usize| margins().to_text(Screen { colour: false, columns: Some(columns) });
    let text = at(45);
    assert_eq!(
        text,
        "                                 Margin,\n\
                      Limit                    Demand        %\n\
                      ────────────────────  ─────────  ───────\n\
                      Hertz, nominal         3910 MPa     7.42\n\
                      Hoop <outer>, \"mean\"  760.0 MPa    −1.30\n\
                      \n\
                      Limit                 Verdict\n\
                      ────────────────────  ───────\n\
                      Hertz, nominal        held\n\
                      Hoop <outer>, \"mean\"  broken\n"
    );
    // What two columns tell stands beside what follows below.
    let two = Table { lead: 2, ..margins() }.to_text(Screen { colour: false, columns: Some(45) });
    assert!(two.contains("Limit                    Demand  Verdict\n"), "{two}");
    // Nothing is lost where not even two columns fit, nor where the whole table does.
    let narrow = at(5);
    assert!(["Demand", "Margin,", "Verdict", "broken"].iter().all(|word| narrow.contains(word)));
    assert_eq!(at(51), margins().to_text(Screen::default()));
    assert!(at(50) != at(51));
    // Three characters less than they take with folded headings: closer.
    let closer = at(46);
    assert!(closer.contains("\nLimit                   Demand       % Verdict\n"), "{closer}");
    assert_eq!(closer.matches("Limit").count(), 1);
}

#[test]
fn keys_break_between_their_parts_alone() {
    assert_eq!(breakable("sprags.inner_arcs[0].r_mm"), "sprags.<wbr>inner_<wbr>arcs[0].<wbr>r_<wbr>mm");
    assert_eq!(breakable("0.4076 rad, e. g. &amp;_"), "0.4076 rad, e. g. &amp;_");
}

#[test]
fn a_row_longer_than_the_columns_loses_nothing() {
    let mut table = Table::new(vec![Column::text("name", "Limit")]);
    table.row(vec!["a".into(), 2.5.into()]);
    assert!(table.to_text(Screen::default()).contains("2"));
    assert_eq!(String::from_utf8(table.to_csv().unwrap()).unwrap(), "name,column_2\na,2.5\n");
}

#[test]
fn csv_quotes_and_keeps_every_digit() {
    let mut table = margins();
    table.row(vec!["short row".into()]);
    let bytes = table.to_csv().unwrap();
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    assert_eq!(reader.headers().unwrap(), vec!["name", "demand", "margin", "verdict"]);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(&rows[1][0], "Hoop <outer>, \"mean\"");
    assert_eq!(rows[1][2].parse::<f64>().unwrap(), -0.013 * 100.0);
    assert_eq!(&rows[2], &csv::StringRecord::from(vec!["short row", "", "", ""]));
}

#[test]
fn no_text_is_a_formula_to_a_spreadsheet() {
    let mut table = Table::new(vec![Column::text("name", "Name"), Column::text("value", "Value")]);
    for text in ["=1+1", "+a", "-a", "@a", "\ta", "a=1", "-1.5"] {
        table.row(vec![text.into(), (-2.5).into()]);
    }
    let csv = String::from_utf8(table.to_csv().unwrap()).unwrap();
    let wanted = "name,value\n'=1+1,-2.5\n'+a,-2.5\n'-a,-2.5\n'@a,-2.5\n'\ta,-2.5\na=1,-2.5\n-1.5,-2.5\n";
    assert_eq!(csv, wanted);
}

#[test]
fn json_has_the_keys_and_numbers_of_csv_and_what_it_alone_has() {
    let rows = || {
        Rows::of([("a", 0.25, true), ("b", f64::NAN, false)])
            .text("name", "Name", |(name, ..)| *name)
            .number("margin", "Margin", Unit::One, 3, |(_, margin, _)| *margin)
            .shown_in(Unit::Percent)
            .number("gap_mm", "Gap", Unit::Millimetre, 3, |(_, _, on)| Cell::only_if(*on, 2e-3))
            .hidden("held", Unit::One, |(.., held)| *held)
            .json_in("gap_um", Unit::Micrometre, |(_, _, on)| on.then_some(2e-3))
    };
    let table = rows().table();
    let csv = String::from_utf8(table.to_csv().unwrap()).unwrap();
    assert_eq!(csv, "name,margin,gap_mm,held\na,0.25,2,true\nb,,2,false\n");
    let wanted = json!([
        { "name": "a", "margin": 0.25, "gap_mm": 2.0, "held": true, "gap_um": 2000.0 },
        { "name": "b", "margin": null, "gap_mm": 2.0, "held": false, "gap_um": null },
    ]);
    assert_eq!(json!(rows().objects()), wanted);
    assert_eq!(rows().object(), wanted[0]);
    let text = table.to_text(Screen::default());
    assert_eq!(text.lines().next(), Some("Name  Margin, %  Gap, mm"), "{text}");
    assert_eq!(text.lines().last(), Some("b             –        –"), "{text}");
}

#[test]
fn no_nan_reaches_a_reader() {
    let mut table = Table::new(vec![Column::number("x_m", "x", Unit::Millimetre, 3)]);
    table.row(vec![f64::NAN.into()]).row(vec![None::<f64>.into()]);
    let all = table.to_text(Screen::default())
        + &table.to_html()
        + &String::from_utf8(table.to_csv().unwrap()).unwrap();
    assert!(!all.contains("NaN"), "{all}");
}

#[test]
fn html_is_escaped() {
    let html = margins().to_html();
    assert!(html.contains("Hoop &lt;outer&gt;, &quot;mean&quot;"), "{html}");
    assert!(html.contains("<td class=\"broken\">broken</td>"));
}

#[test]
fn on_a_page_margin_and_verdict_stand_behind_the_name() {
    let mut table = Table::new(vec![
        Column::text("code", "Limit"),
        Column::number("demand", "Demand", Unit::One, 4),
        Column::number("margin", "Margin", Unit::Percent, 3),
        Column::text("verdict", "Verdict"),
    ]);
    table.row(vec!["hoop".into(), Cell::Count(3), Cell::Count(4), Cell::Verdict(true, "held".into())]);
    let html = table.to_html();
    let at = |word: &str| html.find(&format!(">{word}")).unwrap();
    assert!(
        at("Limit") < at("Verdict") && at("Verdict") < at("Margin") && at("Margin") < at("Demand"),
        "{html}"
    );
    assert!(at("hoop") < at("held") && at("held") < at("4<") && at("4<") < at("3<"), "{html}");
    // In the terminal a line is read to its end.
    let text = table.to_text(Screen::default());
    assert!(text.find("Demand").unwrap() < text.find("Verdict").unwrap());
}
