//! The class `_core.Design`: a checked design and the questions to it.

use crate::errors::{self, json};
use crate::pool::compute;
use crate::problem::Problem;
use crate::simulated::Simulated;
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use serde_json::{Value, json as object};
use sprag_design::Follow;
use sprag_design::answer::check::NoCheck;
use sprag_design::answer::feed::{FeedSettings, NoFeed};
use sprag_design::answer::life::NoLife;
use sprag_design::answer::overrun::{NoOverrun, OverrunQuestion, RunningRace};
use sprag_design::answer::reengagement::{NoReengagement, ReengagementSettings};
use sprag_design::answer::sharing::NoSharing;
use sprag_design::answer::sharing_scene::NoSharingScene;
use sprag_design::answer::simulation::{self, Integration, NoAnswer};
use sprag_design::answer::stiffness::{self, NoStiffness};
use sprag_design::answer::{Answer, Envelope, LeftOut};
use sprag_design::clutch::LAWS;
use sprag_design::design::nearest;
use sprag_design::file::{EditError, NoSetting, setting_at};
use sprag_design::report::{Drawing, SpragPose};
use sprag_design::scenario::Settings;
use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// A checked design.
#[pyclass(frozen, module = "sprag_design._core")]
pub struct Design {
    pub(crate) design: Arc<sprag_design::Design>,
    /// What stands for the file in messages.
    pub(crate) file: String,
}

/// What all answers share.
pub fn common(seconds: f64, left_out: &[LeftOut], error_estimate: Value) -> PyResult<String> {
    json(&object!({ "run_time_s": seconds, "left_out": left_out, "error_estimate": error_estimate }))
}

/// Common keys and figures of a whole answer.
pub fn parts<B: serde::Serialize>(answer: &Envelope<'_, B>) -> PyResult<(String, String)> {
    let error = answer.error_estimate.clone().unwrap_or(Value::Null);
    Ok((common(answer.run_time_s, &answer.left_out, error)?, json(&answer.body)?))
}

/// The same while Ctrl-C has no answer: it is raised before anybody looks.
pub fn stopped() -> PyErr {
    PyRuntimeError::new_err("stopped")
}

impl Design {
    pub(crate) fn of(
        py: Python<'_>,
        found: Result<sprag_design::Design, sprag_design::DesignError>,
        file: String,
    ) -> PyResult<Self> {
        match found {
            Ok(design) => Ok(Self { design: Arc::new(design), file }),
            Err(why) => Err(errors::refused(py, &why)),
        }
    }

    /// The design of a text that stands in this one's place.
    pub(crate) fn in_place(&self, py: Python<'_>, text: &str) -> PyResult<Self> {
        let read = sprag_design::Design::parse_in(&self.design.folder, text, &self.file);
        Self::of(py, read, self.file.clone())
    }
}

