//! The one object that the page talks to.

use super::scene::{SceneRow, SceneView, scene_row, scene_view};
use super::view::{Solved, StudioView};
use crate::design::Design;
use crate::file::{DesignError, with_setting};
use crate::margin::NoMargins;
use crate::scenario::{NoScenario, Settings};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// Why a question has no answer: a sentence, and the faults of the file where it is that.
#[derive(Debug, Clone, PartialEq)]
pub struct StudioRefusal {
    /// In words.
    pub message: String,
    /// As `--json` prints a refused design; null otherwise.
    pub problems: Value,
}

impl StudioRefusal {
    pub(super) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), problems: Value::Null }
    }

    /// As the page takes it.
    pub(super) fn into_json(self) -> Value {
        json!({ "message": self.message, "problems": self.problems })
    }
}

impl From<DesignError> for StudioRefusal {
    fn from(error: DesignError) -> Self {
        let first = error.problems().first().map(|p| {
            let line = p.place.as_ref().map_or(String::new(), |at| format!("line {}: ", at.line));
            format!("{line}{}: found {}; allowed: {}. {}", p.key, p.found, p.allowed, p.help)
        });
        Self { message: first.unwrap_or_else(|| error.to_string()), problems: error.to_json() }
    }
}

impl From<NoMargins> for StudioRefusal {
    fn from(why: NoMargins) -> Self {
        Self::new(why.to_string())
    }
}

impl From<NoScenario> for StudioRefusal {
    fn from(why: NoScenario) -> Self {
        Self::new(why.to_string())
    }
}

/// Answers questions about texts; keeps the statics of the last few.
#[derive(Debug, Default)]
pub struct Engine {
    /// Name of the file in messages.
    file: String,
    /// Where histories are looked for.
    folder: PathBuf,
    kept: Mutex<Vec<(String, Arc<Solved>)>>,
}

/// Texts that are kept: now, the pinned one, and a step back for each.
const KEPT: usize = 4;

impl Engine {
    /// For the design in `file`, whose histories lie in `folder`.
    pub fn new(file: &str, folder: PathBuf) -> Self {
        Self { file: file.to_owned(), folder, kept: Mutex::default() }
    }

    pub(super) fn design(&self, text: &str) -> Result<Design, StudioRefusal> {
        Ok(Design::parse_in(&self.folder, text, &self.file)?)
    }

