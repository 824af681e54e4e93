//! What every answer says of itself beside its own figures: who computed it, from what, how long that took, what was left out.

use super::left_out::{LeftOut, left_out_of};
use super::page::{draw_inputs, opened};
use crate::design::Design;
use crate::report::{Page, Rows, Screen, Table, Tone};
use serde::ser::{Error, Serialize, Serializer};
use serde_json::Value;

/// Program name in every output.
pub const TOOL: &str = env!("CARGO_PKG_NAME");
/// Program version in every output.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// First words of every design file that this tool writes.
pub const WRITTEN_BY: &str = "# Written by sprag-design";

/// How an answer came about.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Provenance {
    /// The command line, or whatever else asked; it stands on the page.
    pub command: String,
    /// Wall time of the computation alone, s.
    pub run_time_s: f64,
}

/// An answer for programs: the keys that all answers share, and its own in `body`.
#[derive(Debug)]
pub struct Envelope<'a, B: Serialize> {
    /// The design.
    pub design: &'a Design,
    /// Time of the computation alone, s.
    pub run_time_s: f64,
    /// What the model leaves out, each with its reason and its cost.
    pub left_out: Vec<LeftOut>,
    /// How far off the answer is, where something was integrated or iterated: a number, or numbers by name.
    pub error_estimate: Option<Value>,
    /// The answer's own keys: a struct or map.
    pub body: B,
}

/// Keys that stand in the order of the alphabet in JSON, at every depth.
#[derive(Debug, Clone)]
pub struct ByAlphabet<B>(pub B);

impl<B: Serialize> Serialize for ByAlphabet<B> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // A map of serde_json is in that order.
        serde_json::to_value(&self.0).map_err(S::Error::custom)?.serialize(serializer)
    }
}

/// The one JSON object of an answer.
#[derive(Debug, serde::Serialize)]
struct Object<'a, B: Serialize> {
    tool: &'static str,
    version: &'static str,
    design: &'a str,
    design_hash: &'a str,
    run_time_s: f64,
    left_out: &'a [LeftOut],
    #[serde(skip_serializing_if = "Option::is_none")]
    error_estimate: Option<&'a Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unwritten: Vec<String>,
    #[serde(flatten)]
    body: &'a B,
}

impl<B: Serialize> Envelope<'_, B> {
    /// The JSON object; `unwritten`: files that could not be written, each with the reason.
    pub fn object(&self, unwritten: Vec<String>) -> impl Serialize {
        Object {
            tool: TOOL,
            version: VERSION,
            design: &self.design.name,
            design_hash: &self.design.hash,
            run_time_s: self.run_time_s,
            left_out: &self.left_out,
            error_estimate: self.error_estimate.as_ref(),
            unwritten,
            body: &self.body,
        }
    }

    /// End of a page: the inputs, then as [`Self::end`].
    pub fn close(&self, page: &mut Page) {
        page.folded("Inputs", |page| draw_inputs(page, self.design, None));
        self.end(page);
    }

    /// The same of a page that is about one scene: of the scenes that one alone.
    pub fn close_scene(&self, page: &mut Page, scene: &str) {
        page.folded("Inputs", |page| draw_inputs(page, self.design, Some(scene)));
        self.end(page);
    }

    /// End of a page that has its inputs: what was left out, the results for programs, the design file.
    pub fn end(&self, page: &mut Page) {
        let table = Rows::of(&self.left_out)
            .text("term", "Left out", |entry| entry.term.as_str())
            .text("why", "Why", |entry| entry.why.as_str())
            .text("cost", "What it costs", |entry| entry.cost.as_str())
            .table();
        page.folded("What the model leaves out", |page| {
            page.omitted(&table);
        });
        // Numbers that are none become null; the object holds nothing else that has no JSON form.
        page.results("results", &serde_json::to_value(self.object(Vec::new())).unwrap_or_default());
        page.source("Design file", &self.design.source);
    }
}

/// What an answer comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finding {
    /// All that was asked about holds.
    Held,
    /// Something does not.
    NotHeld,
    /// Figures alone: nothing is to hold.
    Shown,
    /// What would decide is not known, or a run did not come to its end.
    NotKnown,
    /// Stopped before its end.
    Stopped,
}

impl Finding {
    /// Of a verdict.
    pub fn of(held: bool) -> Self {
        if held { Self::Held } else { Self::NotHeld }
    }
}

/// An answer and its faces.
pub trait Answer {
    /// Its own keys in JSON.
    type Body<'a>: Serialize
    where
        Self: 'a;

