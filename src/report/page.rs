//! One self-contained HTML page: no script runs, nothing is fetched.

use super::bars::Tone;
use super::table::Table;

const STYLE: &str = include_str!("page.css");

/// What every page says about its origin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PageHead {
    /// Title, e.g. `"Margin check"`.
    pub title: String,
    /// Tool name.
    pub tool: String,
    /// Tool version.
    pub version: String,
    /// The command line that made the page.
    pub command: String,
    /// Name of the design.
    pub design: String,
    /// Hash of the design file, hex.
    pub design_hash: String,
}

/// A page under construction; sections come out in the order in which they went in.
#[derive(Debug, Clone, Default)]
pub struct Page {
    head: PageHead,
    body: String,
}

/// Names of symbols as people read them; parts of longer names (`mu_s.toml`) stay.
pub fn greek(text: &str) -> String {
    const NAMES: [(&str, &str); 8] = [
        ("mu_s", "μs"),
        ("mu_c", "μc"),
        ("gamma_b", "γb"),
        ("tan omega", "tan ω"),
        ("tan nu", "tan ν"),
        ("theta_bi", "θbi"),
        ("theta_be", "θbe"),
        ("(gamma ", "(γ "),
    ];
    NAMES.iter().fold(text.to_owned(), |text, (name, letter)| with_letter(&text, name, letter))
}

fn with_letter(text: &str, name: &str, letter: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once(name) {
        out.push_str(before);
        let joined = |c: char| c.is_alphanumeric() || "_-/\\".contains(c);
        let mut next = behind.chars();
        let goes_on = match next.next() {
            Some('.') => next.next().is_some_and(joined),
            Some(c) => joined(c) && !name.ends_with(' '),
            None => false,
        };
        let is_part = goes_on || out.ends_with(joined) && !name.starts_with('(');
        out.push_str(if is_part { name } else { letter });
        rest = behind;
    }
    out + rest
}

/// Prose with its symbols as people read them, made safe.
fn prose(text: &str) -> String {
    coded(&escape(&greek(text)))
}

/// What stands between backticks as code; one alone stays.
fn coded(escaped: &str) -> String {
    let parts: Vec<&str> = escaped.split('`').collect();
    let pairs = (parts.len() - 1) / 2;
    let mut out = String::with_capacity(escaped.len() + 13 * pairs);
    for (k, part) in parts.iter().enumerate() {
        let mark = match k {
            0 => "",
            _ if k > 2 * pairs => "`",
            _ if k % 2 == 1 => "<code>",
            _ => "</code>",
        };
        out.push_str(mark);
        out.push_str(part);
    }
    out
}

/// Text made safe for HTML content and attributes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            _ => out.push(c),
        }
    }
    out
}

impl Page {
    /// A page with nothing but its head.
    pub fn new(head: PageHead) -> Self {
        Self { head, body: String::new() }
    }

    /// The answer in one line, painted as held or broken.
    pub fn verdict(&mut self, held: bool, text: &str) -> &mut Self {
        self.verdict_in(if held { Tone::Good } else { Tone::Bad }, text)
    }

    /// The answer in one line, painted as held, as broken, as in between, or not at all.
    pub fn verdict_in(&mut self, tone: Tone, text: &str) -> &mut Self {
        let class = match tone {
            Tone::Good => "held",
            Tone::Bad => "broken",
            Tone::Soft => "mixed",
            Tone::Plain => "said",
        };
        self.push(&format!("<p class=\"verdict {class}\">{}</p>\n", prose(text)))
    }

    /// A section heading.
    pub fn heading(&mut self, text: &str) -> &mut Self {
        self.push(&format!("<h2>{}</h2>\n", prose(text)))
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: &str) -> &mut Self {
        self.push(&format!("<p>{}</p>\n", prose(text)))
    }

    /// A bulleted list; nothing where it is empty.
    pub fn list<S: AsRef<str>>(&mut self, items: impl IntoIterator<Item = S>) -> &mut Self {
        let items = items.into_iter().map(|item| format!("<li>{}</li>\n", prose(item.as_ref())));
        match items.collect::<String>() {
            items if items.is_empty() => self,
            items => self.push(&format!("<ul>\n{items}</ul>\n")),
        }
    }

    /// A table with its caption (empty: none).
    pub fn table(&mut self, caption: &str, table: &Table) -> &mut Self {
        self.table_in("table", caption, table)
    }