    fn solved(&self, text: &str) -> Result<Arc<Solved>, StudioRefusal> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = kept.iter().position(|(t, _)| t == text) {
            let entry = kept.remove(at);
            let solved = entry.1.clone();
            kept.push(entry);
            return Ok(solved);
        }
        drop(kept);
        let solved = Arc::new(Solved::new(self.design(text)?)?);
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push((text.to_owned(), solved.clone()));
        let over = kept.len().saturating_sub(KEPT);
        kept.drain(..over);
        Ok(solved)
    }

    /// Statics of a text, with a pinned one as ghost.
    ///
    /// # Errors
    /// [`StudioRefusal`] where the text is no design or the clutch has no curve; a pinned text that is refused is left out.
    pub fn check(&self, text: &str, pinned: Option<&str>) -> Result<StudioView, StudioRefusal> {
        let pinned = pinned.and_then(|text| self.solved(text).ok());
        Ok(self.solved(text)?.view(pinned.as_deref()))
    }

    /// Margins and demand of one scenario.
    ///
    /// # Errors
    /// [`StudioRefusal`].
    pub fn scene_row(&self, text: &str, name: &str, settings: &Settings) -> Result<SceneRow, StudioRefusal> {
        let solved = self.solved(text)?;
        let scenario = solved
            .design
            .scenario(name)
            .ok_or_else(|| StudioRefusal::new(format!("no scenario {name:?}")))?;
        Ok(scene_row(&solved.design, &solved.state, scenario, settings))
    }

    /// The course of one scenario, with that of the same name in a pinned text as ghost.
    ///
    /// # Errors
    /// [`StudioRefusal`]; a pinned text that is refused, or has no such scenario, is left out.
    pub fn scene(
        &self,
        text: &str,
        pinned: Option<&str>,
        name: &str,
        settings: &Settings,
    ) -> Result<SceneView, StudioRefusal> {
        let solved = self.solved(text)?;
        let pinned = pinned.filter(|pinned| *pinned != text).and_then(|text| self.solved(text).ok());
        let scenario = solved
            .design
            .scenario(name)
            .ok_or_else(|| StudioRefusal::new(format!("no scenario {name:?}")))?;
        Ok(scene_view(scenario, pinned.as_ref().and_then(|p| p.design.scenario(name)), settings)?)
    }

    /// The text with a value set, its comments kept. The new text may still be refused by [`Engine::check`].
    ///
    /// # Errors
    /// [`StudioRefusal`] where there is no such key.
    pub fn set(&self, text: &str, path: &str, value: &str) -> Result<String, StudioRefusal> {
        with_setting(text, path, value).map_err(|why| StudioRefusal::new(why.to_string()))
    }

    /// A question as the page puts it: `ask` names it, `question` is an object of texts. The answer, or an object with
    /// `message` and `problems`.
    ///
    /// # Errors
    /// That object.
    pub fn ask(&self, ask: &str, question: &Value, settings: &Settings) -> Result<Value, Value> {
        let text = |key: &str| question.get(key).and_then(Value::as_str);
        let need = |key: &str| {
            text(key).ok_or_else(|| StudioRefusal::new(format!("the question {ask} has no text {key}")))
        };
        let answer = || -> Result<Value, StudioRefusal> {
            let json = |value: Result<Value, serde_json::Error>| {
                value.map_err(|e| StudioRefusal::new(e.to_string()))
            };
            match ask {
                "check" => json(serde_json::to_value(self.check(need("text")?, text("pinned"))?)),
                "scene_row" => {
                    json(serde_json::to_value(self.scene_row(need("text")?, need("name")?, settings)?))
                }
                "scene" => {
                    let found = self.scene(need("text")?, text("pinned"), need("name")?, settings)?;
                    json(serde_json::to_value(found))
                }
                "change" => {
                    let text = self.set(need("text")?, need("path")?, need("value")?)?;
                    let look = self.check(&text, question.get("pinned").and_then(Value::as_str))?;
                    Ok(json!({ "text": text, "look": look }))
                }
                other => Err(StudioRefusal::new(format!("no question {other:?}"))),
            }
        };
        answer().map_err(StudioRefusal::into_json)
    }
}

#[cfg(test)]
mod tests {
    use super::super::view::Pose;
    use super::*;

    const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");

    fn engine() -> Engine {
        Engine::new("designs/huang2017-multi-arc.toml", PathBuf::from("designs"))
    }

    #[test]
    fn a_changed_radius_changes_margins_and_the_ghost_is_drawn() {
        let engine = engine();
        let before = engine.check(DESIGN, None).unwrap();
        let text = engine.set(DESIGN, "r_i2_mm", "4.2").unwrap();
        let now = engine.check(&text, Some(DESIGN)).unwrap();
        let margin =
            |view: &StudioView| view.margins.iter().find(|m| m.code == "hertz-nominal-inner").unwrap().margin;
        assert_ne!(margin(&before), margin(&now));
        let carries = now.figures.iter().find(|f| f.name == "carries, nominal").unwrap();
        let check = engine.design(&text).unwrap().check(&crate::Follow::nobody()).unwrap().body;
        let Some(by_check) = check.nominal_torque_capacity else { panic!("no capacity") };
        assert_eq!(
            carries.text,
            format!("{} Nm ({})", crate::report::significant(by_check.torque_capacity_nm, 4), by_check.code)
        );
        assert!(carries.pinned.is_some());
        assert!(now.windup_svg.contains("pinned") && !before.windup_svg.contains("pinned"));
        assert!(now.picture.unwrap().svg.contains("class=\"ghost\""));
        assert!(now.margins.windows(2).all(|w| !w[1].required || w[0].margin <= w[1].margin));
        assert!(now.poses.windows(2).all(|w| w[0].torque_nm <= w[1].torque_nm));
        let by_limit = check.margins.iter().find(|m| m.code == "hertz-nominal-inner").and_then(|m| m.demand);
        let pressed =
            |pose: &Pose| by_limit.is_some_and(|mpa| (pose.hertz_inner_pa * 1e-6 / mpa - 1.0).abs() < 1e-12);
        assert!(now.poses.iter().any(pressed));
    }

