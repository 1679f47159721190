//! Senses: the world in, readings out. Noise is a wrapper around the exact reading.

mod flow;
mod scan;
mod tof;

pub use flow::{FlowNoise, FlowParams};
pub use scan::Scanner;
pub use tof::{ParryRays, Rays, TofNoise, TofParams, read_tof};
