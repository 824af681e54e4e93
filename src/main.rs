//! The `sprag-design` program; everything it does is in the library.

fn main() -> std::process::ExitCode {
    sprag_design::cli::run()
}
