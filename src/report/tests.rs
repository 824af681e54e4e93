//! The pieces together: what holds for a page must hold with plots and drawings in it.

use super::*;

fn full_page() -> String {
    let drawing = drawing::tests::table_1(0.05);
    let mut table = Table::facts();
    table.row(vec!["Bad number".into(), Cell::In(f64::NAN, Unit::Megapascal)]);
    let mut page = Page::new(PageHead {
        title: "Margin check".into(),
        tool: "sprag-design".into(),
        version: "0.0.0".into(),
        command: "sprag-design check a.toml".into(),
        design: "Table 1".into(),
        design_hash: "00".into(),
    });
    page.figure(&drawing.detail_figure(), "One sprag").table("Facts", &table);
    page.figures(&[(drawing.small_svg(0.03), "All"), (drawing.centres_figure(), "Centres")]);
    let plot = Plot::new("x", "y").curve("a", vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, 1.5], [3.0, 2.0]]);
    page.figure(&plot.to_figure(), "").figure(&plot.to_figure(), "the same again");
    page.results("results", &serde_json::json!({ "x": 1 }));
    page.to_html()
}

#[test]
fn a_full_page_fetches_nothing_runs_nothing_and_repeats_no_id() {
    let html = full_page();
    let without_namespace = html.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    for bad in ["http:", "https:", "//", "src=", "href=", "@import", "url(", "<link", "<script>", "NaN"] {
        assert!(!without_namespace.contains(bad), "{bad}");
    }
    assert_eq!(html.matches(" id=").count(), 1);
}

#[test]
fn elements_are_closed() {
    let html = full_page();
    for name in
        ["svg", "figure", "table", "div", "p", "text", "script", "style", "main", "tr", "td", "th", "g"]
    {
        let open = html.matches(&format!("<{name}>")).count() + html.matches(&format!("<{name} ")).count();
        assert_eq!(open, html.matches(&format!("</{name}>")).count(), "{name}");
    }
}

#[test]
fn backticks_are_code_on_a_page_and_one_alone_stays() {
    let head = PageHead {
        title: String::new(),
        tool: String::new(),
        version: String::new(),
        command: String::new(),
        design: String::new(),
        design_hash: String::new(),
    };
    let mut page = Page::new(head);
    page.paragraph("ask `explain <name>` or ` alone");
    assert!(page.to_html().contains("ask <code>explain &lt;name&gt;</code> or ` alone"));
}