#[pymethods]
impl Design {
    /// Read and check a design file.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let found = py.detach(|| sprag_design::Design::read(&path));
        Self::of(py, found, path.display().to_string())
    }

    /// Check the text of a design file that would lie in `folder`.
    #[staticmethod]
    fn parse(py: Python<'_>, source: &str, folder: PathBuf, file: String) -> PyResult<Self> {
        let found = py.detach(|| sprag_design::Design::parse_in(&folder, source, &file));
        Self::of(py, found, file)
    }

    /// The same design with values set: dotted path or short name, value as TOML.
    fn with_settings(&self, py: Python<'_>, settings: Vec<(String, String)>) -> PyResult<Self> {
        let found = py.detach(|| self.design.with(&settings, &self.file));
        Self::of(py, found, self.file.clone())
    }

    /// What the file says at a path, as JSON, or none where it says nothing, with what stands beside it.
    fn value(&self, path: &str) -> PyResult<(Option<String>, String)> {
        match setting_at(&self.design.source, path) {
            Ok(value) => Ok((Some(json(&value)?), String::new())),
            Err(why @ NoSetting::NotHeld { .. }) => Ok((None, why.to_string())),
            Err(NoSetting::Edit(EditError::UnknownName { name, known })) => {
                let near = nearest(&name, &known).map(|near| format!("did you mean {near}? There"));
                let there = near.as_deref().unwrap_or("there");
                Err(PyKeyError::new_err(format!("no {name:?}; {there} are {}", known.join(", "))))
            }
            Err(why) => Err(PyKeyError::new_err(why.to_string())),
        }
    }

    /// Name of the design.
    #[getter]
    fn name(&self) -> &str {
        &self.design.name
    }

    /// SHA-256 of its text and its histories.
    #[getter]
    fn hash(&self) -> &str {
        &self.design.hash
    }

    /// Its text.
    #[getter]
    fn source(&self) -> &str {
        &self.design.source
    }

    /// Folder from which its histories are named.
    #[getter]
    fn folder(&self) -> PathBuf {
        self.design.folder.clone()
    }

    /// What stands for the file in messages.
    #[getter]
    fn file(&self) -> &str {
        &self.file
    }

    /// Names of its scenarios.
    #[getter]
    fn scenarios(&self) -> Vec<String> {
        self.design.scenarios.iter().map(|s| s.name.clone()).collect()
    }

    /// Common keys and figures of the margin check, each as JSON.
    fn check(&self, py: Python<'_>) -> PyResult<(String, String, String)> {
        let (design, follow) = (Arc::clone(&self.design), Follow::new());
        let stop = follow.clone();
        let answer = compute(py, &stop, move || {
            let started = Instant::now();
            design.check(&follow).map(|a| (a, started.elapsed().as_secs_f64()))
        })?;
        match answer {
            Ok((a, seconds)) => {
                Ok((common(seconds, &a.left_out, object!(a.errors))?, json(&a.body)?, a.body.verdict()))
            }
            Err(NoCheck::NoClutch(why)) => Err(errors::no_clutch(py, &why)),
            Err(NoCheck::Stopped) => Err(stopped()),
        }
    }

    /// Common keys and figures of the static curve, each as JSON.
    fn stiffness(
        &self,
        py: Python<'_>,
        torques_nm: Vec<f64>,
        laws: Vec<String>,
        max_torque_nm: Option<f64>,
    ) -> PyResult<(String, String)> {
        let law = |key: &String| {
            let known = || LAWS.iter().map(|law| law.key).collect::<Vec<_>>().join(", ");
            LAWS.iter()
                .find(|law| law.key == key)
                .map(|law| law.name)
                .ok_or_else(|| PyValueError::new_err(format!("contact law {key:?}: allowed: {}", known())))
        };
        let laws = laws.iter().map(law).collect::<PyResult<Vec<_>>>()?;
        let (design, stop) = (Arc::clone(&self.design), Follow::new());
        let ask = stiffness::StiffnessSettings { laws, torques_nm, max_torque_nm, follow: stop.clone() };
        let answer = compute(py, &stop, move || {
            let started = Instant::now();
            design.stiffness(&ask).map(|a| (a, started.elapsed().as_secs_f64()))
        })?;
        match answer {
            Ok((a, seconds)) => {
                Ok((common(seconds, &a.left_out, object!(a.error_relative))?, json(&a.body)?))
            }
            Err(NoStiffness::NoClutch(why)) => Err(errors::no_clutch(py, &why)),
            Err(why @ (NoStiffness::Torque(_) | NoStiffness::Pressure(_))) => {
                Err(PyValueError::new_err(why.to_string()))
            }
            Err(NoStiffness::Stopped) => Err(stopped()),
        }
    }

    /// Simulate one scenario.
    #[pyo3(signature = (scenario, published, band_m_s, tolerance, step_s, rows, window_s, most_steps, full))]
    fn simulate(
        &self,
        py: Python<'_>,
        scenario: String,
        published: bool,
        band_m_s: Option<f64>,
        tolerance: Option<f64>,
        step_s: Option<f64>,
        rows: Option<usize>,
        window_s: Option<[f64; 2]>,
        most_steps: Option<u64>,
        full: bool,
    ) -> PyResult<Simulated> {
        let (design, stop) = (Arc::clone(&self.design), Follow::new());
        let ask = simulation::SimulationSettings {
            method: if published { Integration::Published { band_m_s } } else { Integration::Event },
            tolerance,
            step_s,
            most_steps,
            most_events: None,
            rows,
            window_s,
            full,
            follow: stop.clone(),
        };
        let answer = compute(py, &stop, move || {
            let started = Instant::now();
            design.simulate(&scenario, &ask).map(|a| (a, started.elapsed().as_secs_f64()))
        })?;
        match answer {
            Ok((a, seconds)) => {
                let error = a.simulation().and_then(|s| s.error).map(|e| object!(e.theta_inner_rad));
                let common = common(seconds, &a.left_out, error.unwrap_or(Value::Null))?;
                Ok(Simulated::new(a, common))
            }
            Err(why @ NoAnswer::NoSuchScenario { .. }) => Err(PyKeyError::new_err(why.to_string())),
            Err(why @ NoAnswer::Refused(_)) => Err(PyValueError::new_err(why.to_string())),
        }
    }

    /// Common keys and figures of the life that the file names, each as JSON.
    fn life(&self, py: Python<'_>) -> PyResult<(String, String)> {
        let design = Arc::clone(&self.design);
        let answer = compute(py, &Follow::nobody(), move || {
            let started = Instant::now();
            design.life().map(|a| parts(&a.envelope(started.elapsed().as_secs_f64())))
        })?;
        answer.unwrap_or_else(|why| match why {
            NoLife::NoClutch(why) => Err(errors::no_clutch(py, &why)),
            NoLife::NoService { .. } | NoLife::NoSwing { .. } => {
                Err(PyValueError::new_err(format!("{}: {why}", self.file)))
            }
        })
    }

    /// Common keys and figures of overrun on a film, each as JSON; speeds in rpm, temperatures in C.
    fn overrun(
        &self,
        py: Python<'_>,
        outer: bool,
        speeds_rpm: Vec<f64>,
        temperatures_c: Vec<f64>,
    ) -> PyResult<(String, String)> {
        let design = Arc::clone(&self.design);
        let question = OverrunQuestion {
            race: if outer { RunningRace::Outer } else { RunningRace::Inner },
            speeds_rad_s: speeds_rpm.iter().map(|rpm| rpm * PI / 30.0).collect(),
            temperatures_c,
        };
        let answer = compute(py, &Follow::nobody(), move || {
            let started = Instant::now();
            design.overrun(&question).map(|a| parts(&a.envelope(started.elapsed().as_secs_f64())))
        })?;
        answer.unwrap_or_else(|why| match why {
            NoOverrun::NoClutch(why) => Err(errors::no_clutch(py, &why)),
            NoOverrun::NoLubrication | NoOverrun::AtSpeed { .. } | NoOverrun::Setting(_) => {
                Err(PyValueError::new_err(format!("{}: {why}", self.file)))
            }
        })
    }

    /// Common keys and figures of a slip under load and the blow after it, each as JSON.
    #[pyo3(signature = (torque_nm, inertia_kg_m2, outer_held, friction, speed_rpm, paths_mm, over_friction, over_inertia_kg_m2))]
    #[allow(clippy::too_many_arguments)] // One question, as the class that asks has it.
    fn reengage(
        &self,
        py: Python<'_>,
        torque_nm: Option<f64>,
        inertia_kg_m2: [Option<f64>; 2],
        outer_held: Option<bool>,
        friction: Option<f64>,
        speed_rpm: Option<f64>,
        paths_mm: Option<Vec<f64>>,
        over_friction: Vec<f64>,
        over_inertia_kg_m2: Vec<f64>,
    ) -> PyResult<(String, String)> {
        let (design, stop) = (Arc::clone(&self.design), Follow::new());
        let usual = ReengagementSettings::default();
        let ask = ReengagementSettings {
            torque_nm,
            inertia_kg_m2,
            outer_held,
            friction,
            speed_rad_s: speed_rpm.map(|rpm| rpm * PI / 30.0),
            paths_m: paths_mm.map_or(usual.paths_m, |list| list.iter().map(|mm| 1e-3 * mm).collect()),
            over_friction,
            over_inner_inertia_kg_m2: over_inertia_kg_m2,
            follow: stop.clone(),
        };
        let answer = compute(py, &stop, move || {
            let started = Instant::now();
            design.reengagement(&ask).map(|a| parts(&a.envelope(started.elapsed().as_secs_f64())))
        })?;
        answer.unwrap_or_else(|why| match why {
            why @ NoReengagement::Refused(_) => Err(PyValueError::new_err(why.to_string())),
            NoReengagement::NoStart(why) => Err(errors::no_clutch(py, &why)),
        })
    }

    /// Common keys and figures of what each sprag carries, each as JSON.
    fn sharing(&self, py: Python<'_>, torque_nm: Option<f64>) -> PyResult<(String, String)> {
        let design = Arc::clone(&self.design);
        let answer = compute(py, &Follow::nobody(), move || {
            let started = Instant::now();
            design.sharing(torque_nm).map(|a| parts(&a.envelope(started.elapsed().as_secs_f64())))
        })?;
        answer.unwrap_or_else(|why| match why {
            NoSharing::NoClutch(why) => Err(errors::no_clutch(py, &why)),
            NoSharing::NoTable | NoSharing::NoTorque => {
                Err(PyValueError::new_err(format!("{}: {why}", self.file)))
            }
        })
    }

    /// The same of a scenario, its sprags one by one.
    fn sharing_in_scene(
        &self,
        py: Python<'_>,
        scenario: String,
        most_steps: Option<u64>,
    ) -> PyResult<(String, String)> {
        let (design, follow) = (Arc::clone(&self.design), Follow::new());
        let settings = Settings { follow: follow.clone(), most_steps, ..Settings::default() };
        let answer = compute(py, &follow, move || {
            let started = Instant::now();
            let found = design.sharing_in_scene(&scenario, &settings);
            found.map(|a| parts(&a.envelope(started.elapsed().as_secs_f64())))
        })?;
        answer.unwrap_or_else(|why| match why {
            why @ NoSharingScene::NoSuchScene(..) => Err(PyKeyError::new_err(why.to_string())),
            why => Err(PyValueError::new_err(format!("{}: {why}", self.file))),
        })
    }

    /// Common keys and figures of what each stroke of an indexing drive feeds, each as JSON; angles in degrees.
    #[pyo3(signature = (stroke_deg, frequencies_hz, brake_nm, inertia_kg_m2, inner_drives, allowed_deg, springs))]
    #[allow(clippy::too_many_arguments)] // One question, as the class that asks has it.
    fn feed(
        &self,
        py: Python<'_>,
        stroke_deg: f64,
        frequencies_hz: Option<Vec<f64>>,
        brake_nm: Option<f64>,
        inertia_kg_m2: Option<f64>,
        inner_drives: bool,
        allowed_deg: f64,
        springs: Vec<f64>,
    ) -> PyResult<(String, String)> {
        let (design, stop) = (Arc::clone(&self.design), Follow::new());
        let ask = FeedSettings {
            stroke_rad: stroke_deg.to_radians(),
            frequencies_hz: frequencies_hz.unwrap_or_else(|| FeedSettings::default().frequencies_hz),
            brake_nm,
            inertia_kg_m2,
            inner_drives,
            allowed_rad: allowed_deg.to_radians(),
            springs,
            follow: stop.clone(),
        };
        let answer = compute(py, &stop, move || {
            let started = Instant::now();
            design.feed(&ask).map(|a| parts(&a.envelope(started.elapsed().as_secs_f64())))
        })?;
        answer.unwrap_or_else(|why| match why {
            why @ NoFeed::Refused { .. } => Err(PyValueError::new_err(why.to_string())),
            why => Err(errors::no_clutch(py, &why)),
        })
    }

    /// The vector of variables and its margins.
    fn problem(&self, full: bool) -> PyResult<Problem> {
        Problem::new(&self.design, &self.file, full)
    }

    /// Drawings as SVG: one sprag large, the whole clutch, the arc centres.
    fn drawings(&self, py: Python<'_>) -> PyResult<(String, String, String)> {
        let profile = self.design.clutch.profile().map_err(|why| errors::no_clutch(py, &why))?;
        let clutch = &self.design.clutch;
        let drawing = Drawing::of(clutch, vec![SpragPose::at_rest(&self.design.name, clutch, &profile)]);
        Ok((
            drawing.detail_svg(),
            drawing.small_svg(clutch.races.outer_outside_radius_m),
            drawing.centres_svg(),
        ))
    }
}
