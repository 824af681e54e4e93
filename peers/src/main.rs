fn main() { println!("{}", sprag_design::Stop::Finished.name()); }
