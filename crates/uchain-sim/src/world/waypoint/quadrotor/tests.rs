use glam::{Quat, Vec2, Vec3};
use proptest::prelude::*;
use uchain_core::flight::{Attitude, Demand, GRAVITY_MPS2};

use super::{
    super::{Vehicle, Waypoint},
    Airframe, Quadrotor, QuadrotorParams, STEP_S, State,
};
use crate::clock::TICK_S;

/// Kim 2021, §7.2 and §8.1.
fn builds() -> [QuadrotorParams; 2] {
    let of = |mass_kg, arm_m| QuadrotorParams { mass_kg, arm_m, ..QuadrotorParams::default() };
    [of(0.3, 0.2), of(0.038, 0.1)]
}

fn at(x: f32, y: f32, z_m: f32, heading_rad: f32) -> Waypoint {
    Waypoint { at: Vec2::new(x, y), z_m, heading_rad }
}

/// What a flight shows to somebody who watches every tick.
#[derive(Debug, Default)]
struct Seen {
    time_s: f32,
    tilt_rad: f32,
    v_mps: f32,
    climb_mps: f32,
    /// Farthest beyond the end of the way, beside it, and above or below both of its ends (m).
    beyond_m: f32,
    beside_m: f32,
    over_m: f32,
    /// How far rows of the rotation are from being of length 1 and upright on each other.
    skew: f32,
}

/// Flies until it has arrived, and for 10 s more.
fn fly(body: &mut Quadrotor, to: Waypoint) -> Seen {
    let from = body.now();
    body.fly_to(to);
    let along = (to.at - from.at).normalize_or_zero();
    let (mut seen, mut left) = (Seen::default(), 200);
    while left > 0 && seen.time_s < 120.0 {
        body.advance();
        let State { velocity_mps, .. } = body.state;
        let here = body.now();
        let way = here.at - to.at;
        let more = |old: &mut f32, new: f32| *old = old.max(new);
        more(&mut seen.tilt_rad, libm::acosf(body.state.up().z.min(1.0)));
        more(&mut seen.v_mps, velocity_mps.truncate().length());
        more(&mut seen.climb_mps, velocity_mps.z.abs());
        more(&mut seen.beyond_m, way.dot(along));
        more(&mut seen.beside_m, way.perp_dot(along).abs());
        more(&mut seen.over_m, (here.z_m - from.z_m.max(to.z_m)).max(from.z_m.min(to.z_m) - here.z_m));
        let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| body.state.attitude * axis);
        let skews = [x.dot(y), y.dot(z), z.dot(x), x.length() - 1.0, y.length() - 1.0, z.length() - 1.0];
        for skew in skews {
            more(&mut seen.skew, skew.abs());
        }
        if body.has_arrived() {
            left -= 1;
        } else {
            assert_eq!(left, 200, "it has arrived, and is gone again");
            seen.time_s += TICK_S;
        }
    }
    assert_eq!(left, 0, "it never arrives");
    seen
}

#[test]
fn who_hovers_stays_where_it_is() {
    for params in builds() {
        let start = at(100.0, -50.0, 1.0, 2.0);
        let mut body = Quadrotor::new(start, &params, 0.5, 0.5);
        for _ in 0..2_000 {
            body.advance();
            assert!(body.has_arrived());
        }
        assert!(body.state.at_m.length() < 1e-5 && body.state.velocity_mps.length() < 1e-5, "{body:?}");
        assert!((body.now().heading_rad - 2.0).abs() < 1e-5);
    }
}

#[test]
fn a_move_of_0_8_m_takes_three_to_four_seconds_and_of_5_m_as_long_as_its_speed_allows() {
    let start = at(0.0, 0.0, 1.0, 0.0);
    let time_s = |x| fly(&mut Quadrotor::new(start, &builds()[0], 0.5, 0.5), at(x, 0.0, 1.0, 0.0)).time_s;
    let (short_s, long_s) = (time_s(0.8), time_s(5.0));
    assert!((3.0..4.0).contains(&short_s), "{short_s}");
    assert!((long_s - short_s - 4.2 / 0.5).abs() < 0.11, "{long_s} {short_s}");
}

