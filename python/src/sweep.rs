//! What tables of margins show: the map of a sweep.

use crate::errors::json;
use crate::pool::compute;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::json as object;
use sprag_design::Follow;
use sprag_design::answer::sweep::{NoTable, SweepMap};
use std::fs::File;
use std::path::PathBuf;

/// The map of parts of one sweep as JSON, and its planes: names of the two variables, edges of the tiles, and of each tile,
/// row by row from the lowest, points, points held, best value.
#[pyfunction]
pub fn map_tables(
    py: Python<'_>,
    tables: Vec<PathBuf>,
    by: String,
    over: Vec<(String, String)>,
) -> PyResult<(String, String)> {
    let follow = Follow::new();
    let stop = follow.clone();
    let map =
        compute(py, &follow, move || mapped(&tables, &by, &over, &stop))?.map_err(PyValueError::new_err)?;
    let planes: Vec<_> = map
        .pairs
        .iter()
        .map(|pair| {
            let [x, y] = pair.axes.map(|axis| &map.variables[axis]);
            let code = |decides: usize| map.deciding[decides].0.as_str();
            object!({
                "x": x.name, "y": y.name, "x_edges": x.edges(), "y_edges": y.edges(),
                "points": pair.tiles.iter().map(|t| t.points).collect::<Vec<_>>(),
                "held": pair.tiles.iter().map(|t| t.held).collect::<Vec<_>>(),
                "best": pair.tiles.iter().map(|t| t.best).collect::<Vec<_>>(),
                "decides": pair.tiles.iter().map(|t| t.decides.map(code)).collect::<Vec<_>>(),
            })
        })
        .collect();
    Ok((json(&map.object())?, json(&planes)?))
}

/// Both readings.
fn mapped(
    tables: &[PathBuf],
    by: &str,
    over: &[(String, String)],
    stop: &Follow,
) -> Result<SweepMap, String> {
    let mut map = SweepMap::of(by);
    let each = |read: &mut dyn FnMut(File) -> Result<(), NoTable>| {
        tables.iter().try_for_each(|path| {
            let name = path.display();
            if stop.stopped() {
                return Err("stopped".to_owned());
            }
            let file = File::open(path).map_err(|why| format!("{name}: cannot be read: {why}"))?;
            read(file).map_err(|why| format!("{name}: {why}"))
        })
    };
    each(&mut |file| map.survey(file))?;
    let over: Vec<[String; 2]> = over.iter().map(|(x, y)| [x.clone(), y.clone()]).collect();
    map.lay_out(&over).map_err(|why| why.to_string())?;
    each(&mut |file| map.add(file))?;
    Ok(map)
}
