//! A design file as what surrounds a sprag of another clutch: every number in it is a guess there, and says so.
//!
//! In: text. Out: text. Absent: which tables say nothing of another clutch (the caller names them). Equations: none.

use super::edit::{EditError, parse, without_keys};
use toml_edit::{Item, Table};

/// What stands behind a guess stands there, in columns of text.
const COLUMN: usize = 36;

/// The text under another name, without the tables and keys at the dotted paths `without` and without its own comments. Behind each number
/// and word that is left stands that it is a guess, and `from` where; not behind those at `given`.
///
/// # Errors
/// [`EditError::Syntax`].
pub fn as_guesses(
    source: &str,
    name: &str,
    without: &[&str],
    given: &[&str],
    from: &str,
) -> Result<String, EditError> {
    let mut document = parse(&without_keys(source, without)?)?;
    document.set_trailing("");
    let root = document.as_table_mut();
    root.insert("name", Item::Value(name.into()));
    for (mut key, item) in root.iter_mut() {
        key.leaf_decor_mut().clear();
        let table = key.get().to_owned();
        match item {
            Item::Table(rows) => {
                rows.decor_mut().set_prefix("\n");
                guesses(rows, &table, given, from);
            }
            Item::Value(value) => value.decor_mut().clear(),
            _ => {}
        }
    }
    Ok(document.to_string())
}

fn guesses(rows: &mut Table, table: &str, given: &[&str], from: &str) {
    for (mut key, item) in rows.iter_mut() {
        key.leaf_decor_mut().clear();
        let path = format!("{table}.{}", key.get());
        let Some(value) = item.as_value_mut() else { continue };
        value.decor_mut().clear();
        if !given.contains(&path.as_str()) {
            let width = key.get().len() + 3 + value.to_string().trim().len();
            let blanks = " ".repeat(COLUMN.saturating_sub(width).max(1));
            value.decor_mut().set_suffix(format!("{blanks}# guess, {from}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_a_guess_and_says_so() {
        let source = "# Why.\nschema = 1\nname = \"One\"\n\n# Rings.\n[races]\ninner_radius_mm = 30.0  # as made\nouter_radius_mm = 38.33\n\n\
                      [races.eccentricity]\noffset_mm = 0.1\n\n[limits]\npeak_torque_nm = 9.0\n# The end.\n";
        let text = as_guesses(
            source,
            "other",
            &["limits", "races.eccentricity"],
            &["races.outer_radius_mm"],
            "as x.toml",
        );
        let wanted = "schema = 1\nname = \"other\"\n\n[races]\ninner_radius_mm = 30.0              # guess, as x.toml\nouter_radius_mm = 38.33\n";
        assert_eq!(text.unwrap(), wanted);
    }
}
