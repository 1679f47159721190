//! What lines and marks are called: at the ends of lines; in a key above, or right of a map, where that cannot be.

pub(crate) mod key;
pub(crate) mod label;
mod legend;

pub(crate) use label::{Ending, name_ends};
pub(crate) use legend::legend;
