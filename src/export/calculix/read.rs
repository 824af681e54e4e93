//! to come
/// x
#[derive(Debug)]
pub struct Row;
/// x
#[derive(Debug)]
pub struct NoRows;
/// x
pub fn read() {}
/// x
pub fn at_torque() {}
