//! The command line as typed: told again in reports, and refused where an option lacks its value.

use super::{command, output};
use crate::file::unprintable;

/// The command line as a shell would take it again, on one line; the program by its name, not by its path, and without what only keeps
/// it quiet.
pub(super) fn command_line(args: impl Iterator<Item = String>) -> String {
    let quoted = |arg: String| {
        let plain = |c: char| c.is_alphanumeric() || "-_./=,:+@%".contains(c);
        if !arg.is_empty() && arg.chars().all(plain) {
            arg
        } else if arg.chars().any(unprintable) {
            // What bash, zsh and ksh read back as these characters.
            let escaped = |c: char| match c {
                '\\' | '\'' => format!("\\{c}"),
                '\n' => "\\n".to_owned(),
                c if unprintable(c) => format!("\\u{:04x}", u32::from(c)),
                c => c.to_string(),
            };
            format!("$'{}'", arg.chars().map(escaped).collect::<String>())
        } else {
            format!("'{}'", arg.replace('\'', "'\\''"))
        }
    };
    let told = args.skip(1).filter(|arg| !matches!(arg.as_str(), "--quiet" | "-q"));
    std::iter::once(output::TOOL.to_owned()).chain(told.map(quoted)).collect::<Vec<_>>().join(" ")
}

/// The refusal of an option without its value. Options for numbers take what begins with a hyphen, so that -1e-6 is
/// refused as a number; they would take the next option too.
pub(super) fn missing_value(args: &[String]) -> Option<clap::Error> {
    let mut root = command();
    root.build();
    let command = args.iter().skip(1).find_map(|arg| root.find_subcommand(arg)).cloned()?;
    let option = |text: &str| {
        let name = text.split('=').next().unwrap_or(text);
        command.get_arguments().find(|a| {
            a.get_long().is_some_and(|long| name.strip_prefix("--") == Some(long))
                || a.get_short().is_some_and(|short| name == format!("-{short}"))
        })
    };
    // Behind -- there are no options.
    let until = args.iter().position(|arg| arg == "--").unwrap_or(args.len());
    let pair = args[..until].windows(2).find(|pair| {
        let greedy =
            option(&pair[0]).is_some_and(|a| a.is_allow_hyphen_values_set() && !pair[0].contains('='));
        greedy && option(&pair[1]).is_some()
    })?;
    let message = format!("a value is required for '{}' but none was supplied", option(&pair[0])?);
    Some(command.clone().error(clap::error::ErrorKind::InvalidValue, message))
}