    /// Tables side by side where the window is wide enough.
    pub fn tables(&mut self, tables: &[(&str, Table)]) -> &mut Self {
        self.body.push_str("<div class=\"row\">\n");
        for (caption, table) in tables {
            self.table(caption, table);
        }
        self.push("</div>\n")
    }

    /// A long table, printed in two columns where it is narrow.
    pub fn long_table(&mut self, caption: &str, table: &Table) -> &mut Self {
        let class = if table.columns.len() <= 4 { "table narrow" } else { "table" };
        self.table_in(class, caption, table)
    }

    /// What is left out, why, and what that costs.
    pub fn omitted(&mut self, table: &Table) -> &mut Self {
        self.table_in("table omitted", "", table)
    }

    fn table_in(&mut self, class: &str, caption: &str, table: &Table) -> &mut Self {
        self.body.push_str(&format!("<div class=\"{class}\">\n"));
        if !caption.is_empty() {
            self.body.push_str(&format!("<p class=\"caption\">{}</p>\n", prose(caption)));
        }
        self.push(&format!("{}</div>\n", table.to_html()))
    }

    /// A figure: SVG made by [`super::plot`] or [`super::drawing`] (inserted as it is) and its caption.
    pub fn figure(&mut self, svg: &str, caption: &str) -> &mut Self {
        self.push(&figure(svg, caption))
    }

    /// A figure that is printed at its own size, whatever room it takes: its scale is stated.
    pub fn true_figure(&mut self, svg: &str, caption: &str) -> &mut Self {
        let html = figure(svg, caption).replacen("<figure>", "<figure class=\"true\">", 1);
        self.push(&html)
    }

    /// Figures side by side where the window is wide enough.
    pub fn figures(&mut self, figures: &[(String, &str)]) -> &mut Self {
        self.row("row", figures)
    }

    /// Figures one below the other; printed side by side, as a phone has them.
    pub fn drawings(&mut self, figures: &[(String, &str)]) -> &mut Self {
        self.row("drawn", figures)
    }

    fn row(&mut self, class: &str, figures: &[(String, &str)]) -> &mut Self {
        let figures: String = figures.iter().map(|(svg, caption)| figure(svg, caption)).collect();
        self.push(&format!("<div class=\"{class}\">\n{figures}</div>\n"))
    }

    /// Short tables, each with its caption, in as many columns as there is room for.
    pub fn columns(&mut self, tables: &[(String, Table)]) -> &mut Self {
        self.body.push_str("<div class=\"columns\">\n");
        for (caption, table) in tables {
            self.table(caption, table);
        }
        self.push("</div>\n")
    }

    /// A part that is folded away until its summary is clicked; printed open.
    pub fn folded(&mut self, summary: &str, fill: impl FnOnce(&mut Self)) -> &mut Self {
        self.fold("printed", summary, fill)
    }

    /// Long evidence: folded away, and its summary alone is printed.
    pub fn apart(&mut self, summary: &str, fill: impl FnOnce(&mut Self)) -> &mut Self {
        self.fold("apart", summary, fill)
    }

    fn fold(&mut self, class: &str, summary: &str, fill: impl FnOnce(&mut Self)) -> &mut Self {
        self.body.push_str(&format!("<details class=\"{class}\"><summary>{}</summary>\n", prose(summary)));
        fill(self);
        self.push("</details>\n")
    }

    /// Text kept as typed, folded away and not printed: the design file.
    pub fn source(&mut self, summary: &str, text: &str) -> &mut Self {
        let pre = format!("<pre>{}</pre>\n", escape(text));
        self.fold("source", summary, |page| {
            page.push(&pre);
        })
    }

    /// The results for programs, as JSON that no browser runs. `id` is the element's id.
    pub fn results(&mut self, id: &str, json: &serde_json::Value) -> &mut Self {
        // "</script>" inside a string would end the element: < as its JSON escape means the same.
        let text = json.to_string().replace('<', "\\u003c");
        self.push(&format!("<script type=\"application/json\" id=\"{}\">{text}</script>\n", escape(id)))
    }

