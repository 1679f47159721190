use core::f32::consts::FRAC_PI_4;

use super::*;
use crate::map::{Vertex, corridor};

fn between(params: RadioParams, from: Vec2, to: Vec2) -> f32 {
    // A U: two legs of 4 m, 3 m apart, 1 m wide, with 2 m of rock between them.
    let vertex = |x, y| Vertex { x, y, bend_radius_m: 0.0 };
    let line = [vertex(0.0, 0.0), vertex(4.0, 0.0), vertex(4.0, 3.0), vertex(0.0, 3.0)];
    let (map, _) = corridor(&line, 1.0, false).unwrap();
    PathLoss::new(params, &map).unwrap().loss_db(&map, &from.into(), &to.into())
}

#[test]
fn in_the_open_eq_22_holds_with_the_free_exponent_and_below_the_reference_nothing_changes() {
    let p = RadioParams::default();
    let at = Vec2::new(0.5, 0.0);
    assert!((between(p.clone(), at, Vec2::new(3.0, 0.0)) - 55.0).abs() < 1e-4);
    assert_eq!(between(p, at, Vec2::new(0.6, 0.0)), 35.0);
}

#[test]
fn two_thirds_of_the_way_in_rock_raise_the_exponent_by_two_thirds_of_its_range() {
    let p = RadioParams::default();
    let loss_db = between(p, Vec2::new(1.0, 0.0), Vec2::new(1.0, 3.0));
    let alpha = 2.0 + 4.0 * 2.0 / 3.0;
    assert!((loss_db - (35.0 + 10.0 * alpha * libm::log10f(12.0))).abs() < 1e-3, "{loss_db}");
}

#[test]
fn by_wall_count_one_stretch_of_rock_is_one_step_however_thick_and_steps_end_at_the_largest_exponent() {
    let p = RadioParams { shadowing: Shadowing::WallCount, ..RadioParams::default() };
    let across = |alpha_step| {
        let p = RadioParams { alpha_step, ..p.clone() };
        between(p, Vec2::new(1.0, 0.0), Vec2::new(1.0, 3.0))
    };
    assert!((across(2.0) - (35.0 + 40.0 * libm::log10f(12.0))).abs() < 1e-3);
    assert!((across(9.0) - (35.0 + 60.0 * libm::log10f(12.0))).abs() < 1e-3);
}

#[test]
fn a_detour_costs_by_the_length_of_the_way_round_beyond_the_straight_one() {
    let p = RadioParams { detour_db_per_m: 40.0, ..RadioParams::default() };
    assert!((between(p.clone(), Vec2::new(0.5, 0.0), Vec2::new(3.0, 0.0)) - 55.0).abs() < 1e-4);
    // From leg to leg, round the two inner corners of the U at x = 3.5 m.
    let (from, to) = (Vec2::new(1.0, 0.0), Vec2::new(1.0, 3.0));
    let way_m = 2.0 * 6.5_f32.sqrt() + 2.0;
    let direct_db = between(RadioParams::default(), from, to);
    assert!((between(p, from, to) - direct_db - 40.0 * (way_m - 3.0)).abs() < 1e-2);
}

#[test]
fn by_odometers_a_detour_is_what_both_have_flown_less_the_straight_way_and_without_one_the_shortest_way() {
    let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
    let (map, _) = corridor(&[vertex(0.0), vertex(9.0)], 1.0, false).unwrap();
    let loss = |detour, odometers_m: [Option<f32>; 2]| {
        let p = RadioParams { detour_db_per_m: 40.0, detour, ..RadioParams::default() };
        let ends = [0.5, 3.0].map(|x_m| Antenna::from(Vec2::new(x_m, 0.0)));
        let [from, to] = [0, 1].map(|i| Antenna { odometer_m: odometers_m[i], ..ends[i] });
        let model = PathLoss::new(p, &map).unwrap();
        assert_eq!(model.loss_db(&map, &from, &to), model.loss_db(&map, &to, &from));
        model.loss_db(&map, &from, &to)
    };
    // 2.5 m apart lose 55 dB; 2.6 m flown are 0.1 m too many, and 2.4 m as many too few: 4 dB.
    for (from_m, to_m, expected_db) in [(0.0, 2.5, 55.0), (0.0, 2.6, 59.0), (3.1, 0.7, 59.0)] {
        let got_db = loss(Detour::Odometer, [Some(from_m), Some(to_m)]);
        assert!((got_db - expected_db).abs() < 1e-3, "{from_m} {to_m}: {got_db}");
    }
    assert!((loss(Detour::Odometer, [Some(7.0), None]) - 55.0).abs() < 1e-3);
    assert!((loss(Detour::Geodesic, [Some(0.0), Some(2.6)]) - 55.0).abs() < 1e-3);
}

#[test]
fn an_antenna_is_best_at_45_degrees_and_the_base_has_none() {
    let p = RadioParams { antenna_db: 6.0, ..RadioParams::default() };
    let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
    let (map, _) = corridor(&[vertex(0.0), vertex(9.0)], 1.0, false).unwrap();
    let base: Antenna = Vec2::new(1.0, 0.0).into();
    let uav = |heading_rad| Antenna { heading_rad: Some(heading_rad), ..Vec2::new(3.5, 0.0).into() };
    let loss = |a: &Antenna, b: &Antenna| PathLoss::new(p.clone(), &map).unwrap().loss_db(&map, a, b);
    assert!((loss(&base, &uav(FRAC_PI_4)) - 55.0).abs() < 1e-4);
    assert!((loss(&base, &uav(-3.0 * FRAC_PI_4)) - 55.0).abs() < 1e-4);
    assert!((loss(&base, &uav(0.0)) - 61.0).abs() < 1e-4);
    assert!((loss(&uav(0.0), &base) - 61.0).abs() < 1e-4);
}

#[test]
fn a_key_holds_what_a_loss_depends_on_and_nothing_else() {
    let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
    let (map, _) = corridor(&[vertex(0.0), vertex(9.0)], 1.0, false).unwrap();
    let key = |params: RadioParams| PathLoss::new(params, &map).unwrap().key().unwrap();
    let p = RadioParams::default();
    let plain = key(p.clone());
    assert_eq!(plain, key(RadioParams { sigma_db: 9.0, range_m: Some(3.0), ..p.clone() }));
    for other in [
        RadioParams { detour_db_per_m: 1.0, ..p.clone() },
        RadioParams { shadowing: Shadowing::WallCount, ..p.clone() },
        RadioParams { alpha_free: 2.000_000_2, ..p },
    ] {
        assert_ne!(plain, key(other));
    }
}
