//! A unit without its C interface: variables by value reference, begin, step, state.

use serde::{Deserialize, Serialize};
use sprag_design::clutch::Start;
use sprag_design::element::{Beginning, Element, Motion, Saved, Settings, Torque};
use sprag_design::export::fmu::{
    ElementQuantity, FIRST_KEY, QUANTITIES, Role, ScalarVariable, VariableSubject, VariableType, token,
    variables,
};
use sprag_design::file::is_whole;
use sprag_design::{Clutch, Design, Stop};
use std::path::Path;

/// How far a unit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Phase {
    /// Instantiated: everything can be set.
    Made,
    /// In initialisation mode.
    Begins,
    /// Stepping.
    Runs,
    /// Terminated.
    Over,
}

/// What a unit knows apart from its design: a state to be kept by a master.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Version and design that it belongs to.
    token: String,
    phase: Phase,
    start_s: f64,
    /// Of every variable that can be set, by its place among all.
    values: Vec<f64>,
    /// Slopes of the torques over the next step, N m/s.
    slopes: [f64; 2],
    saved: Option<Saved>,
}

/// How a step ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepped {
    /// As asked.
    Whole,
    /// Early, at this time (s), for this reason; whether nothing leads on.
    Short(f64, Stop, bool),
}

/// One unit.
pub struct Slave {
    design: Design,
    variables: Vec<ScalarVariable>,
    phase: Phase,
    start_s: f64,
    values: Vec<f64>,
    slopes: [f64; 2],
    element: Option<Element>,
    /// Whether the element is that of the values.
    fresh: bool,
}

/// What went wrong, in words for the master's log.
pub type Refused = String;

/// Part of a step, and of time itself, by which a master's clock may differ.
const CLOCK: [f64; 2] = [1e-3, 1e-9];

impl Slave {
    /// The unit of the design in the folder of resources; `bound`: what its description was made for.
    pub fn new(resources: &Path, bound: &str) -> Result<Self, Refused> {
        let design = Design::read(&resources.join("design.toml")).map_err(|why| why.to_string())?;
        let own = token(&design);
        if bound != own {
            return Err(format!(
                "modelDescription.xml belongs to version and design \"{bound}\", library and design.toml are \"{own}\": \
                 export the unit anew"
            ));
        }
        let variables = variables(&design);
        let values = variables.iter().map(|v| v.start.unwrap_or(0.0)).collect();
        let (phase, start_s, slopes) = (Phase::Made, 0.0, [0.0; 2]);
        Ok(Self { design, variables, phase, start_s, values, slopes, element: None, fresh: false })
    }

    /// As instantiated.
    pub fn reset(&mut self) {
        self.values = self.variables.iter().map(|v| v.start.unwrap_or(0.0)).collect();
        (self.phase, self.start_s, self.slopes) = (Phase::Made, 0.0, [0.0; 2]);
        (self.element, self.fresh) = (None, false);
    }

    fn place(&self, reference: u32, kind: VariableType) -> Result<usize, Refused> {
        let own = (reference as usize) < QUANTITIES.len();
        let key = || Some(reference.checked_sub(FIRST_KEY)? as usize + QUANTITIES.len());
        let at = if own { Some(reference as usize) } else { key() };
        match at.and_then(|at| Some((at, self.variables.get(at)?))) {
            Some((at, variable)) if variable.kind == kind => Ok(at),
            Some((_, v)) => Err(format!("{}: found a question for another type than its own", v.name)),
            None => Err(format!("value reference {reference}: no variable of this unit has it")),
        }
    }

    fn own(&self, quantity: ElementQuantity) -> f64 {
        let at = QUANTITIES.iter().position(|row| row.0 == quantity);
        at.map_or(0.0, |at| self.values[at])
    }

    /// Values of variables of one type.
    pub fn get(
        &mut self,
        references: &[u32],
        kind: VariableType,
        mut put: impl FnMut(usize, f64),
    ) -> Result<(), Refused> {
        let mut seen = None;
        for (i, &reference) in references.iter().enumerate() {
            let at = self.place(reference, kind)?;
            let value = match (&self.variables[at].subject, self.variables[at].role) {
                (_, Role::Input | Role::Fixed | Role::Tunable) => self.values[at],
                (VariableSubject::Own(ElementQuantity::Time), _) => {
                    self.element.as_ref().map_or(self.start_s, Element::t_s)
                }
                (&VariableSubject::Own(quantity), _) => {
                    let element = self.element()?;
                    let motion = *seen.get_or_insert_with(|| element.motion());
                    output(element, &motion, quantity)
                }
                (VariableSubject::Key(_), _) => self.values[at],
            };
            put(i, value);
        }
        Ok(())
    }

