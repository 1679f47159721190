//! The middle of free space as a mesh of fine steps.

mod delaunay;
mod middle;
mod places;
mod prune;

pub(super) use middle::Middle;

use crate::map::{Map, MapError};

/// Most places on the walls that a graph is made from: about 300 bytes each.
const MOST_PLACES: usize = 1_000_000;

/// What of the middle of free space is a way.
pub(super) fn ways(map: &Map) -> Result<Middle, MapError> {
    let triangles = places::triangles(map)?;
    let mut middle = Middle::of(map, &triangles);
    prune::prune(&mut middle);
    Ok(middle)
}
