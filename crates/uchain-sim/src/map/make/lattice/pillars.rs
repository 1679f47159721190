//! Room and pillar: entries and crosscuts at right angles, pillars between them, some crosscuts never opened.

use super::{Lattice, borders};
use crate::{
    map::make::{below, between},
    seed::Stream,
};

/// Sides of pillars (widths of an entry).
const PILLARS: (f64, f64) = (1.0, 2.2);
/// Share of the crosscuts that are open, beyond those without which nobody gets everywhere.
const OPEN: f64 = 0.85;

pub(super) fn open(size_m: [f64; 2], width_m: f64, stream: &mut Stream) -> Lattice {
    let [xs, ys] = size_m.map(|side_m| {
        // Each column and row of pillars has its own size; as many as fit.
        let mut pillars_m = Vec::new();
        let mut used_m = width_m;
        while used_m < side_m || pillars_m.len() < 3 {
            let pillar_m = between(stream, PILLARS.0, PILLARS.1) * width_m;
            used_m += pillar_m + width_m;
            pillars_m.push(pillar_m);
        }
        let count = (pillars_m.len() - 1).max(2);
        borders(count, |_| width_m, |wall| pillars_m[wall % pillars_m.len()])
    });
    let mut lattice = Lattice::new(xs, ys);
    lattice.dig_tree(stream);
    let [cols, rows] = lattice.spaces();
    for row in 0..rows {
        for col in 0..cols {
            for next in [[col + 1, row], [col, row + 1]] {
                if next[0] < cols && next[1] < rows && below(stream, 100) < (100.0 * OPEN) as usize {
                    lattice.join([col, row], next);
                }
            }
        }
    }
    lattice
}
