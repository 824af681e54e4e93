use super::command_line::command_line;
use super::*;

fn parse(line: &str) -> Result<Cli, clap::Error> {
    Cli::from_arg_matches(&command().try_get_matches_from(line.split_whitespace())?)
}

#[test]
fn the_commands_are_consistent() {
    command().debug_assert();
}

#[test]
fn every_worked_example_of_the_help_parses() {
    // The raw texts: printed help is wrapped to the terminal.
    let command = command();
    let after = |c: &clap::Command| c.get_after_help().map(ToString::to_string).unwrap_or_default();
    let texts: Vec<String> = command.get_subcommands().map(after).chain([after(&command)]).collect();
    let mut count = 0;
    for line in texts.iter().flat_map(|t| t.lines()).map(str::trim).filter(|l| l.starts_with("sprag-design "))
    {
        // What the shell takes for itself is not for clap.
        let line = line.split([';', '|', '>']).next().unwrap();
        if let Err(e) = parse(line) {
            panic!("{line}: {e}");
        }
        count += 1;
    }
    assert!(count >= 12, "{count} examples");
}

#[test]
fn lists_and_common_flags_are_read_behind_the_command() {
    let cli = parse("sprag-design stiffness a.toml --contact roller,slice --torques 3.34,50 --json --csv c.csv -q --threads 2")
        .unwrap();
    let Command::Stiffness(args) = cli.command else { panic!() };
    assert_eq!(args.contact, [crate::clutch::LawName::Roller, crate::clutch::LawName::Slice]);
    assert_eq!(args.torques, [3.34, 50.0]);
    assert!(cli.common.json && cli.common.quiet && cli.common.threads == Some(2));
}

#[test]
fn senseless_flags_are_refused_with_code_2() {
    for line in [
        "sprag-design",
        "sprag-design check",
        "sprag-design stiffness a.toml --torques 1,nan",
        "sprag-design stiffness a.toml --torques 1,-2",
        "sprag-design stiffness a.toml --max-torque inf",
        "sprag-design stiffness a.toml --torques 1 --max-torque 2",
        "sprag-design stiffness a.toml --contact balls",
        "sprag-design simulate a.toml --scenario s --step 0",
        "sprag-design check a.toml --threads 0",
        "sprag-design check a.toml --frob",
    ] {
        let error = parse(line).expect_err(line);
        assert_eq!(error.exit_code(), 2, "{line}");
    }
}

#[test]
fn the_command_line_can_be_pasted_back() {
    let args =
        ["/usr/bin/sprag-design", "check", "my design.toml", "--csv", "it's.csv", ""].map(String::from);
    assert_eq!(
        command_line(args.into_iter()),
        r#"sprag-design check 'my design.toml' --csv 'it'\''s.csv' ''"#
    );
}

/// A comment of a written design holds the command line: a line break in it would end the comment.
#[test]
fn the_command_line_is_one_line_of_printable_text() {
    let args = ["x", "check", "a\nb it's\u{1b}[31m\\.toml", "\u{202e}"].map(String::from);
    assert_eq!(
        command_line(args.into_iter()),
        r"sprag-design check $'a\nb it\'s\u001b[31m\\.toml' $'\u202e'"
    );
}

#[test]
fn the_help_of_a_command_shows_only_what_it_takes() {
    for (name, without) in [
        ("materials", &["--report"][..]),
        ("schema", &["--csv", "--report"]),
        ("completions", &["--json", "--csv", "--report"]),
        ("evaluate", &["--json", "--report"]),
        ("sample", &["--json", "--report"]),
        ("check", &[]),
        ("size", &[]),
    ] {
        let mut root = command();
        root.build();
        let help = root.find_subcommand(name).unwrap().clone().render_long_help().to_string();
        for flag in ["--json", "--csv", "--report"] {
            assert_eq!(
                help.contains(&format!("{flag} ")) || help.contains(&format!("{flag}\n")),
                !without.contains(&flag),
                "{name} {flag}: {help}"
            );
        }
    }
}
