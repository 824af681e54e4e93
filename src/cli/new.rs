//! `new`: the own clutch, by questions or by flags.

use super::exit::{Exit, Failure};
use super::output;
use super::size::{WishArgs, a_steel, may_write};
use super::{Context, Run, Without, made, number};
use crate::design::rpm;
use crate::follow::Follow;
use crate::material::STEELS;
use crate::report::plain;
use crate::size::{PURPOSES, Purpose, Requirements, Wish, purpose};
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::io::{BufRead, IsTerminal};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  sprag-design new
  sprag-design new --for starter --bore 40 --peak 900 -o starter.toml
  sprag-design new --for indexing --bore 30 --torque 200 --outside 80 --width 25 -o indexing.toml

On a terminal it asks for what no option has said; a question without an answer takes what stands in brackets. Elsewhere, or
where --for, --bore, a torque and -o are given, it asks nothing. What nobody says comes of the purpose: its factor of peak
torque, speeds, swing and engagement stand in the file, each number that is a guess with a comment that says so. The file
is sized as by `size`; a file that is there already is replaced only with --force.

Exit codes: 0 written; 1 no clutch of the family does it, with the limit that prevents it and the nearest possible.";

/// Arguments of `new`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct NewArgs {
    /// What the clutch is for
    #[arg(long = "for", value_name = "PURPOSE", value_parser = PossibleValuesParser::new(PURPOSES.map(|p| p.name)))]
    pub purpose: Option<String>,
    /// What it shall do.
    #[command(flatten)]
    pub wish: WishArgs,
    /// Amplitude by which the torque swings, Nm, up to nominal torque; 0: it does not [default: that of the purpose]
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = number)]
    pub swing: Option<f64>,
    /// How often it swings, Hz: strokes a second, blades passing, orders of an engine [default: that of the purpose]
    #[arg(long = "swing-hz", value_name = "HZ", allow_hyphen_values = true, value_parser = number)]
    pub swing_hz: Option<f64>,
    /// Engagements in its life, at nominal torque: written into [life], for the command life
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = number)]
    pub engagements: Option<f64>,
    /// Where to write the design file
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
}

impl Run for NewArgs {
    const WITHOUT: Without = ("it makes a design, it reads none", &["set"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let mut args = self.clone();
        let missing = args.missing();
        if !missing.is_empty() {
            if !std::io::stdin().is_terminal() || context.json {
                return Err(Failure::malformed(format!(
                    "needed: {}; on a terminal, without them, `new` asks",
                    missing.join(", ")
                )));
            }
            args.wish.check_safety()?;
            Questions { lines: lines(), follow: &context.follow }.fill(&mut args)?;
        }
        args.wish.check_safety()?;
        let Some(output) = args.output.clone() else { return Err(Failure::malformed("needed: -o NEW.toml")) };
        let wanted = args.requirements();
        if wanted.swing.is_none() && args.swing.is_some_and(|nm| nm != 0.0) {
            return Err(Failure::malformed("--swing: how often it swings is not said; add --swing-hz"));
        }
        made::refuse(&wanted)?;
        may_write(&output, context)?;
        let exit = made::answer(&wanted, &output, "New clutch", context)?;
        let taken = wanted.taken();
        if !taken.is_empty() {
            let lines: String = taken
                .iter()
                .map(|(what, value, from)| format!("  {what:<22} {value:<12} {from}\n"))
                .collect();
            context.answer(&format!(
                "\nTaken where nothing was said (an option of `new --help` says otherwise):\n{lines}"
            ))?;
        }
        if exit == Exit::Held && context.outputs.unwritten().is_empty() {
            let path = output::path_text(&output);
            let further = self.purpose().map_or(&[][..], |p| p.ask).iter().copied();
            let asked = self.engagements.map(|_| "life {}");
            let next = ["studio {}", "check {}", "optimize {} -o better.toml", "sheet {}"].into_iter();
            let lines = next
                .chain(further)
                .chain(asked)
                .map(|c| format!("  sprag-design {}\n", c.replace("{}", &path)));
            context.answer(&format!("\nNext:\n{}", lines.collect::<String>()))?;
        }
        Ok(exit)
    }
}

impl NewArgs {
    fn missing(&self) -> Vec<&'static str> {
        let mut missing = Vec::new();
        if self.purpose.is_none() {
            missing.push("--for PURPOSE");
        }
        missing.extend(self.wish.missing());
        if self.output.is_none() {
            missing.push("-o NEW.toml");
        }
        missing
    }

