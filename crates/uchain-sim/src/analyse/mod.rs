//! Frames in, numbers out: what is the same for all missions.

mod cell;
mod digest;
pub mod optimum;
mod outcome;
#[cfg(feature = "sweep")]
mod significance;
#[cfg(any(feature = "sweep", feature = "fit"))]
mod stats;
mod thinned;

pub use cell::{Cell, Column, Field, Kind};
pub use digest::Digest;
pub use outcome::{Break, Outcome, Over, Remedy, Verdict, Way};
#[cfg(feature = "sweep")]
pub use significance::{
    Tendency, bootstrap, is_less_in_pairs, is_rarer_in_pairs, saved_percent, tends_to_be_less,
};
#[cfg(any(feature = "sweep", feature = "fit"))]
pub use stats::Estimate;
pub use thinned::Thinned;
