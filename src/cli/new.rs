//! `new` and `size`: the own clutch, by questions or by options.

use super::exit::{Exit, Failure};
use super::interrupt::next;
use super::origin::FileKind;
use super::output;
use super::{Context, Run, Without, made, number};
use crate::answer::sizing::{Taken, taken};
use crate::file::a_steel;
use crate::follow::Follow;
use crate::material::STEELS;
use crate::report::plain;
use crate::size::{ASKED, BadRequirement, PURPOSES, Purpose, Requirements, Sized, Wish, WishNumber, purpose};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgMatches, Args, FromArgMatches};
use std::io::{BufRead, IsTerminal};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};

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

const SIZE_EXAMPLES: &str = "\
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

/// What a clutch shall do: an option for each number of the table, with or without those of a purpose.
#[derive(Debug, Clone, Copy)]
pub struct WishArgs<const OF_PURPOSE: bool>(Wish);

/// Arguments of `new`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct NewArgs {
    /// What it shall do.
    #[command(flatten)]
    pub wish: WishArgs<true>,
    /// Where to write the design file
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
}

/// Arguments of `size`.
#[derive(Debug, Clone, Args)]
#[command(after_help = SIZE_EXAMPLES)]
pub struct SizeArgs {
    /// What it shall do.
    #[command(flatten)]
    pub wish: WishArgs<false>,
    /// Where to write the design file
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: PathBuf,
}

impl<const OF_PURPOSE: bool> WishArgs<OF_PURPOSE> {
    fn numbers() -> impl Iterator<Item = &'static WishNumber> {
        ASKED.iter().filter(|row| OF_PURPOSE || !row.of_purpose)
    }
}

