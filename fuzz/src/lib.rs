//! Whatever a drone may hear or measure, and any file for a map, from bytes: the bodies of the fuzz targets.
//!
//! `cargo +nightly fuzz run node --features libfuzzer` looks for inputs that break a claim; what it finds goes into
//! `corpus/`, where the tests of this package replay it without a fuzzer.

mod bytes;
mod drawing;
mod node;
mod survey;
mod wire;

pub use drawing::{dxf, geojson, svg};
pub use node::node;
pub use survey::{subt, survex};
pub use wire::wire;
