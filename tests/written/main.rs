//! What is read and written: designs, limits, materials, drawings, answers, sizes.

#[path = "../common/program.rs"]
mod program;

mod answer;
mod cad_files;
mod cad_import;
mod designs;
mod files;
mod identify;
mod limits;
mod materials;
mod one_key_each;
mod size;
