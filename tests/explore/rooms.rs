//! The places that are explored in these tests.

use super::world::World;

/// 6 m by 4 m: four rooms, doors of 1 m, a pillar.
pub(crate) fn rooms() -> World {
    World::hall(6.0, 4.0)
        .wall([3.0, 0.0], [3.0, 4.0], &[(0.5, 1.0), (2.6, 1.0)])
        .wall([0.0, 2.0], [3.0, 2.0], &[(1.8, 1.0)])
        .wall([3.0, 2.4], [6.0, 2.4], &[(1.0, 1.0)])
        .pillar([4.5, 0.9], 0.3)
        .starts(&[[0.5, 0.5], [0.5, 1.1], [1.1, 0.5]])
}

/// 10 m by 10 m: a hall across the middle, three rooms on each side, two of them behind another.
pub(crate) fn apartment() -> World {
    World::hall(10.0, 10.0)
        .wall([0.0, 4.2], [10.0, 4.2], &[(1.0, 1.0), (4.6, 1.0), (8.2, 1.0)])
        .wall([0.0, 5.8], [10.0, 5.8], &[(1.4, 1.0), (5.0, 1.0), (7.6, 1.0)])
        .wall([3.2, 0.0], [3.2, 4.2], &[])
        .wall([6.6, 0.0], [6.6, 4.2], &[(1.2, 1.0)])
        .wall([3.6, 5.8], [3.6, 10.0], &[(2.2, 1.0)])
        .wall([7.0, 5.8], [7.0, 10.0], &[])
        .starts(&[[0.5, 5.0], [0.5, 4.6], [0.5, 5.4], [0.9, 5.0], [0.9, 4.6], [0.9, 5.4]])
}

/// 10 m by 10 m: corridors of 1 m around blocks.
pub(crate) fn corridors() -> World {
    let blocks = [
        ([1.0, 1.0], [2.0, 3.5]),
        ([4.0, 1.0], [5.0, 1.5]),
        ([4.0, 3.5], [2.0, 2.0]),
        ([7.0, 3.5], [2.0, 3.0]),
        ([1.0, 5.5], [2.0, 3.5]),
        ([4.0, 6.5], [2.0, 2.5]),
        ([7.0, 7.5], [3.0, 1.5]),
    ];
    let hall = World::hall(10.0, 10.0);
    let built = blocks.into_iter().fold(hall, |world, (corner, size)| world.block(corner, size));
    built.starts(&[[0.5, 5.0], [0.5, 4.6], [0.5, 5.4], [0.9, 5.0], [0.5, 4.2], [0.5, 5.8]])
}

/// A square cell whose walls, grown by a robot's radius, are so far from the start in its middle.
pub(crate) fn cell(free_m: f64, body_m: f64) -> World {
    let side_m = 2.0 * (free_m + body_m);
    World::hall(side_m, side_m).starts(&[[side_m / 2.0; 2]])
}
