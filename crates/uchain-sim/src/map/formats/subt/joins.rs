//! Which tiles of a layout lead into one another.

use std::collections::BTreeMap;

use super::tiles::{SIDES, Tile};

/// For each tile and side, the tile that it leads into there.
pub(super) fn joins(tiles: &[Tile]) -> Vec<[Option<usize>; 4]> {
    let at: BTreeMap<[i32; 2], usize> =
        tiles.iter().enumerate().map(|(index, tile)| ([tile.column, tile.row], index)).collect();
    let join = |tile: &Tile, side: usize| {
        let level = tile.opens[side]?;
        // Rows count downward.
        let [right, up] = SIDES[side];
        let other = *at.get(&[tile.column + right, tile.row - up])?;
        let back = (side + 2) % 4;
        let blocked = tile.blocked_m[side].is_some() || tiles[other].blocked_m[back].is_some();
        (tiles[other].opens[back] == Some(level) && !blocked).then_some(other)
    };
    tiles.iter().map(|tile| [0, 1, 2, 3].map(|side| join(tile, side))).collect()
}
