//! `size`: a first design file from what a clutch shall do.

use super::exit::{Exit, Failure};
use super::origin::FileKind;
use super::{Context, Run, Without, made, number};
use crate::design::{nearest, rad_s};
use crate::material::{STEELS, Steel, steel};
use crate::size::Wish;
use clap::Args;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  sprag-design size --bore 40 --torque 1000 --speed 3000 -o mine.toml
  sprag-design size --bore 40 --peak 1300 --outside 100 --width 30 --material 20MnCr5 -o mine.toml
  sprag-design check mine.toml
  sprag-design optimize mine.toml -o better.toml

Every race space of one family of similar sprags is tried; of those that do it the one of the
least volume, from bore to outside and as wide as it must be, is taken. The file that
is written holds its limits, with a static scenario at nominal torque and a torque step up to it, and an optimize table. A
file that is there already is replaced only with --force. `new` asks the same questions one by one, and adds the scenes of a
purpose.

Exit codes: 0 written; 1 no clutch of the family does it, with the limit that prevents it and the nearest possible.";

/// What `size` and `new` have in common: space, torque, speeds, friction, steel.
#[derive(Debug, Clone, Args, Default)]
pub struct WishArgs {
    /// Bore of the inner race, diameter, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    pub bore: Option<f64>,
    /// Nominal torque, carried day by day, Nm
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = number)]
    pub torque: Option<f64>,
    /// Peak torque, at the worst, Nm; in place of --torque or beside it
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = number)]
    pub peak: Option<f64>,
    /// Peak torque over nominal torque, where only one of them is named [default: 1.3, or that of the purpose]
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true, value_parser = number)]
    pub safety: Option<f64>,
    /// Largest outer diameter, mm [default: 1.4 times the outer track]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    pub outside: Option<f64>,
    /// Largest width of the races, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    pub width: Option<f64>,
    /// Speed of the outer race up to which the sprags keep contact in overrun, rpm; 0: not asked
    #[arg(
        long = "keep-contact-rpm",
        visible_alias = "speed",
        value_name = "RPM",
        allow_hyphen_values = true
    )]
    pub keep_contact: Option<f64>,
    /// Speed of the outer race by which the sprags must be off the inner race, rpm; 0: they stay on
    #[arg(long = "lift-off-rpm", value_name = "RPM", allow_hyphen_values = true, value_parser = number)]
    pub lift_off: Option<f64>,
    /// Speed of the inner race in overrun, rpm: for drag and heat
    #[arg(long = "inner-rpm", value_name = "RPM", allow_hyphen_values = true, value_parser = number)]
    pub inner: Option<f64>,
    /// Speed of the outer race in overrun, rpm, in the same sense [default: that of --keep-contact-rpm]
    #[arg(long = "outer-rpm", value_name = "RPM", allow_hyphen_values = true, value_parser = number)]
    pub outer: Option<f64>,
    /// Refused with the two that are meant.
    #[arg(long = "overrun-rpm", value_name = "RPM", hide = true, value_parser = which_race)]
    pub overrun: Option<f64>,
    /// Static friction [default: 0.11, by GMN 9050]
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = number)]
    pub friction: Option<f64>,
    /// Steel of sprags and races, by its name in `materials` [default: 100Cr6]; brings the allowed stresses
    #[arg(long, value_name = "STEEL", value_parser = a_steel)]
    pub material: Option<&'static Steel>,
}

fn which_race(_: &str) -> Result<f64, String> {
    Err("in overrun one race runs past the other: name the speeds, --inner-rpm and --outer-rpm".to_owned())
}

impl WishArgs {
    /// The same in SI; nothing but the unit changes.
    pub fn wish(&self) -> Wish {
        let m = |mm: Option<f64>| mm.map(|mm| mm / 1e3);
        let rad_s = |rpm: Option<f64>| rpm.map(rad_s);
        Wish {
            bore_m: m(self.bore),
            torque_nm: self.torque,
            peak_nm: self.peak,
            peak_over_nominal: self.safety,
            outside_m: m(self.outside),
            width_m: m(self.width),
            inner_rad_s: rad_s(self.inner),
            outer_rad_s: rad_s(self.outer),
            keep_contact_rad_s: rad_s(self.keep_contact),
            lift_off_rad_s: rad_s(self.lift_off),
            friction: self.friction,
            steel: self.material,
            ..Wish::default()
        }
    }

    /// Options without which there is no question, as typed.
    pub fn missing(&self) -> Vec<&'static str> {
        let mut missing = Vec::new();
        if self.bore.is_none() {
            missing.push("--bore MM");
        }
        if self.torque.is_none() && self.peak.is_none() {
            missing.push("--torque NM or --peak NM");
        }
        missing
    }

    /// Refuse a factor beside both torques that it joins, and one that makes the peak the lower.
    ///
    /// # Errors
    /// [`Failure::Malformed`].
    pub fn check_safety(&self) -> Result<(), Failure> {
        match self.safety {
            Some(_) if self.torque.is_some() && self.peak.is_some() => Err(Failure::malformed(
                "--safety: it is --peak over --torque, and both are named; leave one of the three",
            )),
            Some(safety) if !(1.0..=10.0).contains(&safety) => {
                Err(Failure::malformed(format!("--safety: found {safety}; allowed: 1 to 10")))
            }
            _ => Ok(()),
        }
    }
}

/// A steel of the library, by name.
pub fn a_steel(name: &str) -> Result<&'static Steel, String> {
    steel(name).ok_or_else(|| {
        let names: Vec<&str> = STEELS.iter().map(|s| s.name).collect();
        let like = nearest(name, &names).map_or(String::new(), |like| format!("did you mean {like}? "));
        format!("{like}the library has {}", names.join(", "))
    })
}

/// Arguments of `size`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SizeArgs {
    /// What the clutch shall do.
    #[command(flatten)]
    pub wish: WishArgs,
    /// Where to write the design file
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: PathBuf,
}

impl Run for SizeArgs {
    const WITHOUT: Without = ("it makes a design, it reads none", &["set"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let missing = self.wish.missing();
        if !missing.is_empty() {
            return Err(Failure::malformed(format!("needed: {}", missing.join(", "))));
        }
        self.wish.check_safety()?;
        let wanted = self.wish.wish().requirements();
        made::refuse(&wanted)?;
        may_write(&self.output, context)?;
        made::answer(&wanted, &self.output, "First design", context)
    }
}

/// Refuse an output that cannot be written, or that would cost somebody's work.
///
/// # Errors
/// [`Failure::Malformed`].
pub fn may_write(output: &Path, context: &Context) -> Result<(), Failure> {
    context.outputs.refuse_work(output)?;
    context.outputs.check(&[], &[(output, FileKind::Design)])?;
    context.outputs.refuse_foreign()
}
