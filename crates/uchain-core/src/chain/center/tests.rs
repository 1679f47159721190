use super::*;
use crate::chain::TOF_RANGE_M;

const LAWS: [CenterLaw; 3] = [CenterLaw::Wall, CenterLaw::Paper, CenterLaw::Firmware];

fn tof(nw_m: f32, ne_m: f32, sw_m: f32, se_m: f32) -> Tof {
    Tof { nw_m, ne_m, sw_m, se_m }
}

fn by(law: CenterLaw) -> CenterParams {
    CenterParams { law, ..CenterParams::default() }
}

fn forward(t: &Tof, law: CenterLaw) -> Centering {
    center(t, TOF_RANGE_M, false, Follow::Centre, &by(law))
}

#[test]
fn eq_20_as_printed_while_the_walls_run_alike() {
    let p = CenterParams::default();
    for law in [CenterLaw::Wall, CenterLaw::Paper] {
        let c = forward(&tof(0.8, 0.7, 0.75, 0.72), law);
        assert!((c.lateral_mps - p.c_t_per_s * 0.1).abs() < 1e-6);
        assert!((c.yaw_rate_radps - p.c_r_rad_per_s_m * (0.05 + 0.02)).abs() < 1e-5);
    }
}

#[test]
fn where_the_right_wall_opens_the_left_one_is_followed_as_in_eq_21() {
    let p = CenterParams::default();
    let c = forward(&tof(0.5, 1.8, 0.52, 0.6), CenterLaw::Paper);
    assert!((c.lateral_mps - p.c_t_per_s * (0.5 - 0.28)).abs() < 1e-6);
    assert!((c.yaw_rate_radps - 2.0 * p.c_r_rad_per_s_m * (0.5 - 0.52)).abs() < 1e-5);
}

#[test]
fn where_the_right_wall_opens_the_default_law_keeps_along_the_left_one() {
    let p = CenterParams::default();
    let c = forward(&tof(0.5, 1.8, 0.4, 0.45), CenterLaw::Wall);
    // Nearest beams of 0.40 and 0.45 m: the middle is 0.425 m away.
    assert!((c.lateral_mps - p.follow_lateral_per_s * (0.4 - 0.425)).abs() < 1e-6);
    assert!((c.yaw_rate_radps - 2.0 * p.c_r_rad_per_s_m * (0.5 - 0.4)).abs() < 1e-5);
    // In a wide tunnel no farther than the largest distance.
    let wide = forward(&tof(0.6, 2.0, 0.6, 1.2), CenterLaw::Wall);
    assert!((wide.lateral_mps - p.follow_lateral_per_s * (0.6 - 0.45)).abs() < 1e-6);
}

/// Beams as read in `circuit`, seed 52, 13.25 s: a sharp corner to the right, the end wall 0.3 m ahead on the left.
#[test]
fn a_wall_that_comes_nearer_is_not_ignored() {
    let entering_a_right_hand_corner = tof(0.31, 0.53, 0.52, 0.52);
    let turn = |law| forward(&entering_a_right_hand_corner, law).yaw_rate_radps;
    assert_eq!(turn(CenterLaw::Wall), -CenterParams::default().yaw_rate_max_radps);
    // Eq. 21 ignores just that wall, and what is left looks like a wall that runs alike.
    assert!(turn(CenterLaw::Paper).abs() < 0.1);
}

/// Beams as read in `corner`, seed 220, 20.05 s: facing the end wall, the other leg on the right.
#[test]
fn with_a_wall_ahead_it_turns_away_from_the_nearer_side() {
    let facing_the_end_wall = tof(0.2, 0.21, 0.56, 0.9);
    assert!(forward(&facing_the_end_wall, CenterLaw::Wall).yaw_rate_radps < -1.0);
    assert!(forward(&facing_the_end_wall, CenterLaw::Paper).yaw_rate_radps > 0.0);
    // Backward, the tail faces it.
    let tail = center(&tof(0.9, 0.56, 0.21, 0.2), TOF_RANGE_M, true, Follow::Centre, &by(CenterLaw::Wall));
    assert!(tail.yaw_rate_radps < -1.0);
    // Exactly in the middle of a dead end it turns all the same, one way or the other.
    let dead_end = forward(&tof(0.3, 0.3, 0.5, 0.5), CenterLaw::Wall);
    assert!(dead_end.yaw_rate_radps.abs() > 1.0);
}

