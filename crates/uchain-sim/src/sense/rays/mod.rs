//! Distances along rays to walls.
//!
//! [`GridRays`] is what a mission flies with. `ParryRays`, by parry's bounding-volume tree, shares no code with it: its
//! oracle in tests and its baseline in benchmarks, behind the feature `oracles`.

mod batch;
mod grid;
mod lattice;
mod lists;
#[cfg(any(test, feature = "oracles"))]
mod parry;
#[cfg(test)]
mod tests;

use glam::Vec2;

pub use grid::GridRays;
#[cfg(any(test, feature = "oracles"))]
pub use parry::ParryRays;

/// Distances along rays to walls.
pub trait Rays {
    /// Distance from `from` along `direction`, a unit vector, to the first wall (m), at most `range_m`.
    fn cast(&self, from: Vec2, direction: Vec2, range_m: f32) -> f32;

    /// The shortest distances from `from` along `N` bundles of lines, each the one ahead and the one behind (m), at
    /// most `range_m`. Every item holds one line of each bundle, a unit vector.
    ///
    /// The same as casting along each line and against it, at less cost.
    fn fan<const N: usize>(
        &self,
        from: Vec2,
        lines: impl Iterator<Item = [Vec2; N]> + Clone,
        range_m: f32,
    ) -> [[f32; 2]; N] {
        let mut nearest = [[range_m; 2]; N];
        for bundles in lines {
            for ([ahead_m, behind_m], line) in nearest.iter_mut().zip(bundles) {
                *ahead_m = self.cast(from, line, *ahead_m);
                *behind_m = self.cast(from, -line, *behind_m);
            }
        }
        nearest
    }
}