    #[test]
    fn a_scene_is_played_and_asked_for_its_margin() {
        let engine = engine();
        let settings = Settings::default();
        let row = engine.scene_row(DESIGN, "low-10", &settings).unwrap();
        assert!(row.required_friction.is_some() && row.margins.len() >= 2);
        assert_eq!(engine.scene_row(DESIGN, "high-10", &settings).unwrap().required_friction, None);
        let scene = engine.scene(DESIGN, None, "high-10", &settings).unwrap();
        assert_eq!(scene.t_s.len(), scene.forces_n.len());
        assert!(scene.t_s.len() > 500 && scene.plots.len() == 3);
        let text = engine.set(DESIGN, "r_i2_mm", "4.2").unwrap();
        let beside = engine.scene(&text, Some(DESIGN), "high-10", &settings).unwrap();
        assert!(beside.plots.iter().all(|plot| plot.contains("pinned")));
        assert!(scene.plots.iter().all(|plot| !plot.contains("pinned")));
    }

    /// A contact that a cage bears is closed, and its tangential force asks no friction.
    #[test]
    fn sprags_that_a_cage_takes_along_are_not_open() {
        let (engine, text) = (engine(), include_str!("../../designs/lift-off-inner.toml"));
        let scene = engine.scene(text, None, "runback", &Settings::default()).unwrap();
        let inner = scene.modes.iter().zip(&scene.forces_n).map(|(modes, n)| (modes[0], n[0]));
        assert!(inner.clone().any(|(mode, n)| mode == 3 && n > 0.0));
        assert!(inner.clone().all(|(mode, n)| mode != 2 || n <= 0.0));
        // A scene that is one state shows that state, not the torque that was looked at before.
        let scene = engine.scene(text, None, "load", &Settings::default()).unwrap();
        let view = engine.check(text, None).unwrap();
        let nominal = view.poses.iter().map(|p| (p.torque_nm - 700.0).abs()).fold(f64::INFINITY, f64::min);
        let pose = view.poses.iter().find(|p| (p.torque_nm - 700.0).abs() == nominal).unwrap();
        assert_eq!(scene.t_s, [0.0]);
        assert!((scene.alpha_rad[0] / pose.alpha_rad - 1.0).abs() < 0.1 && scene.forces_n[0][0] > 2e4);
        let carries = view.figures.iter().find(|f| f.name == "carries, nominal").unwrap();
        assert_eq!(carries.text, "> 1381 Nm");
    }

    #[test]
    fn an_overrun_shows_sprags_that_run_free() {
        let (engine, text) = (engine(), include_str!("../../designs/huang2017-bench.toml"));
        let scene = engine.scene(text, None, "overrun", &Settings::default()).unwrap();
        let forces = scene.forces_n[0];
        assert_eq!(scene.modes[0], [1, 0], "{}", scene.verdict);
        assert!(forces[0] > 0.0 && forces[0] < 100.0 && forces[1] < 0.0, "{forces:?}");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let engine = engine();
        let text = engine.set(DESIGN, "sprags.count", "-3").unwrap();
        let refused = engine.check(&text, None).unwrap_err();
        assert!(refused.message.contains("line") && refused.message.contains("-3"), "{}", refused.message);
        let asked = |ask: &str, question: Value| engine.ask(ask, &question, &Settings::default());
        assert!(asked("check", json!({ "text": DESIGN })).is_ok());
        assert!(asked("check", json!({})).unwrap_err()["message"].as_str().unwrap().contains("no text text"));
        assert!(asked("nothing", json!({})).is_err());
        assert!(asked("scene", json!({ "text": DESIGN, "name": "nobody" })).is_err());
    }
}
