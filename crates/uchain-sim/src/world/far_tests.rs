//! Speed far from the middle of a map.

use glam::Vec2;
use proptest::prelude::*;
use uchain_core::chain::Command;

use super::*;
use crate::map::{Map, drawn};

/// Share of the way flown by which a flight may be longer or shorter (1).
const SHARE: f64 = 1e-3;
/// Distances from the middle (m).
const FAR_M: [f32; 4] = [0.0, 1e3, 1e4, 9.9e4];

/// By how much of the way the flight from `from` to `to` is off (1).
fn off(from: Vec2, to: Vec2, velocity_mps: Vec2, ticks: u32) -> f64 {
    let way_m = velocity_mps.as_dvec2() * f64::from(ticks) * f64::from(TICK_S);
    (to.as_dvec2() - from.as_dvec2() - way_m).length() / way_m.length()
}

fn velocity() -> impl Strategy<Value = Vec2> {
    (0.05_f32..0.3, 0.0_f32..6.3, any::<bool>()).prop_map(|(speed_mps, heading_rad, along_an_axis)| {
        let heading_rad = if along_an_axis { (heading_rad / 1.6).floor() * 1.570_796_4 } else { heading_rad };
        Vec2::new(libm::cosf(heading_rad), libm::sinf(heading_rad)) * speed_mps
    })
}

/// Anywhere up to 100 km from the middle, on every scale.
fn place() -> impl Strategy<Value = Vec2> {
    let coordinate = || {
        (-2.0_f32..5.0, any::<bool>())
            .prop_map(|(log, left)| libm::powf(10.0, log) * if left { -1.0 } else { 1.0 })
    };
    (coordinate(), coordinate()).prop_map(|(x, y)| Vec2::new(x, y))
}

/// Heading east.
fn at_rest(at: Vec2) -> Body {
    Body::new(Waypoint { at, z_m: 0.0, heading_rad: 0.0 }, false)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn up_to_100_km_from_the_middle_a_body_flies_as_fast_as_told(from in place(), velocity_mps in velocity()) {
        let mut body = at_rest(from);
        body.velocity_mps = velocity_mps;
        let ticks = 10_000;
        (0..ticks).for_each(|_| body.glide(TICK_S));
        let off = off(from, body.at, velocity_mps, ticks);
        prop_assert!(off < SHARE, "{off}");
    }
}

#[test]
fn a_plain_sum_is_a_fifth_too_slow_at_10_km_and_stands_at_100_km() {
    let plain = |far_m: f32, speed_mps: f32| {
        let mut at = Vec2::new(far_m, 0.0);
        (0..10_000).for_each(|_| (0..4).for_each(|_| at.x += speed_mps * TICK_S / 4.0));
        (f64::from(at.x) - f64::from(far_m)) / (f64::from(speed_mps) * f64::from(TICK_S) * 10_000.0)
    };
    assert!((plain(1e4, 0.1) - 0.78).abs() < 0.01 && (plain(1e4, 0.2) - 1.17).abs() < 0.01);
    assert_eq!(plain(1e5, 0.1), 0.0);
    assert!((plain(0.0, 0.1) - 1.0).abs() < 1e-3);
}

/// 200 km of free space, with pillars of rock `far_m` from the middle.
fn pillars(far_m: f32) -> Map {
    let square = |x: f64, y: f64, side_m: f64| {
        vec![[x, y], [x + side_m, y], [x + side_m, y + side_m], [x, y + side_m]]
    };
    let mut loops = vec![square(-1e5, -1e5, 2e5)];
    let least_m = f64::from(far_m);
    loops.extend(
        (0..16).map(|i| square(least_m + 2.0 * f64::from(i % 4), least_m + 2.0 * f64::from(i / 4), 1.0)),
    );
    drawn(&loops).unwrap()
}

#[test]
fn with_and_without_a_broad_phase_uavs_have_the_same_bits_far_from_the_middle() {
    for far_m in FAR_M {
        let map = Arc::new(pillars(far_m));
        let spawns = (0..9).map(|i| {
            let corner = Vec2::new(far_m + 1.5 + 2.0 * (i % 3) as f32, far_m + 1.5 + 2.0 * (i / 3) as f32);
            (corner, 0.7 * i as f32)
        });
        let params = MotionParams::default;
        let mut worlds = [
            World::new(map.clone(), params(), spawns.clone()),
            World::ungated(map.clone(), params(), spawns.clone()),
        ];
        let start: Vec<Vec2> = spawns.map(|(at, _)| at).collect();
        let asked: Vec<Command> = (0..9)
            .map(|i| Command {
                forward_mps: 0.03 + 0.01 * i as f32,
                yaw_rate_radps: 0.4,
                airborne: true,
                ..Command::default()
            })
            .collect();
        for tick in 0..400 {
            for world in &mut worlds {
                world.act(&asked);
                world.advance();
            }
            assert_eq!(worlds[0].bodies(), worlds[1].bodies(), "{far_m} m, tick {tick}");
        }
        assert!(worlds[0].bodies().iter().zip(&start).all(|(body, start)| body.at != *start));
        assert!(worlds[0].bodies().iter().all(|body| body.wall_contacts == 0));
        assert!(worlds[0].solver_steps() < worlds[1].solver_steps());
    }
}

#[test]
fn a_quadrotor_and_a_point_fly_as_fast_as_told_at_the_end_of_a_way_of_100_km() {
    let at = |x: f32| Waypoint { at: Vec2::new(x, 0.0), z_m: 1.0, heading_rad: 0.0 };
    for far_m in [1e3, 1e4, 1e5] {
        for v_mps in [0.05, 0.1, 0.3] {
            let quadrotor: Box<dyn Vehicle> =
                Box::new(Quadrotor::new(at(far_m), &QuadrotorParams::default(), v_mps, 0.5));
            let point: Box<dyn Vehicle> = Box::new(PointMass::new(at(far_m), v_mps, 0.5));
            for mut vehicle in [quadrotor, point] {
                vehicle.fly_to(at(0.0));
                // Up to speed.
                (0..200).for_each(|_| vehicle.advance());
                let from = vehicle.now().at;
                (0..10_000).for_each(|_| vehicle.advance());
                let off = off(from, vehicle.now().at, Vec2::new(-v_mps, 0.0), 10_000);
                assert!(off < SHARE, "{off} at {v_mps} m/s, {far_m} m: {vehicle:?}");
            }
        }
    }
}
