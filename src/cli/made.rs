//! What `size` and `new` do with an answer: write the design, print figures and alternatives.

use super::context::{Context, timed};
use super::exit::{Exit, Failure};
use super::origin::FileKind;
use crate::answer::sizing::{Sizing, tried};
use crate::scenario::Settings;
use crate::size::{NoSize, Requirements, Sized, size};
use serde_json::json;
use std::path::Path;

/// Refuse what no clutch can be asked for.
///
/// # Errors
/// [`Failure::Malformed`] naming the option.
pub fn refuse(wanted: &Requirements) -> Result<(), Failure> {
    wanted.check().map_err(|why| Failure::malformed(format!("--{why}")))
}

/// Compute, write, print; `title`: that of the page. What was found, too.
///
/// # Errors
/// [`Failure`].
pub fn answer(
    wanted: &Requirements,
    output: &Path,
    title: &str,
    context: &Context,
) -> Result<(Exit, Option<Sized>), Failure> {
    let settings = Settings { follow: context.follow.unseen(), ..Settings::default() };
    let (sized, run_time_s) = timed(|| size(wanted, &settings));
    if context.follow.stopped() {
        return Err(Failure::Interrupted);
    }
    let sized = match sized {
        Ok(sized) => sized,
        Err(NoSize::Requirements(_)) => return refuse(wanted).map(|()| (Exit::Failed, None)),
        Err(ref why @ NoSize::None { tried: ref list, .. }) => {
            let why = why.to_string().replace("`width`", "--width").replace("`outside`", "--outside");
            let rows = tried(list, None);
            let table = rows.clone().table();
            context.object(|| json!({ "sized": false, "why": why, "tried": rows.objects() }))?;
            context.outputs.write_csv(&table);
            context.answer(&format!("{}\n{why}\n", table.to_text(context.screen)))?;
            return Ok((Exit::NotHeld, None));
        }
    };
    let written = context.outputs.write(output, FileKind::Design, sized.made.design.source.as_bytes());
    let written = written.then(|| output.display().to_string());
    let exit = context.deliver(&Sizing::of(&sized, title, written.as_deref()), run_time_s)?;
    Ok((exit, Some(sized)))
}