impl<const OF_PURPOSE: bool> Args for WishArgs<OF_PURPOSE> {
    fn augment_args(command: clap::Command) -> clap::Command {
        let named = |key, place| Arg::new(key).long(key).value_name(place);
        let purposes = PossibleValuesParser::new(PURPOSES.map(|p| p.name)).map(|name| purpose(&name));
        let purpose = named("for", "PURPOSE").value_parser(purposes).help("What the clutch is for");
        let numbers = Self::numbers().map(|row| {
            let arg = named(row.key, row.place).allow_hyphen_values(true).value_parser(number);
            let arg = arg.help(format!("{}{}", row.words, row.help));
            row.alias.into_iter().fold(arg, Arg::visible_alias)
        });
        let steel = named("material", "STEEL").value_parser(a_steel).help(
            "Steel of sprags and races, by its name in `materials` [default: 100Cr6]; brings the allowed stresses",
        );
        // Refused with the two that are meant.
        let overrun = named("overrun-rpm", "RPM").hide(true).value_parser(which_race);
        command.args(OF_PURPOSE.then_some(purpose)).args(numbers).args([steel, overrun])
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}

impl<const OF_PURPOSE: bool> FromArgMatches for WishArgs<OF_PURPOSE> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut wish = Wish { steel: matches.get_one("material").copied(), ..Wish::default() };
        if OF_PURPOSE {
            wish.purpose = matches.get_one::<Option<&'static Purpose>>("for").copied().flatten();
        }
        for row in Self::numbers() {
            *(row.at)(&mut wish) = matches.get_one::<f64>(row.key).map(|typed| row.unit.si(*typed));
        }
        Ok(Self(wish))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

fn which_race(_: &str) -> Result<f64, String> {
    Err("in overrun one race runs past the other: name the speeds, --inner-rpm and --outer-rpm".to_owned())
}

impl Run for SizeArgs {
    const WITHOUT: Without = ("it makes a design, it reads none", &["set"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let missing = missing(&self.wish.0);
        if !missing.is_empty() {
            return Err(Failure::malformed(format!("needed: {}", missing.join(", "))));
        }
        sized(&self.wish.0, &self.output, "First design", context).map(|(_, (exit, _))| exit)
    }
}

impl Run for NewArgs {
    const WITHOUT: Without = ("it makes a design, it reads none", &["set"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let (mut wish, mut output) = (self.wish.0, self.output.clone());
        let mut missing = missing(&wish);
        if wish.purpose.is_none() {
            missing.insert(0, "--for PURPOSE");
        }
        if output.is_none() {
            missing.push("-o NEW.toml");
        }
        if !missing.is_empty() {
            if !std::io::stdin().is_terminal() || context.json {
                return Err(Failure::malformed(format!(
                    "needed: {}; on a terminal, without them, `new` asks",
                    missing.join(", ")
                )));
            }
            wish.check_ratio().map_err(refused)?;
            Questions { lines: lines(), follow: &context.follow, force: context.outputs.force }
                .fill(&mut wish, &mut output)?;
        }
        let Some(output) = output else { return Err(Failure::malformed("needed: -o NEW.toml")) };
        let (wanted, (exit, found)) = sized(&wish, &output, "New clutch", context)?;
        let taken = taken(&wanted, found.as_ref());
        let wide = taken.iter().map(|row| row.value.chars().count()).fold(12, usize::max);
        let line = |row: &Taken| format!("  {:<22} {:<wide$} {}\n", row.what, row.value, row.from);
        let lines: String = taken.iter().map(line).collect();
        if !lines.is_empty() {
            context.answer(&format!(
                "\nTaken where nothing was said (an option of `new --help` says otherwise):\n{lines}"
            ))?;
        }
        if exit == Exit::Held && context.outputs.unwritten().is_empty() {
            let path = output::path_text(&output);
            let further = wish.purpose.map_or(&[][..], |p| p.ask).iter().map(|ask| command(ask));
            let asked = wish.engagements.map(|_| "life {}".to_owned());
            let next = ["studio {}", "check {}", "optimize {} -o better.toml", "sheet {}"]
                .map(str::to_owned)
                .into_iter();
            let lines = next
                .chain(further)
                .chain(asked)
                .map(|c| format!("  sprag-design {}\n", c.replace("{}", &path)));
            context.answer(&format!("\nNext:\n{}", lines.collect::<String>()))?;
        }
        Ok(exit)
    }
}

/// A command of its own next question, {} for the file.
fn command(ask: &str) -> String {
    let options = match ask {
        "simulate" => " --scenario engage",
        "feed" => " --stroke DEGREES --brake NM --inertia KGM2 --frequency HZ",
        _ => "",
    };
    format!("{ask} {{}}{options}")
}

/// Options without which there is no question, as typed.
fn missing(wish: &Wish) -> Vec<&'static str> {
    let bore = wish.bore_m.is_none().then_some("--bore MM");
    let torque = (wish.torque_nm.is_none() && wish.peak_nm.is_none()).then_some("--torque NM or --peak NM");
    bore.into_iter().chain(torque).collect()
}

fn refused(why: BadRequirement) -> Failure {
    Failure::malformed(format!("--{why}"))
}

/// Size what is wished; `title`: that of the page.
fn sized(
    wish: &Wish,
    output: &Path,
    title: &str,
    context: &Context,
) -> Result<(Requirements, (Exit, Option<Sized>)), Failure> {
    let wanted = wish.check().map_err(refused)?;
    context.outputs.refuse_work(output)?;
    context.outputs.check(&[], &[(output, FileKind::Design)])?;
    context.outputs.refuse_foreign()?;
    made::answer(&wanted, output, title, context).map(|found| (wanted, found))
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

struct Questions<'a> {
    lines: Receiver<String>,
    follow: &'a Follow,
    force: bool,
}

impl Questions<'_> {
    /// Ask for everything that nobody has said.
    fn fill(&self, wish: &mut Wish, output: &mut Option<PathBuf>) -> Result<(), Failure> {
        if wish.purpose.is_none() {
            for p in &PURPOSES {
                output::note(&format!("  {:<11} {}", p.name, p.words));
            }
            wish.purpose = self.until("What is it for?", |line| match purpose(line) {
                Some(found) => Ok(Some(found)),
                None => Err(format!("one of {}", PURPOSES.map(|p| p.name).join(", "))),
            })?;
        }
        self.numbers(wish)?;
        if wish.steel.is_none() {
            let names = STEELS.map(|s| s.name).join(", ");
            let question = format!("Steel: {names} [{}]", wish.requirements().steel.name);
            wish.steel = self.until(&question, |line| match line {
                "" => Ok(None),
                name => a_steel(name).map(Some),
            })?;
        }
        if output.is_none() {
            let name = format!("{}.toml", wish.purpose.map_or("clutch", |p| p.name));
            let question = format!("Write to [{name}]");
            let path = self.until(&question, |line| {
                let path = PathBuf::from(if line.is_empty() { &name } else { line });
                match path.exists() && !self.force {
                    true => Err(format!("{} exists; name another file", path.display())),
                    false => Ok(path),
                }
            })?;
            *output = Some(path);
        }
        Ok(())
    }

