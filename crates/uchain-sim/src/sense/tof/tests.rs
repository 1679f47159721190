use std::sync::Arc;

use super::*;
use crate::{
    map::{Map, Vertex, corridor},
    seed::{Seed, Source},
    sense::GridRays,
    world::MotionParams,
};

fn straight() -> Arc<Map> {
    let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
    corridor(&[vertex(0.0), vertex(10.0)], 1.0, false).unwrap().0.into()
}

/// What UAV 0 reads; the others hover.
fn read(map: &Arc<Map>, places: &[(Vec2, f32)], airborne: bool) -> Tof {
    let mut world = World::new(map.clone(), MotionParams::default(), places.iter().copied());
    let mut asked = vec![uchain_core::chain::Command { airborne, ..Default::default() }; places.len()];
    asked[0].airborne = true;
    world.act(&asked);
    let params = TofParams::default();
    read_tof(&GridRays::new(map, params.range_m), &world, 0, &TofBeams::new(&params))
}

fn assert_near(got: Tof, [nw, ne, sw, se]: [f32; 4]) {
    for (got, expected) in [(got.nw_m, nw), (got.ne_m, ne), (got.sw_m, sw), (got.se_m, se)] {
        assert!((got - expected).abs() < 1e-4, "{got} instead of {expected}");
    }
}

#[test]
fn a_reading_is_the_shortest_ray_of_its_field_of_view() {
    // 0.1 m left of the middle: the steepest ray meets a wall at 45° + 13.5°.
    let steepest = libm::sinf(FRAC_PI_4 + 0.5 * TofParams::default().field_of_view_rad);
    let (left, right) = (0.4 / steepest, 0.6 / steepest);
    assert_near(read(&straight(), &[(Vec2::new(5.0, 0.1), 0.0)], true), [left, right, left, right]);
}

#[test]
fn where_nothing_is_within_range_a_reading_is_the_range() {
    let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
    let hall = corridor(&[vertex(0.0), vertex(20.0)], 10.0, false).unwrap().0.into();
    assert_near(read(&hall, &[(Vec2::new(10.0, 0.0), 0.3)], true), [2.0; 4]);
}

#[test]
fn beams_see_other_uavs_in_the_air_and_look_over_those_on_the_ground() {
    let map = straight();
    let me = (Vec2::new(5.0, 0.0), 0.0);
    let alone = read(&map, &[me], true);
    // Dead ahead of the NW beam's middle ray, 0.4 m away, 0.06 m in radius.
    let there = (Vec2::new(5.0, 0.0) + Vec2::splat(0.4 * core::f32::consts::FRAC_1_SQRT_2), 0.0);
    let seen = read(&map, &[me, there], true);
    assert_near(seen, [0.34, alone.ne_m, alone.sw_m, alone.se_m]);
    assert_near(read(&map, &[me, there], false), [alone.nw_m, alone.ne_m, alone.sw_m, alone.se_m]);
}

#[test]
fn noise_has_its_deviation_drop_outs_their_share_and_blindness_is_exact() {
    let params = TofParams { dropout: 0.1, noise_m: 0.02, ..TofParams::default() };
    let mut noise = TofNoise::new(Seed(1).stream(0, Source::Tof), params);
    let exact = Tof { nw_m: 1.0, ne_m: 1.0, sw_m: 1.0, se_m: 2.0 };
    let readings: Vec<Tof> = (0..20_000).map(|_| noise.apply(exact)).collect();
    assert!(readings.iter().all(|tof| tof.se_m == 2.0));
    let hits: Vec<f64> = readings.iter().map(|tof| f64::from(tof.nw_m)).filter(|d| *d < 1.9).collect();
    let dropped = 1.0 - hits.len() as f64 / 20_000.0;
    assert!((dropped - 0.1).abs() < 0.01, "{dropped}");
    let mean = hits.iter().sum::<f64>() / hits.len() as f64;
    let variance = hits.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / hits.len() as f64;
    assert!((mean - 1.0).abs() < 1e-3 && (variance.sqrt() - 0.02).abs() < 1e-3, "{mean} {variance}");
}
