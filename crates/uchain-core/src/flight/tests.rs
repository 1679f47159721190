use proptest::prelude::*;

use super::*;

const STEP_S: f32 = 0.005;

fn law() -> PdLaw {
    PdLaw::new(&QuadrotorParams::default(), 0.5, 0.5)
}

fn level() -> FlightState {
    FlightState::default()
}

#[test]
fn who_is_there_is_asked_to_carry_its_weight_and_not_to_turn() {
    for heading_rad in [0.0, 1.0, -3.0] {
        let state = FlightState { attitude: Attitude::level(heading_rad), ..level() };
        let demand = law().demand(&state, heading_rad, STEP_S);
        assert!((demand.lift_mps2 - GRAVITY_MPS2).abs() < 1e-5, "{demand:?}");
        assert!(demand.turn_radps2.iter().all(|turn| turn.abs() < 1e-4), "{demand:?}");
    }
}

#[test]
fn it_pitches_forward_rolls_to_the_right_and_turns_left_by_the_gains_of_the_paper() {
    let params = QuadrotorParams::default();
    let asked = |state: FlightState, heading_rad| law().demand(&state, heading_rad, STEP_S);
    // To the front of it: nose down, a turn about y. To its right: left side up, a turn about x.
    let [roll, pitch, yaw] = asked(FlightState { at_m: [-0.01, 0.0, 0.0], ..level() }, 0.0).turn_radps2;
    let tilt_rad = 0.01 * params.go_to_per_s * params.speed_per_s / GRAVITY_MPS2;
    assert!(
        roll == 0.0 && yaw == 0.0 && (pitch / (params.pitch_p_per_s2 * tilt_rad) - 1.0).abs() < 1e-3,
        "{pitch}"
    );
    let [roll, pitch, _] = asked(FlightState { at_m: [0.0, 0.01, 0.0], ..level() }, 0.0).turn_radps2;
    assert!(pitch == 0.0 && (roll / (params.roll_p_per_s2 * tilt_rad) - 1.0).abs() < 1e-3, "{roll}");
    let [_, _, yaw] = asked(level(), 0.1).turn_radps2;
    assert!((yaw - params.yaw_p_per_s2 * 0.1).abs() < 1e-5, "{yaw}");
    // Below its place, and sinking: k_p,z times the way, and k_d,z times the speed.
    let low = FlightState { at_m: [0.0, 0.0, -0.02], velocity_mps: [0.0, 0.0, -0.1], ..level() };
    let climb_mps2 = params.height_p_per_s2 * 0.02 + params.height_d_per_s * 0.1;
    assert!((asked(low, 0.0).lift_mps2 - GRAVITY_MPS2 - climb_mps2).abs() < 1e-4);
}

#[test]
fn the_short_way_round_is_less_than_half_a_turn() {
    for (from_rad, to_rad, turn) in
        [(3.0, -3.0, TAU - 6.0), (-3.0, 3.0, 6.0 - TAU), (0.0, 1.0, 1.0), (0.0, 7.0, 7.0 - TAU)]
    {
        assert!((turn_rad(from_rad, to_rad) - turn).abs() < 1e-5, "from {from_rad} to {to_rad}");
    }
}

proptest! {
    /// Whatever is asked stays within numbers, with the lift upwards.
    #[test]
    fn a_demand_is_a_number_and_its_lift_never_pulls_down(
        at_m in [-1e4_f32..1e4, -1e4_f32..1e4, -1e3_f32..1e3],
        velocity_mps in [-1e2_f32..1e2, -1e2_f32..1e2, -1e2_f32..1e2],
        turn in [-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0, 0.1_f32..1.0],
        rates_radps in [-1e2_f32..1e2, -1e2_f32..1e2, -1e2_f32..1e2],
    ) {
        let [x, y, z, w] = vector::normalized(turn);
        let state = FlightState { at_m, velocity_mps, attitude: Attitude { xyz: [x, y, z], w }, rates_radps };
        let demand = law().demand(&state, 1.0, STEP_S);
        prop_assert!(demand.lift_mps2 >= 0.0 && demand.lift_mps2.is_finite(), "{demand:?}");
        prop_assert!(demand.turn_radps2.iter().all(|turn| turn.is_finite()), "{demand:?}");
    }

    /// Turning there and back is no turn, and lengths stay.
    #[test]
    fn an_attitude_turns_there_and_back(
        turn in [-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0, 0.1_f32..1.0],
        vector in [-5.0_f32..5.0, -5.0_f32..5.0, -5.0_f32..5.0],
    ) {
        let [x, y, z, w] = vector::normalized(turn);
        let attitude = Attitude { xyz: [x, y, z], w };
        let there = attitude.turned(vector);
        let back = attitude.inverse().turned(there);
        for (back, was) in back.iter().zip(vector) {
            prop_assert!((back - was).abs() < 1e-4, "{back} {was}");
        }
        prop_assert!((dot(there, there) - dot(vector, vector)).abs() < 1e-3 * (1.0 + dot(vector, vector)));
    }
}