    fn purpose(&self) -> Option<&'static Purpose> {
        self.purpose.as_deref().and_then(purpose)
    }

    fn requirements(&self) -> Requirements {
        let Self { swing, swing_hz, engagements, .. } = *self;
        Wish { purpose: self.purpose(), swing_nm: swing, swing_hz, engagements, ..self.wish.wish() }
            .requirements()
    }
}

/// Lines of standard input as they come: whoever waits for them can be stopped by Ctrl-C meanwhile.
fn lines() -> Receiver<String> {
    let (send, receive) = channel();
    std::thread::spawn(move || {
        for line in std::io::stdin().lock().lines().map_while(Result::ok) {
            if send.send(line).is_err() {
                break;
            }
        }
    });
    receive
}

/// A number that is asked for: question with unit, name of its option, where it is kept, what holds without an answer, and
/// whether there must be an answer.
struct Number {
    question: &'static str,
    what: &'static str,
    at: fn(&mut NewArgs) -> &mut Option<f64>,
    without: fn(&Requirements) -> Option<f64>,
    needed: bool,
}

const NUMBERS: [Number; 13] = [
    Number {
        question: "Bore of the inner race, diameter, mm",
        what: "bore",
        at: |a| &mut a.wish.bore,
        without: |_| None,
        needed: true,
    },
    Number {
        question: "Nominal torque, carried day by day, Nm (none: by the peak torque)",
        what: "torque",
        at: |a| &mut a.wish.torque,
        without: |_| None,
        needed: false,
    },
    Number {
        question: "Peak torque, at the worst, Nm",
        what: "peak",
        at: |a| &mut a.wish.peak,
        without: |wanted| Some(wanted.peak_nm).filter(|t| t.is_finite()),
        needed: true,
    },
    Number {
        question: "Largest outer diameter, mm (none: 1.4 times the outer track)",
        what: "outside",
        at: |a| &mut a.wish.outside,
        without: |_| None,
        needed: false,
    },
    Number {
        question: "Largest width of the races, mm (none: as wide as it must)",
        what: "width",
        at: |a| &mut a.wish.width,
        without: |_| None,
        needed: false,
    },
    Number {
        question: "Speed of the inner race in overrun, rpm",
        what: "inner-rpm",
        at: |a| &mut a.wish.inner,
        without: |wanted| Some(rpm(wanted.overrun_rad_s[0])),
        needed: false,
    },
    Number {
        question: "Speed of the outer race in overrun, in the same sense, rpm",
        what: "outer-rpm",
        at: |a| &mut a.wish.outer,
        without: |wanted| Some(rpm(wanted.overrun_rad_s[1])),
        needed: false,
    },
    Number {
        question: "Sprags keep contact up to this speed of the outer race, rpm (0: not asked)",
        what: "keep-contact-rpm",
        at: |a| &mut a.wish.keep_contact,
        without: |wanted| Some(rpm(wanted.keep_contact_rad_s.unwrap_or(0.0))),
        needed: false,
    },
    Number {
        question: "Sprags are off by this speed of the outer race, rpm (0: they stay on)",
        what: "lift-off-rpm",
        at: |a| &mut a.wish.lift_off,
        without: |wanted| Some(rpm(wanted.lift_off_rad_s.unwrap_or(0.0))),
        needed: false,
    },
    Number {
        question: "Amplitude by which the torque swings, up to nominal torque, Nm (0: it does not)",
        what: "swing",
        at: |a| &mut a.swing,
        without: |wanted| Some(wanted.swing.map_or(0.0, |s| s.amplitude_nm)),
        needed: false,
    },
    Number {
        question: "How often it swings, Hz: strokes a second, blades passing (none: it does not)",
        what: "swing-hz",
        at: |a| &mut a.swing_hz,
        without: |wanted| wanted.swing.map(|s| s.frequency_hz),
        needed: false,
    },
    Number {
        question: "Static friction",
        what: "friction",
        at: |a| &mut a.wish.friction,
        without: |wanted| Some(wanted.friction),
        needed: false,
    },
    Number {
        question: "Engagements in its life, at nominal torque (none: not said; written into [life], for the command life)",
        what: "engagements",
        at: |a| &mut a.engagements,
        without: |_| None,
        needed: false,
    },
];