    /// What it comes to.
    fn outcome(&self) -> Finding;
    /// That in a sentence.
    fn verdict(&self) -> String;
    /// The table for programs.
    fn table(&self) -> Table;
    /// The answer on a terminal.
    fn text(&self, screen: Screen) -> String;
    /// The answer as a page.
    fn page(&self, provenance: &Provenance) -> Page;
    /// The answer with the keys that all answers share; `run_time_s`: what it took, s.
    fn envelope(&self, run_time_s: f64) -> Envelope<'_, Self::Body<'_>>;

    /// Whether all that was asked about holds.
    fn held(&self) -> bool {
        self.outcome() == Finding::Held
    }

    /// Why the table is a part of what was asked for; `None`: it is whole.
    fn part(&self) -> Option<String> {
        (self.outcome() == Finding::Stopped).then(|| "stopped by Ctrl-C".to_owned())
    }
}

/// What an answer about one design says; the faces of [`Answer`] follow from it.
pub trait Said {
    /// Its own keys in JSON.
    type Body<'a>: Serialize
    where
        Self: 'a;

    /// Title of its page.
    fn title(&self) -> &str;
    /// The design.
    fn design(&self) -> &Design;
    /// What it comes to.
    fn outcome(&self) -> Finding;
    /// That in a sentence.
    fn verdict(&self) -> String;
    /// What the tables do not say, a sentence each.
    fn remarks(&self) -> Vec<String>;
    /// The table for programs.
    fn table(&self) -> Table;
    /// Its own keys in JSON.
    fn body(&self) -> Self::Body<'_>;
    /// What stands on a page between the remarks and the inputs.
    fn draw(&self, page: &mut Page);

    /// Whether all that was asked about holds.
    fn is_held(&self) -> bool {
        self.outcome() == Finding::Held
    }

    /// What it is about.
    fn subject(&self) -> String {
        self.design().name.clone()
    }

    /// How the verdict looks on a page, and its words there.
    fn banner(&self) -> (Tone, String) {
        let tone = match self.outcome() {
            Finding::Held => Tone::Good,
            Finding::NotHeld | Finding::Stopped => Tone::Bad,
            Finding::Shown | Finding::NotKnown => Tone::Plain,
        };
        (tone, self.verdict())
    }

    /// The tables on a terminal.
    fn tables(&self, screen: Screen) -> String {
        self.table().to_text(screen)
    }

    /// What the model leaves out.
    fn left_out(&self) -> Vec<LeftOut> {
        left_out_of(self.design())
    }

    /// How far off the answer is, where something was integrated or iterated.
    fn error_estimate(&self) -> Option<Value> {
        None
    }
}

impl<T: Said> Answer for T {
    type Body<'a>
        = T::Body<'a>
    where
        T: 'a;

    fn outcome(&self) -> Finding {
        Said::outcome(self)
    }

    fn verdict(&self) -> String {
        Said::verdict(self)
    }

    fn table(&self) -> Table {
        Said::table(self)
    }

    fn text(&self, screen: Screen) -> String {
        let mut text = format!("{}  {}\n\n", self.subject(), self.design().short_hash());
        let lines = Some(self.tables(screen)).filter(|tables| !tables.is_empty());
        for line in lines.into_iter().chain(self.remarks()).chain([self.verdict()]) {
            text += &line;
            text += "\n";
        }
        text
    }

    fn page(&self, provenance: &Provenance) -> Page {
        let mut page = opened(self.title(), self.design(), &provenance.command, |page| {
            let (tone, words) = self.banner();
            page.verdict_in(tone, &words);
        });
        page.list(self.remarks());
        self.draw(&mut page);
        self.envelope(provenance.run_time_s).close(&mut page);
        page
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, T::Body<'_>> {
        Envelope {
            design: self.design(),
            run_time_s,
            left_out: self.left_out(),
            error_estimate: self.error_estimate(),
            body: self.body(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_envelope_comes_first_and_holds_the_body() {
        #[derive(serde::Serialize)]
        struct Body {
            pass: bool,
            margins: Vec<f64>,
        }
        let design =
            Design::parse(include_str!("../../designs/huang2017-multi-arc.toml"), "multi-arc").unwrap();
        let body = Body { pass: true, margins: vec![0.1, f64::NAN] };
        let answer =
            Envelope { design: &design, run_time_s: 0.5, left_out: Vec::new(), error_estimate: None, body };
        let text = serde_json::to_string(&answer.object(Vec::new())).unwrap();
        assert!(text.starts_with("{\"tool\":\"sprag-design\",\"version\":"), "{text}");
        let value: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["design_hash"], design.hash.as_str());
        assert_eq!(value["pass"], true);
        assert_eq!(value["margins"][1], Value::Null);
        assert!(value.get("error_estimate").is_none() && value.get("unwritten").is_none());
    }
}
