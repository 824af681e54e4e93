//! The live page: questions about the text of a design, answered at once, and the page that asks them.
//!
//! In: the text of a design file, a pinned one beside it. Out: [`StudioView`], [`SceneView`], changed texts; the page. Absent: the server,
//! paths. Equations: none; every figure is that of `margin`, `wedge` and `scenario`.

mod engine;
mod fields;
mod scene;
mod search;
mod session;
mod view;

pub use engine::{Engine, StudioRefusal};
pub use fields::{Field, fields};
pub use scene::{SceneRow, SceneView};
pub use search::{SearchProgress, Searching};
pub use session::{Session, ToSave};
pub use view::{MarginColour, MarginRow, Pose, StudioView};

/// The page as one file; what is between the marks `<!--engine-->` is put in by whoever serves it.
pub fn page() -> String {
    include_str!("page.html")
        .replace("/*style*/", concat!(include_str!("../report/page.css"), "\n", include_str!("studio.css")))
        .replace("/*script*/", include_str!("studio.js"))
}