/// With twenty times the speed the greatest tilt is asked for, and held.
#[test]
fn even_at_ten_metres_per_second_it_tilts_by_no_more_than_it_may() {
    for params in builds() {
        let mut body = Quadrotor::new(at(0.0, 0.0, 1.0, 0.0), &params, 10.0, 0.5);
        let seen = fly(&mut body, at(60.0, 20.0, 1.5, 0.0));
        assert!((18.0..22.0).contains(&seen.tilt_rad.to_degrees()), "{seen:?}");
        assert!((6.0..10.0).contains(&seen.v_mps), "{seen:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// The way begins in the residue of another one, at any heading.
    #[test]
    fn a_go_to_arrives_and_stays_with_no_overshoot_within_its_limits(
        first in [-3.0_f32..3.0, -3.0_f32..3.0, 0.0_f32..2.0, -3.1_f32..3.1],
        second in [-3.0_f32..3.0, -3.0_f32..3.0, 0.0_f32..2.0, -3.1_f32..3.1],
        build in 0_usize..2,
    ) {
        let mut body = Quadrotor::new(at(0.0, 0.0, 1.0, 0.0), &builds()[build], 0.5, 0.5);
        for [x, y, z_m, heading_rad] in [first, second] {
            let seen = fly(&mut body, at(x, y, z_m, heading_rad));
            prop_assert!(seen.beyond_m < 0.003, "{seen:?}");
            prop_assert!(seen.beside_m < 0.03, "{seen:?}");
            prop_assert!(seen.over_m < 0.022, "{seen:?}");
            prop_assert!(seen.v_mps < 0.5 * 1.02 && seen.climb_mps < 0.5 * 1.02, "{seen:?}");
            prop_assert!(seen.tilt_rad.to_degrees() < 20.5, "{seen:?}");
            prop_assert!(seen.skew < 1e-5, "{seen:?}");
        }
    }

    /// The law turns vectors in plain `f32`, the airframe with glam, which has SIMD on some targets.
    #[test]
    fn the_core_turns_vectors_with_the_bits_of_glam(
        turn in [-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0, 0.1_f32..1.0],
        vector in [-5.0_f32..5.0, -5.0_f32..5.0, -5.0_f32..5.0],
    ) {
        let glam = Quat::from_array(turn).normalize();
        let core = Attitude { xyz: [glam.x, glam.y, glam.z], w: glam.w };
        prop_assert_eq!(core.turned(vector), (glam * Vec3::from(vector)).to_array());
        prop_assert_eq!(core.inverse().turned(vector), (glam.inverse() * Vec3::from(vector)).to_array());
    }

    #[test]
    fn rotors_push_upwards_only_and_no_more_than_they_can(
        lift_mps2 in -50.0_f32..50.0,
        turn in [-500.0_f32..500.0, -500.0_f32..500.0, -500.0_f32..500.0],
        build in 0_usize..2,
    ) {
        let params = &builds()[build];
        let rotors = Airframe::new(params).rotors_n(&Demand { lift_mps2, turn_radps2: turn });
        let most_n = params.thrust_to_weight * params.mass_kg * GRAVITY_MPS2 / 4.0;
        prop_assert!(rotors.iter().all(|n| (-1e-5..=most_n + 1e-5).contains(n)), "{rotors:?}");
    }

    /// No thrust, no drag: height turns into speed, and a body that tumbles keeps tumbling.
    #[test]
    fn a_body_in_free_fall_keeps_its_energy(
        rates in [-8.0_f32..8.0, -8.0_f32..8.0, -8.0_f32..8.0],
        velocity in [-3.0_f32..3.0, -3.0_f32..3.0, -3.0_f32..3.0],
        build in 0_usize..2,
    ) {
        let airframe = Airframe::new(&builds()[build]);
        let (velocity_mps, rates_radps) = (Vec3::from(velocity), Vec3::from(rates));
        let mut state = State { velocity_mps, rates_radps, ..State::hovering(0.5) };
        let spin = |state: &State| state.rates_radps.dot(airframe.inertia_kg_m2 * state.rates_radps) / 2.0;
        let fall = |state: &State| {
            airframe.mass_kg * (GRAVITY_MPS2 * state.at_m.z + state.velocity_mps.length_squared() / 2.0)
        };
        let momentum = |state: &State| state.attitude * (airframe.inertia_kg_m2 * state.rates_radps);
        let (spin_j, fall_j, turning) = (spin(&state), fall(&state), momentum(&state));
        for _ in 0..400 {
            state.step(&airframe, &[0.0; 4], STEP_S);
        }
        prop_assert!((spin(&state) - spin_j).abs() <= 1e-3 * spin_j, "{} {spin_j}", spin(&state));
        prop_assert!((fall(&state) - fall_j).abs() < 2e-4 * airframe.mass_kg * 200.0, "{} {fall_j}", fall(&state));
        let drift = (momentum(&state) - turning).length();
        prop_assert!(drift <= 0.01 * turning.length(), "{drift} {turning}");
        prop_assert!((state.attitude.length() - 1.0).abs() < 1e-5);
    }

    /// Any gains within their ranges: nothing panics, and a quadrotor that cannot fly is somewhere.
    #[test]
    fn whatever_the_gains_it_is_at_some_place(gains in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0]) {
        let log = |share: f32, low: f32, high: f32| low * libm::powf(high / low, share);
        let [p, d, go_to, speed, mass, arm] = gains;
        let (p, d) = (log(p, 0.1, 1000.0), log(d, 0.1, 100.0));
        let params = QuadrotorParams {
            mass_kg: log(mass, 0.005, 50.0), arm_m: log(arm, 0.01, 2.0),
            roll_p_per_s2: p, roll_d_per_s: d, pitch_p_per_s2: p, pitch_d_per_s: d,
            height_p_per_s2: p, height_d_per_s: d, yaw_p_per_s2: p, yaw_d_per_s: d,
            go_to_per_s: log(go_to, 0.05, 10.0), speed_per_s: log(speed, 0.1, 50.0), thrust_to_weight: 10.0,
            tilt_max_deg: 60.0, yaw_max_radps: 20.0, ..QuadrotorParams::default()
        };
        params.check().unwrap();
        let mut body = Quadrotor::new(at(0.0, 0.0, 1.0, 0.0), &params, 20.0, 20.0);
        body.fly_to(at(3.0, -2.0, 0.5, 3.0));
        for _ in 0..4_000 {
            body.advance();
        }
        let State { at_m, velocity_mps, attitude, rates_radps, .. } = body.state;
        prop_assert!(at_m.is_finite() && velocity_mps.is_finite() && rates_radps.is_finite());
        prop_assert!((attitude.length() - 1.0).abs() < 1e-4, "{attitude}");
    }
}

#[test]
fn nose_down_is_forward_left_side_up_is_to_the_right_and_the_heading_is_neither() {
    let mut state = State::hovering(0.0);
    for (axis, up, heading_rad) in [
        (Vec3::X, Vec3::new(0.0, -0.29552, 0.95534), 0.0),
        (Vec3::Y, Vec3::new(0.29552, 0.0, 0.95534), 0.0),
        (Vec3::Z, Vec3::Z, 0.3),
    ] {
        state.attitude = Quat::from_axis_angle(axis, 0.3);
        assert!((state.up() - up).length() < 1e-4 && (state.heading_rad() - heading_rad).abs() < 1e-6);
    }
}
