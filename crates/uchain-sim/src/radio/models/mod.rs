//! Models of the literature, each by its formula. All lose `radio.reference_loss_db` at `radio.reference_m`, so that they
//! differ in what distance and walls add, and not in radios; with `radio.align = false` each has its own loss at a metre. A table has those
//! of its file.

mod multi_wall;
mod slopes;
mod table;
#[cfg(test)]
mod tests;
mod visibility;

pub use multi_wall::MultiWall;
pub use slopes::Slopes;
pub use table::{LossTable, TableError};
pub use visibility::Visibility;