    /// Every number that is asked for one by one. What one does not fit to is asked again from there on.
    fn numbers(&self, wish: &mut Wish) -> Result<(), Failure> {
        let mut at = 0;
        while let Some(row) = ASKED.get(at) {
            if let (Some(adds), None) = (row.question, (row.at)(wish)) {
                let value = self.number(row, adds, wish)?;
                *(row.at)(wish) = value;
            }
            let Err(why) = wish.check_up_to(row.key) else {
                at += 1;
                continue;
            };
            output::note(&format!("  {why}"));
            let first = ASKED.iter().position(|row| row.key == why.what).unwrap_or(at).min(at);
            for again in &ASKED[first..=at] {
                if again.question.is_some() {
                    *(again.at)(wish) = None;
                }
            }
            at = first;
        }
        Ok(())
    }

    /// A number, SI; `None`: what stands in brackets.
    fn number(&self, row: &WishNumber, adds: &str, wish: &Wish) -> Result<Option<f64>, Failure> {
        let without = row.default(&wish.requirements());
        let shown = match (without, row.needed) {
            (Some(value), _) => format!(" [{}]", plain(value, 6)),
            (None, true) => String::new(),
            (None, false) => " [none]".to_owned(),
        };
        let fits = |wish: &Wish| row.check(&wish.requirements()).map_err(|why| why.to_string());
        self.until(&format!("{}{adds}{shown}", row.words), |line| {
            if line.is_empty() {
                if row.needed && without.is_none() {
                    return Err("a number is needed".to_owned());
                }
                // What came before may leave no room for what stands in brackets.
                return without.map_or(Ok(()), |_| fits(wish)).map(|()| None);
            }
            let typed = line.replace(',', ".").parse::<f64>().map_err(|_| "not a number".to_owned())?;
            let mut with = *wish;
            *(row.at)(&mut with) = Some(row.unit.si(typed));
            fits(&with).map(|()| *(row.at)(&mut with))
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
        let ended = || Failure::malformed("the answers ended before the last question");
        next(&self.lines, self.follow)?.ok_or_else(ended)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is wished after these answers.
    fn asked(answers: &[&str]) -> Wish {
        let (send, lines) = channel();
        for answer in answers {
            send.send((*answer).to_owned()).unwrap();
        }
        drop(send);
        let follow = Follow::nobody();
        let mut wish = Wish { purpose: purpose("starter"), ..Wish::default() };
        Questions { lines, follow: &follow, force: false }.numbers(&mut wish).unwrap();
        wish
    }

    #[test]
    fn a_bore_in_inches_is_asked_again_once_the_peak_torque_shows_it() {
        // Bore, nominal, peak; then these three again, and the rest as it stands.
        let mut answers = vec!["1.5", "", "900", "40", "", "900"];
        answers.resize(answers.len() + 11, "");
        let wish = asked(&answers);
        assert_eq!((wish.bore_m, wish.peak_nm), (Some(0.04), Some(900.0)));
        assert!(wish.check().is_ok());
    }

    #[test]
    fn a_lift_off_that_cannot_be_is_asked_again_at_once() {
        let before = ["40", "", "900", "", "", ""];
        // The outer race turns at 600 rpm: off by 900, as a starter is, cannot be; 500 can.
        let answers = [&before[..], &["600", "", "", "500", "", "", "", ""]].concat();
        let wish = asked(&answers);
        assert!((rpm_of(wish.lift_off_rad_s) - 500.0).abs() < 1e-9, "{wish:?}");
        assert!(wish.check().is_ok());
        // Contact beyond the speed at which sprags of this purpose are off.
        let answers = [&before[..], &["", "1500", "300", "", "", "", "", ""]].concat();
        let wish = asked(&answers);
        assert!((rpm_of(wish.keep_contact_rad_s) - 300.0).abs() < 1e-9, "{wish:?}");
        assert!(wish.check().is_ok());
    }

    fn rpm_of(speed: Option<f64>) -> f64 {
        crate::design::rpm(speed.unwrap_or(0.0))
    }
}