#[test]
fn mirrored_distances_give_the_mirrored_command() {
    let seen = [
        (0.8, 0.7, 0.75, 0.72),
        (0.5, 1.8, 0.52, 0.6),
        (0.1, 0.5, 0.4, 0.3),
        (0.31, 0.53, 0.52, 0.52),
        (0.2, 0.21, 0.56, 0.9),
    ];
    for law in LAWS {
        for d in seen {
            let c = forward(&tof(d.0, d.1, d.2, d.3), law);
            let m = forward(&tof(d.1, d.0, d.3, d.2), law);
            assert!((c.lateral_mps + m.lateral_mps).abs() < 1e-6, "{law:?}: {d:?}");
            assert!((c.yaw_rate_radps + m.yaw_rate_radps).abs() < 1e-6, "{law:?}: {d:?}");
            assert_eq!(c.speed_share, m.speed_share);
        }
    }
}

#[test]
fn backward_is_the_same_law_turned_by_half_a_turn() {
    let seen =
        [(0.8, 0.7, 0.75, 0.72), (0.5, 1.8, 0.52, 0.6), (0.6, 0.5, 1.9, 0.55), (0.52, 0.52, 0.53, 0.31)];
    for law in LAWS {
        for d in seen {
            let back = center(&tof(d.0, d.1, d.2, d.3), TOF_RANGE_M, true, Follow::Centre, &by(law));
            // Turned by 180°, front left is rear right, and left is right.
            let turned = forward(&tof(d.3, d.2, d.1, d.0), law);
            assert!((back.lateral_mps + turned.lateral_mps).abs() < 1e-6, "{law:?}: {d:?}");
            assert!((back.yaw_rate_radps - turned.yaw_rate_radps).abs() < 1e-5, "{law:?}: {d:?}");
            assert_eq!(back.speed_share, turned.speed_share);
        }
    }
}

#[test]
fn a_chosen_wall_is_followed_whatever_the_other_one_does() {
    for law in LAWS {
        let c = center(&tof(1.0, 0.4, 1.0, 0.4), TOF_RANGE_M, false, Follow::Left, &by(law));
        assert!(c.lateral_mps > 0.0, "{law:?}");
        let c = center(&tof(0.4, 1.0, 0.4, 1.0), TOF_RANGE_M, false, Follow::Right, &by(law));
        assert!(c.lateral_mps < 0.0, "{law:?}");
    }
}

#[test]
fn a_short_beam_pushes_to_the_other_side_and_slows_down() {
    for law in LAWS {
        for (tof, backward) in [(tof(0.19, 0.5, 0.5, 0.5), false), (tof(0.5, 0.5, 0.19, 0.5), true)] {
            let c = center(&tof, TOF_RANGE_M, backward, Follow::Centre, &by(law));
            assert_eq!((c.lateral_mps, c.speed_share), (-0.2, 0.2), "{law:?}");
        }
    }
    // Squeezed from both sides, the law decides.
    for law in [CenterLaw::Wall, CenterLaw::Paper] {
        assert_eq!(forward(&tof(0.1, 0.1, 0.5, 0.5), law).lateral_mps, 0.0, "{law:?}");
    }
}

#[test]
fn blind_it_flies_straight_on_and_rubbish_is_blindness() {
    for law in LAWS {
        let blind = forward(&tof(2.0, 2.0, 2.0, 2.0), law);
        assert_eq!(blind, Centering::default(), "{law:?}");
        let rubbish = tof(f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0);
        assert_eq!(forward(&rubbish, law), blind, "{law:?}");
    }
}

#[test]
fn a_beam_that_reads_the_sensors_range_is_no_wall_whatever_the_range() {
    let ask = |open_m, range_m| {
        let seen = tof(1.0, open_m, 1.0, open_m);
        center(&seen, range_m, false, Follow::Centre, &CenterParams::default())
    };
    assert_eq!(ask(1.5, 1.5), ask(9.0, 1.5), "beyond its range a sensor sees nothing");
    assert_ne!(ask(1.5, 9.0), ask(9.0, 9.0), "within a longer range it is a wall");
}
