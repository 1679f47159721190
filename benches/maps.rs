//! Maps of any size for tests and benchmarks of rays: a corridor, and clutter.

use core::f64::consts::TAU;

use glam::{DVec2, Vec2, vec2};
use uchain_sim::{
    map::Map,
    seed::{Seed, Source, Stream},
};

/// A ring that zig-zags, 2 m wide, legs of 6 m: an outer and an inner loop of half the walls each.
pub(crate) fn corridor(walls: usize) -> Map {
    let corners = walls / 2;
    let radius_m = 5.0 * corners as f64 / TAU;
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(TAU * k as f64 / corners as f64);
        DVec2::new(cos, sin) * (radius_m + if k.is_multiple_of(2) { 1.75 } else { -1.75 })
    };
    let side = |half_m: f64| {
        let mitre = |k: usize| {
            let [before, at, after] = [k + corners - 1, k, k + 1].map(|k| corner(k % corners));
            let [left, leaving_left] = [at - before, after - at].map(|leg| leg.normalize().perp());
            let across = (left + leaving_left).normalize();
            (at + across * (half_m / across.dot(left))).as_vec2()
        };
        (0..corners).map(mitre).collect()
    };
    Map::from_loops(vec![side(1.0), side(-1.0)]).expect("two loops of finite corners")
}

/// A square arena with four-cornered obstacles of 0.3 to 0.7 m radius, one in each square of 4 m as far as the walls
/// last.
pub(crate) fn clutter(walls: usize) -> Map {
    let mut random = Seed(3).stream(0, Source::Start);
    let mut between = |low: f32, high: f32| low + (high - low) * random.uniform();
    let obstacles = walls / 4 - 1;
    let across = (1..=obstacles).find(|n| n * n >= obstacles).unwrap_or(1);
    let side_m = 4.0 * across as f32;
    let mut loops = vec![vec![Vec2::ZERO, vec2(side_m, 0.0), vec2(side_m, side_m), vec2(0.0, side_m)]];
    for k in 0..obstacles {
        let square = vec2((k % across) as f32, (k / across) as f32) * 4.0;
        let centre = square + vec2(between(0.8, 3.2), between(0.8, 3.2));
        let radius_m = between(0.3, 0.7);
        let corner = |quarter: u8| {
            let (sin, cos) =
                libm::sincosf((f32::from(quarter) + between(0.1, 0.9)) * core::f32::consts::FRAC_PI_2);
            centre + radius_m * vec2(cos, sin)
        };
        loops.push((0..4).map(corner).collect());
    }
    Map::from_loops(loops).expect("loops of finite corners")
}

/// Random places in free space, each with a random unit vector.
pub(crate) fn poses(map: &Map, count: usize) -> Vec<(Vec2, Vec2)> {
    let mut random = Seed(7).stream(0, Source::Start);
    let walls = map.walls();
    let mut poses = Vec::with_capacity(count);
    while poses.len() < count {
        let wall = &walls[(random.uniform() * walls.len() as f32) as usize % walls.len()];
        let near = wall.a.lerp(wall.b, random.uniform());
        let at = near + 4.0 * (vec2(random.uniform(), random.uniform()) - 0.5);
        if !map.in_rock(at) {
            poses.push((at, heading(&mut random)));
        }
    }
    poses
}

fn heading(random: &mut Stream) -> Vec2 {
    let (sin, cos) = libm::sincosf(core::f32::consts::TAU * random.uniform());
    vec2(cos, sin)
}
