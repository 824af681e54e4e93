//! The archive of a unit: description, library, design file with its histories.

use super::{Fmi, MARK, MODEL, description};
use crate::design::Design;
use crate::element::{Beginning, Element, NoElement, Settings};
use crate::file::inputs;
use rawzip::{CompressionMethod, ZipArchiveWriter};
use std::env::consts::{ARCH, DLL_SUFFIX, OS};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Level of compression, 0 to 10: a second for the library.
const LEVEL: u8 = 7;

/// Why there is no unit.
#[derive(Debug, thiserror::Error)]
pub enum NoUnit {
    /// The clutch cannot begin at rest without load.
    #[error("{0}")]
    NoStart(NoElement),
    /// The standard has no name for this platform.
    #[error("co-simulation units have no name for this platform ({OS}, {ARCH})")]
    Platform,
    /// These bytes are no library of a unit of this version.
    #[error("found no library of sprag-design {}", env!("CARGO_PKG_VERSION"))]
    Library,
    /// A history of the design cannot be read.
    #[error("{path}: {1}", path = .0.display())]
    History(PathBuf, std::io::Error),
    /// The archive cannot be packed.
    #[error("{0}")]
    Archive(String),
}

/// Gives the bytes of a file.
pub type HistoryReader<'a> = &'a dyn Fn(&Path) -> std::io::Result<Vec<u8>>;

/// A unit: the bytes of its archive, and the name of the platform that its library runs on.
#[derive(Debug, Clone)]
pub struct UnitArchive {
    /// The file.
    pub bytes: Vec<u8>,
    /// Folder of the library in it.
    pub platform: String,
}

/// The unit of `design` around `library`, the compiled library of this version; `read` gives the bytes of a history. Without times:
/// the same design, the same bytes.
///
/// # Errors
/// [`NoUnit`].
pub fn archive(
    design: &Design,
    fmi: Fmi,
    library: &[u8],
    read: HistoryReader<'_>,
) -> Result<UnitArchive, NoUnit> {
    // What cannot begin at rest without load is no element anywhere.
    Element::new(&design.clutch, &Beginning::default(), &Settings::default()).map_err(NoUnit::NoStart)?;
    if !library.windows(MARK.len()).any(|w| w == MARK.as_bytes()) {
        return Err(NoUnit::Library);
    }
    let platform = platform(fmi).ok_or(NoUnit::Platform)?.to_owned();
    let inside = format!("binaries/{platform}/{MODEL}{DLL_SUFFIX}");
    let mut files = vec![("modelDescription.xml".to_owned(), description(design, fmi).into_bytes(), false)];
    files.push((inside, library.to_vec(), true));
    files.push(("resources/design.toml".to_owned(), design.source.clone().into_bytes(), true));
    for history in &design.histories {
        let text = read(history).map_err(|e| NoUnit::History(history.clone(), e))?;
        let name = history.strip_prefix(&design.folder).unwrap_or(history);
        let parts: Vec<_> = name.components().map(|c| c.as_os_str().to_string_lossy().into_owned()).collect();
        files.push((format!("resources/{}", parts.join("/")), text, true));
    }
    let bytes = packed(&files).map_err(|e| NoUnit::Archive(e.to_string()))?;
    Ok(UnitArchive { bytes, platform })
}

/// The folder of this platform.
fn platform(fmi: Fmi) -> Option<&'static str> {
    let names = [
        ("linux", "x86_64", "linux64", "x86_64-linux"),
        ("linux", "aarch64", "aarch64-linux", "aarch64-linux"),
        ("windows", "x86_64", "win64", "x86_64-windows"),
        ("macos", "x86_64", "darwin64", "x86_64-darwin"),
        ("macos", "aarch64", "darwin64", "aarch64-darwin"),
    ];
    let found = names.iter().find(|(os, arch, ..)| (*os, *arch) == (OS, ARCH));
    found.map(|&(_, _, two, three)| if fmi == Fmi::Two { two } else { three })
}

/// An archive of files: name, content, whether it is to be compressed. Without times: the same files, the same bytes.
fn packed(files: &[(String, Vec<u8>, bool)]) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for (name, bytes, compress) in files {
        let method = if *compress { CompressionMethod::DEFLATE } else { CompressionMethod::STORE };
        let (mut entry, config) = archive.new_file(name.as_str()).compression_method(method).start()?;
        // Counts and sums up what is packed, wherever it goes.
        let mut plain = config.wrap(std::io::sink());
        plain.write_all(bytes)?;
        let (_, descriptor) = plain.finish()?;
        if *compress {
            entry.write_all(&miniz_oxide::deflate::compress_to_vec(bytes, LEVEL))?;
        } else {
            entry.write_all(bytes)?;
        }
        entry.finish(descriptor)?;
    }
    Ok(archive.finish()?)
}

/// Names of the design's `[[drivetrain]]`.
pub fn inertias_beyond(design: &Design) -> Vec<String> {
    let all = inputs(&design.source).into_iter();
    let named = all.filter_map(|input| {
        let entry = input.path.strip_prefix("drivetrain[")?;
        Some(entry.split_once(']')?.0.to_owned())
    });
    let mut names: Vec<String> = named.collect();
    names.dedup();
    names
}
