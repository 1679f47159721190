use proptest::prelude::*;
use uchain_core::bounded;

use super::*;
use crate::map::drawn;

fn scan(map: &Map, from: [f64; 2], params: &ExploreParams) -> Vec<Option<f32>> {
    let mut returns_m = Vec::new();
    Scanner::new(params).scan(map, map.to_local(from), &mut returns_m);
    returns_m
}

/// Distance to the grown walls along one ray, by steps as long as the nearest wall is away.
fn march_m(map: &Map, from: Vec2, angle: f64, params: &ExploreParams) -> f64 {
    let (r_body_m, r_s_m) = (f64::from(params.r_body_m), f64::from(params.r_s_m));
    let (sin, cos) = libm::sincos(angle);
    let ray = DVec2::new(cos, sin);
    let mut far_m = 0.0;
    while far_m <= r_s_m {
        let at = from.as_dvec2() + ray * far_m;
        let room_m = map
            .walls()
            .iter()
            .map(|wall| {
                let (a, b) = (wall.a.as_dvec2(), wall.b.as_dvec2());
                let share = bounded((at - a).dot(b - a) / (b - a).length_squared(), 0.0, 1.0);
                (a + (b - a) * share).distance(at) - r_body_m
            })
            .fold(f64::INFINITY, f64::min);
        if room_m < 1e-7 {
            return far_m;
        }
        far_m += room_m;
    }
    f64::INFINITY
}

fn room() -> Vec<[f64; 2]> {
    vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]
}

proptest! {
    /// The oracle looks at all walls, along many rays of each cone.
    #[test]
    fn a_scan_returns_the_nearest_point_of_every_cone(
        x in 0.2..3.8_f64,
        y in 0.2..3.8_f64,
        turn in 0.0..1.5_f64,
        width in 0.02..0.5_f64,
        r_body_m in prop_oneof![Just(0.03_f32), Just(0.1)],
        sectors in prop_oneof![Just(18_u16), Just(5), Just(4)],
    ) {
        let (sin, cos) = libm::sincos(turn);
        let corner = |u: f64, v: f64| [2.0 + cos * u - sin * v, 2.0 + sin * u + cos * v];
        let slab = vec![corner(-0.8, 0.0), corner(-0.8, width), corner(0.7, width), corner(0.7, 0.0)];
        let map = drawn(&[room(), slab]).unwrap();
        let from = map.to_local([x, y]);
        prop_assume!(!map.in_rock(from) && map.clearance_m(from) > r_body_m + 1e-3);
        let params = ExploreParams { r_body_m, sectors, ..ExploreParams::default() };
        for (k, got) in scan(&map, [x, y], &params).into_iter().enumerate() {
            let rays = 600;
            let angle = |i: usize| TAU * (k as f64 + i as f64 / f64::from(rays)) / f64::from(sectors);
            let least_m = (0..=rays as usize).map(|i| march_m(&map, from, angle(i), &params)).fold(f64::INFINITY, f64::min);
            match got {
                Some(m) => prop_assert!((f64::from(m) - least_m).abs() < 2e-4, "sector {k}: {m} against {least_m}"),
                None => prop_assert!(least_m > 0.999, "sector {k}: nothing against {least_m}"),
            }
        }
    }
}

#[test]
fn a_door_jamb_between_two_rays_is_seen() {
    // A pole a millimetre thick: rays 10 degrees apart pass it.
    let pole = vec![[2.7, 2.2], [2.701, 2.2], [2.701, 2.201], [2.7, 2.201]];
    let map = drawn(&[room(), pole]).unwrap();
    let params = ExploreParams { r_body_m: 0.0, ..ExploreParams::default() };
    let seen = scan(&map, [2.0, 2.0], &params);
    let expected = libm::hypot(0.7, 0.2) as f32;
    assert!(seen[0].is_some_and(|m| (m - expected).abs() < 1e-5), "{seen:?}");
    assert!(seen[1..].iter().all(Option::is_none), "{seen:?}");
}

#[test]
fn a_wall_on_the_edge_between_two_sectors_is_in_both_and_one_that_touches_the_robot_in_all() {
    let map = drawn(&[room()]).unwrap();
    let params = ExploreParams { sectors: 8, ..ExploreParams::default() };
    let seen = scan(&map, [3.5, 2.0], &params);
    assert_eq!((seen[0], seen[7]), (seen[7], seen[0]));
    assert!(seen[0].is_some_and(|m| (m - 0.4).abs() < 1e-6 && m <= 0.4), "{seen:?}");
    assert_eq!(scan(&map, [3.95, 2.0], &params), vec![Some(0.0); 8]);
}