    /// Set one variable.
    pub fn set(&mut self, reference: u32, kind: VariableType, value: f64) -> Result<(), Refused> {
        let at = self.place(reference, kind)?;
        let v = &self.variables[at];
        if !value.is_finite() {
            return Err(format!("{}: found {value}, a finite number is allowed", v.name));
        }
        match v.role {
            Role::Time | Role::Output => {
                return Err(format!("{}: the unit computes it, it cannot be set", v.name));
            }
            Role::Fixed if self.phase == Phase::Runs && self.values[at] != value => {
                return Err(format!(
                    "{}: can be set before the initialisation is over, not afterwards",
                    v.name
                ));
            }
            _ if self.phase == Phase::Over => return Err(format!("{}: the unit is terminated", v.name)),
            Role::Fixed | Role::Tunable => {
                self.fresh &= self.values[at] == value;
                self.values[at] = value;
            }
            Role::Input => {
                let before = std::mem::replace(&mut self.values[at], value);
                let torques = self.torques();
                let applied = self.element.as_mut().map_or(Ok(()), |element| element.apply(torques));
                if let Err(why) = applied {
                    self.values[at] = before;
                    return Err(why.to_string());
                }
            }
        }
        Ok(())
    }

    /// Set the slope of an input over the next step.
    pub fn set_slope(&mut self, reference: u32, order: i32, slope: f64) -> Result<(), Refused> {
        let at = self.place(reference, VariableType::Real)?;
        let VariableSubject::Own(ElementQuantity::Torque(race)) = self.variables[at].subject else {
            return Err(format!("{}: is no input", self.variables[at].name));
        };
        if order != 1 || !slope.is_finite() {
            let name = &self.variables[at].name;
            return Err(format!(
                "{name}: found derivative {order} of {slope}, a finite first one is allowed"
            ));
        }
        self.slopes[race] = slope;
        Ok(())
    }

    fn torques(&self) -> [f64; 2] {
        [0, 1].map(|race| self.own(ElementQuantity::Torque(race)))
    }

    /// The clutch with the numbers that were set.
    fn clutch(&self) -> Result<Clutch, Refused> {
        let mut settings = Vec::new();
        for (v, &value) in self.variables.iter().zip(&self.values) {
            if let (VariableSubject::Key(key), true) = (&v.subject, v.start != Some(value)) {
                // A whole number has no decimals in a design file; where 12.5 is asked for, its own rules say no.
                let text = if is_whole(key, 0) { format!("{value}") } else { format!("{value:?}") };
                settings.push((key.clone(), text));
            }
        }
        if settings.is_empty() {
            return Ok(self.design.clutch.clone());
        }
        self.design
            .with(&settings, "design.toml with the parameters that were set")
            .map(|d| d.clutch)
            .map_err(|why| why.to_string())
    }

    fn beginning(&self) -> Beginning {
        Beginning {
            t_s: self.start_s,
            speed_rad_s: self.own(ElementQuantity::StartSpeed),
            overrun_rad_s: self.own(ElementQuantity::StartOverrun),
            torque_nm: self.own(ElementQuantity::StartTorque),
            start: if self.own(ElementQuantity::StartWithoutSpring) == 0.0 {
                Start::Settled
            } else {
                Start::WithoutSpring
            },
            angle_rad: self.own(ElementQuantity::StartAngle),
            abutment_nm_per_rad: self.own(ElementQuantity::Abutment),
        }
    }

    fn settings(&self) -> Settings {
        let longest_s = self.own(ElementQuantity::LongestStep);
        let longest_step_s = (longest_s != 0.0).then_some(longest_s);
        Settings { tolerance: self.own(ElementQuantity::Tolerance), longest_step_s, ..Settings::default() }
    }

    /// The element of the present values.
    fn element(&mut self) -> Result<&mut Element, Refused> {
        if !self.fresh || self.element.is_none() {
            let clutch = self.clutch()?;
            let made = match &self.element {
                Some(running) if self.phase == Phase::Runs => running.exchanged(&clutch),
                _ => Element::new(&clutch, &self.beginning(), &self.settings()),
            };
            let mut element = made.map_err(|why| why.to_string())?;
            element.apply(self.torques()).map_err(|why| why.to_string())?;
            (self.element, self.fresh) = (Some(element), true);
        }
        self.element.as_mut().ok_or_else(|| "no element".to_owned())
    }

    /// Enter initialisation mode at `start_s`; `tolerance`: the master's, if it names one.
    pub fn begin(&mut self, start_s: f64, tolerance: Option<f64>) -> Result<(), Refused> {
        if self.phase != Phase::Made {
            return Err("the initialisation can begin once; reset the unit first".to_owned());
        }
        if let (Some(tolerance), Some(at)) =
            (tolerance, QUANTITIES.iter().position(|r| r.0 == ElementQuantity::Tolerance))
        {
            self.values[at] = tolerance;
        }
        self.start_s = start_s;
        self.fresh = false;
        self.element()?;
        self.phase = Phase::Begins;
        Ok(())
    }

