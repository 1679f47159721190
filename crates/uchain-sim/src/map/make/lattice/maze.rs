//! Between two places of a maze there is one way.

use super::Lattice;
use crate::seed::Stream;

pub(super) fn open(mut lattice: Lattice, stream: &mut Stream) -> Lattice {
    lattice.dig_tree(stream);
    lattice
}
