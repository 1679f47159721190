//! Senses: the world in, readings out. Noise is a wrapper around the exact reading.

mod flow;
mod rays;
mod scan;
mod tof;

pub use flow::{FlowNoise, FlowParams};
#[cfg(any(test, feature = "oracles"))]
pub use rays::ParryRays;
pub use rays::{GridRays, Rays};
pub use scan::Scanner;
pub use tof::{TofBeams, TofNoise, TofParams, read_tof};