    /// Leave it.
    pub fn run(&mut self) -> Result<(), Refused> {
        if self.phase != Phase::Begins {
            return Err("found the end of an initialisation that has not begun".to_owned());
        }
        self.element()?;
        self.phase = Phase::Runs;
        Ok(())
    }

    /// No more steps.
    pub fn terminate(&mut self) {
        self.phase = Phase::Over;
    }

    /// One step of communication from `t_s`.
    pub fn step(&mut self, t_s: f64, dt_s: f64) -> Result<Stepped, Refused> {
        if self.phase != Phase::Runs {
            return Err("found a step before the initialisation is over, or after the end".to_owned());
        }
        let (torques, slopes) = (self.torques(), self.slopes);
        let element = self.element()?;
        let own_s = element.t_s();
        let [part, of_time] = CLOCK;
        if !t_s.is_finite() || (t_s - own_s).abs() > part * dt_s.abs() + of_time * own_s.abs() {
            return Err(format!("found a step from {t_s} s, the unit stands at {own_s} s"));
        }
        let over = |race: usize| {
            let start_nm = torques[race];
            Torque {
                start_nm,
                end_nm: if slopes[race] == 0.0 { start_nm } else { start_nm + slopes[race] * dt_s },
            }
        };
        let over = [over(0), over(1)];
        let stop = element.advance(dt_s, over).map_err(|why| why.to_string())?.stop;
        let (reached_s, ended) = (element.t_s(), element.ended().is_some());
        self.slopes = [0.0; 2];
        for (race, torque) in over.iter().enumerate() {
            if let Some(at) = QUANTITIES.iter().position(|row| row.0 == ElementQuantity::Torque(race)) {
                self.values[at] = torque.end_nm;
            }
        }
        Ok(if stop == Stop::Finished { Stepped::Whole } else { Stepped::Short(reached_s, stop, ended) })
    }

    /// Everything that can change.
    pub fn state(&self) -> State {
        State {
            token: token(&self.design),
            phase: self.phase,
            start_s: self.start_s,
            values: self.values.clone(),
            slopes: self.slopes,
            saved: self.element.as_ref().filter(|_| self.fresh).map(Element::save),
        }
    }

    /// Stand where `state` says.
    pub fn restore(&mut self, state: &State) -> Result<(), Refused> {
        if state.token != token(&self.design) {
            return Err(format!("the state belongs to version and design \"{}\"", state.token));
        }
        let numbers = state.values.iter().chain(&state.slopes).chain([&state.start_s]);
        if state.values.len() != self.variables.len() || !numbers.into_iter().all(|x| x.is_finite()) {
            return Err("the state holds other variables than this unit".to_owned());
        }
        let same = self.fresh && self.parameters(&self.values) == self.parameters(&state.values);
        self.values.clone_from(&state.values);
        (self.phase, self.start_s, self.slopes) = (state.phase, state.start_s, state.slopes);
        let Some(saved) = &state.saved else {
            self.fresh = false;
            return Ok(());
        };
        if !same || self.element.is_none() {
            // The clutch is that of the values; where it stands, `saved` says, so it need not carry a start.
            let beginning = Beginning { torque_nm: 0.0, overrun_rad_s: 0.0, ..self.beginning() };
            let element =
                Element::new(&self.clutch()?, &beginning, &self.settings()).map_err(|why| why.to_string())?;
            (self.element, self.fresh) = (Some(element), true);
        }
        self.element.as_mut().map_or(Ok(()), |element| element.restore(saved).map_err(|why| why.to_string()))
    }

    fn parameters(&self, values: &[f64]) -> Vec<f64> {
        let parameter = |v: &ScalarVariable| matches!(v.role, Role::Fixed | Role::Tunable);
        self.variables.iter().zip(values).filter(|(v, _)| parameter(v)).map(|(_, value)| *value).collect()
    }
}

fn output(element: &Element, motion: &Motion, quantity: ElementQuantity) -> f64 {
    match quantity {
        ElementQuantity::Angle(race) => motion.flanges[race].angle_rad,
        ElementQuantity::Speed(race) => motion.flanges[race].speed_rad_s,
        ElementQuantity::Acceleration(race) => motion.flanges[race].acceleration_rad_s2,
        ElementQuantity::Normal(at) => motion.contacts[at].normal_n,
        ElementQuantity::Friction(at) => motion.contacts[at].friction(),
        ElementQuantity::Slip(at) => f64::from(motion.contacts[at].slips),
        ElementQuantity::Path(at) => element.slips()[at].distance_m,
        ElementQuantity::Open => f64::from(u8::from(motion.open)),
        _ => motion.t_s,
    }
}
