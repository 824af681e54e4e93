//! A design as a unit for co-simulation: its archive, and what it leaves out.

use super::Envelope;
use super::left_out::LeftOut;
use crate::design::Design;
use crate::export::fmu::{Fmi, HistoryReader, NoUnit, UnitArchive, archive, inertias_beyond, variables};
use serde::Serialize;

/// A unit for co-simulation.
#[derive(Debug, Clone)]
pub struct CoSimulationUnit<'a> {
    design: &'a Design,
    fmi: Fmi,
    /// The file, and its platform.
    pub archive: UnitArchive,
    /// Variables that another program sees.
    pub variables: usize,
    /// Names of the `[[drivetrain]]` that it leaves out.
    pub train: Vec<String>,
}

/// The answer by its keys in JSON.
#[derive(Debug, Clone, Serialize)]
pub struct CoSimulationBody {
    format: &'static str,
    fmi: &'static str,
    platform: String,
    written: Option<String>,
    bytes: usize,
    variables: usize,
}

impl Design {
    /// The clutch between its flanges as a unit around `library`, the compiled library of this version; `read` gives the bytes of
    /// a history. A `[[drivetrain]]` is left out.
    ///
    /// # Errors
    /// [`NoUnit`].
    pub fn co_simulation_unit(
        &self,
        fmi: Fmi,
        library: &[u8],
        read: HistoryReader<'_>,
    ) -> Result<CoSimulationUnit<'_>, NoUnit> {
        let archive = archive(self, fmi, library, read)?;
        Ok(CoSimulationUnit {
            design: self,
            fmi,
            archive,
            variables: variables(self).len(),
            train: inertias_beyond(self),
        })
    }
}

impl<'a> CoSimulationUnit<'a> {
    fn version(&self) -> &'static str {
        if self.fmi == Fmi::Two { "2.0" } else { "3.0" }
    }

    /// In a sentence.
    pub fn words(&self) -> String {
        format!(
            "FMI {} co-simulation, {}, {} variables, {:.1} MB",
            self.version(),
            self.archive.platform,
            self.variables,
            self.archive.bytes.len() as f64 * 1e-6
        )
    }

    /// The answer with the keys that all answers share; `run_time_s`: what it took, s; `written`: where the file is.
    pub fn envelope(&self, run_time_s: f64, written: Option<String>) -> Envelope<'a, CoSimulationBody> {
        let body = CoSimulationBody {
            format: "fmu",
            fmi: self.version(),
            platform: self.archive.platform.clone(),
            written,
            bytes: self.archive.bytes.len(),
            variables: self.variables,
        };
        Envelope {
            design: self.design,
            run_time_s,
            left_out: left_out(&self.train),
            error_estimate: None,
            body,
        }
    }
}

fn left_out(train: &[String]) -> Vec<LeftOut> {
    let mut all = vec![LeftOut::new(
        "growth of the races with their speed",
        "it stays that of start.speed; the centrifugal force on the sprags follows the motion",
        "2 um at the outer track from rest to 20 000 rpm (clutch of Table 1)",
    )];
    if !train.is_empty() {
        all.push(LeftOut::new(
            "drivetrain",
            &format!("left out as asked: {}", train.join(", ")),
            "everything that they do, until the other program has them at the flanges",
        ));
    }
    all
}