    /// The finished page.
    pub fn to_html(&self) -> String {
        let PageHead { title, tool, version, command, design, design_hash } = &self.head;
        let short = design_hash.get(..12).unwrap_or(design_hash);
        let foot = foot(&format!("{title}: {design}, {short}"));
        let [title, tool, version, command, design, design_hash] =
            [title, tool, version, command, design, design_hash].map(|s| escape(s));
        format!(
            // First line: origin, as every generated file has it. Escaped, so no "-->" of the command ends it.
            "<!-- {tool} {version}; design {design_hash}; {command} -->\n<!DOCTYPE html>\n\
             <html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"generator\" content=\"{tool} {version}\">\n\
             <title>{title}: {design}</title>\n<style>\n{STYLE}{foot}</style>\n</head>\n<body>\n<main>\n\
             <header>\n<p class=\"kind\">{title}</p>\n<h1>{design}</h1>\n\
             <dl>\n<dt>Design hash</dt><dd><code>{design_hash}</code></dd>\n\
             <dt>Command</dt><dd><code>{command}</code></dd>\n\
             <dt>Made by</dt><dd>{tool} {version}</dd>\n</dl>\n</header>\n\
             {body}</main>\n</body>\n</html>\n",
            body = self.body,
        )
    }

    fn push(&mut self, html: &str) -> &mut Self {
        self.body.push_str(html);
        self
    }
}

/// The foot of every printed sheet. Of a text that somebody typed only what can end neither a CSS string nor the style.
fn foot(text: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || " ,.:;-_+()/%=#&*'~^!?[]µ⌀°".contains(*c);
    let text: String = text.chars().filter(kept).collect();
    format!("@page {{ @bottom-left {{ content: \"{text}\"; font: 8pt sans-serif; color: #444444; }} }}\n")
}

fn figure(svg: &str, caption: &str) -> String {
    let caption = if caption.is_empty() {
        String::new()
    } else {
        format!("<figcaption>{}</figcaption>", prose(caption))
    };
    format!("<figure>\n{svg}\n{caption}</figure>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page() -> Page {
        Page::new(PageHead {
            title: "Margin check".into(),
            tool: "sprag-design".into(),
            version: "0.0.0".into(),
            command: "sprag-design check a.toml --report <b>.html".into(),
            design: "Huang & co. <script>alert(1)</script>".into(),
            design_hash: "0123abcd".into(),
        })
    }

    #[test]
    fn nothing_typed_by_a_user_becomes_markup() {
        let mut page = page();
        page.heading("<i>h</i>")
            .paragraph("a < b & c, tan omega")
            .list(["<li>"])
            .source("file <x>", "name = \"</pre><b>\"");
        page.verdict(false, "<b>").figure("<svg></svg>", "caption <i>");
        let html = page.to_html();
        assert!(
            html.contains("content: \"Margin check: Huang & co. scriptalert(1)/script, 0123abcd\""),
            "{html}"
        );
        for bad in ["<script>alert", "<i>", "<b>", "</pre><b>", "a < b"] {
            assert!(!html.contains(bad), "{bad} in\n{html}");
        }
        assert!(html.contains("Huang &amp; co. &lt;script&gt;") && html.contains("tan ω</p>"));
    }

    #[test]
    fn symbols_are_letters_and_parts_of_names_are_not() {
        assert_eq!(greek("mu_s = mu_c, theta_bi. tan omega (gamma 3 deg)"), "μs = μc, θbi. tan ω (γ 3 deg)");
        for name in ["mu_s.toml", "low-mu_s", "mu_s-2", "designs/mu_c/x", "xmu_s", "theta_bi_rad"] {
            assert_eq!(greek(name), name);
        }
    }

    #[test]
    fn embedded_json_cannot_close_its_element_and_reads_back() {
        let value = serde_json::json!({ "design": "</script><b>", "x": 0.1 });
        let mut page = page();
        page.results("results", &value);
        let html = page.to_html();
        let start = html.find("id=\"results\">").unwrap() + "id=\"results\">".len();
        let text = &html[start..start + html[start..].find("</script>").unwrap()];
        assert_eq!(serde_json::from_str::<serde_json::Value>(text).unwrap(), value);
    }

    #[test]
    fn the_page_names_no_other_place_and_runs_nothing() {
        let mut page = page();
        page.results("results", &serde_json::json!({}));
        let html = page.to_html();
        for bad in ["http:", "https:", "src=", "@import", "url(", "<link", "<script>", "onload"] {
            assert!(!html.contains(bad), "{bad}");
        }
        assert!(html.contains("0123abcd") && html.contains("sprag-design 0.0.0"));
    }

    #[test]
    fn the_comment_that_names_the_command_stays_a_comment() {
        let mut head = page().head;
        head.command = "sprag-design --> <h1>".into();
        let html = Page::new(head).to_html();
        let comment = &html[html.find("<!--").unwrap() + 4..];
        let comment = &comment[..comment.find("-->").unwrap()];
        assert!(comment.trim().ends_with("&lt;h1&gt;"), "{comment}");
    }
}