struct Questions<'a> {
    lines: Receiver<String>,
    follow: &'a Follow,
}

impl Questions<'_> {
    /// Ask for everything that `args` do not say.
    fn fill(&self, args: &mut NewArgs) -> Result<(), Failure> {
        if args.purpose.is_none() {
            for p in &PURPOSES {
                output::note(&format!("  {:<11} {}", p.name, p.words));
            }
            args.purpose = Some(self.until("What is it for?", |line| match purpose(line) {
                Some(found) => Ok(found.name.to_owned()),
                None => Err(format!("one of {}", PURPOSES.map(|p| p.name).join(", "))),
            })?);
        }
        for number in &NUMBERS {
            if (number.at)(args).is_none() {
                let value = self.number(number, args)?;
                *(number.at)(args) = value;
            }
        }
        if args.wish.material.is_none() {
            let names = STEELS.map(|s| s.name).join(", ");
            let question = format!("Steel: {names} [{}]", args.requirements().steel.name);
            args.wish.material = self.until(&question, |line| match line {
                "" => Ok(None),
                name => a_steel(name).map(Some),
            })?;
        }
        if args.output.is_none() {
            let name = format!("{}.toml", args.purpose.as_deref().unwrap_or("clutch"));
            let question = format!("Write to [{name}]");
            let answer = self.until(&question, |line| Ok(line.to_owned()))?;
            args.output = Some(PathBuf::from(if answer.is_empty() { name } else { answer }));
        }
        Ok(())
    }

    fn number(&self, number: &Number, args: &NewArgs) -> Result<Option<f64>, Failure> {
        let without = (number.without)(&args.requirements());
        let shown = match (without, number.needed) {
            (Some(value), _) => format!(" [{}]", plain(value, 6)),
            (None, true) => String::new(),
            (None, false) => " [none]".to_owned(),
        };
        self.until(&format!("{}{shown}", number.question), |line| {
            if line.is_empty() {
                if number.needed && without.is_none() {
                    return Err("a number is needed".to_owned());
                }
                // What came before may leave no room for what stands in brackets.
                let fits = without.map_or(Ok(()), |_| args.requirements().check_one(number.what));
                return fits.map(|()| None).map_err(|why| why.to_string());
            }
            let value = line.replace(',', ".").parse::<f64>().map_err(|_| "not a number".to_owned())?;
            let mut with = args.clone();
            *(number.at)(&mut with) = Some(value);
            let checked = with.requirements().check_one(number.what);
            checked.map(|()| Some(value)).map_err(|why| why.to_string())
        })
    }

    /// Ask until the answer will do.
    fn until<T>(&self, question: &str, read: impl Fn(&str) -> Result<T, String>) -> Result<T, Failure> {
        loop {
            output::ask(&format!("{question}{} ", if question.ends_with('?') { "" } else { ":" }));
            match read(self.line()?.trim()) {
                Ok(answer) => return Ok(answer),
                Err(why) => output::note(&format!("  {why}")),
            }
        }
    }

    fn line(&self) -> Result<String, Failure> {
        loop {
            if self.follow.stopped() {
                return Err(Failure::Interrupted);
            }
            match self.lines.recv_timeout(Duration::from_millis(50)) {
                Ok(line) => return Ok(line),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Failure::malformed("the answers ended before the last question"));
                }
            }
        }
    }
}
