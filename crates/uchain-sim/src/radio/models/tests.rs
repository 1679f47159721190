//! Losses worked out by hand from the formulas.

use std::sync::Arc;

use glam::Vec2;

use crate::{
    map::{HeardAcross, Map, drawn},
    radio::{Antenna, RadioKind, RadioModel, RadioParams},
};

fn open() -> Map {
    drawn(&[vec![[0.0, 0.0], [200.0, 0.0], [200.0, 9.0], [0.0, 9.0]]]).unwrap()
}

fn make(params: &RadioParams, map: &Map) -> Arc<dyn RadioModel> {
    let kind = RadioKind::BUILTIN.into_iter().find(|kind| kind.word() == params.model).unwrap();
    kind.make(params, map).unwrap_or_else(|error| panic!("{error}"))
}

fn of(model: &str) -> RadioParams {
    RadioParams { model: model.to_owned(), ..RadioParams::default() }
}

/// Loss over so much along x, from 1 m on.
fn over_db(params: &RadioParams, apart_m: f32) -> f32 {
    let map = open();
    let [a, b]: [Antenna; 2] = [1.0, 1.0 + apart_m].map(|x_m| Vec2::new(x_m, 4.0).into());
    make(params, &map).loss_db(&map, &a, &b)
}

fn assert_db(got_db: f32, expected_db: f32) {
    assert!((got_db - expected_db).abs() < 2e-3, "{got_db} dB, by hand {expected_db}");
}

#[test]
fn all_models_lose_the_same_at_the_reference_unless_each_goes_by_itself() {
    for model in ["path-loss", "log-distance", "multi-wall", "p1238", "two-slope"] {
        assert_db(over_db(&of(model), 0.25), 35.0);
        assert_db(over_db(&of(model), 0.1), 35.0);
    }
    let own = |model| over_db(&RadioParams { align: false, ..of(model) }, 1.0);
    // Gazebo: 40. Free space: 20 log10(2400) − 27.552 = 67.604 − 27.552. P.1238: 67.604 − 28.
    for (model, own_db) in
        [("log-distance", 40.0), ("multi-wall", 40.052), ("two-slope", 40.052), ("p1238", 39.604)]
    {
        assert_db(own(model), own_db);
    }
}

#[test]
fn log_distance_is_that_of_gazebo_with_its_defaults_and_its_longest_link() {
    let gazebo = RadioParams { align: false, range_m: Some(50.0), ..of("log-distance") };
    // l0 + 10 · 2.5 · log10(20) = 40 + 25 · 1.30103
    assert_db(over_db(&gazebo, 20.0), 72.526);
    assert!(over_db(&gazebo, 50.1) >= crate::radio::NO_LINK_DB);
    // Aligned: 35 + 25 · log10(20 / 0.25) = 35 + 25 · 1.90309
    assert_db(over_db(&of("log-distance"), 20.0), 82.577);
}

#[test]
fn p1238_loses_thirty_decibels_a_decade_in_an_office() {
    // 20 log10(2400) + 30 log10(15) − 28 = 67.604 + 35.283 − 28
    assert_db(over_db(&RadioParams { align: false, ..of("p1238") }, 15.0), 74.887);
    // In a shop at 1.8 GHz: 65.105 + 22 · 1.17609 − 28
    let shop = RadioParams { align: false, frequency_mhz: 1800.0, p1238_n: 22.0, ..of("p1238") };
    assert_db(over_db(&shop, 15.0), 62.979);
}

#[test]
fn beyond_the_break_of_two_slopes_the_second_goes_on_from_the_first() {
    let tunnel = RadioParams { exponent: 2.0, ..of("two-slope") };
    // 35 + 20 log10(20 / 0.25) = 35 + 38.062, and 12 log10(100 / 20) = 8.388 more
    assert_db(over_db(&tunnel, 20.0), 73.062);
    assert_db(over_db(&tunnel, 100.0), 81.449);
    let map = open();
    let early = RadioParams { break_m: 0.1, ..tunnel };
    let kind = RadioKind::BUILTIN.into_iter().find(|kind| kind.word() == "two-slope").unwrap();
    let error = kind.make(&early, &map).unwrap_err().to_string();
    assert_eq!(error, "radio.break_m = 0.1: at least radio.reference_m = 0.25");
}

#[test]
fn each_wall_costs_what_it_is_made_of_whatever_its_thickness() {
    // Two pillars, 1 m and 3 m thick.
    let pillar =
        |x_m: f64, thick_m: f64| vec![[x_m, 3.0], [x_m + thick_m, 3.0], [x_m + thick_m, 6.0], [x_m, 6.0]];
    let map =
        drawn(&[vec![[0.0, 0.0], [20.0, 0.0], [20.0, 9.0], [0.0, 9.0]], pillar(4.0, 1.0), pillar(9.0, 3.0)])
            .unwrap();
    let params = of("multi-wall");
    let model = make(&params, &map);
    let loss_db = |from: [f64; 2], to: [f64; 2]| {
        let [a, b]: [Antenna; 2] = [from, to].map(|at| map.to_local(at).into());
        let there_db = model.loss_db(&map, &a, &b);
        assert_eq!(there_db.to_bits(), model.loss_db(&map, &b, &a).to_bits());
        there_db
    };
    // 35 + 20 log10(10 / 0.25) = 67.041, then 6.9 for each pillar: of unknown stuff both are heavy.
    assert_db(loss_db([3.0, 1.0], [13.0, 1.0]), 67.041);
    assert_db(loss_db([3.0, 4.5], [13.0, 4.5]), 67.041 + 2.0 * 6.9);
    // 35 + 20 log10(3 / 0.25) = 56.584
    assert_db(loss_db([3.0, 4.5], [6.0, 4.5]), 56.584 + 6.9);
}

#[test]
fn a_link_costs_more_exponent_for_each_tile_on_its_way_in_the_subt_simulator() {
    // A row of tiles of 20 m, and a bend that costs 3.
    let passage = |a, b, cost| HeardAcross { tiles: [a, b], tile_m: 20.0, cost };
    let map = open().with_heard_across(vec![
        passage([0, 0], [1, 0], 1),
        passage([1, 0], [2, 0], 3),
        passage([2, 0], [3, 0], 12),
    ]);
    let params = RadioParams { align: false, ..of("visibility") };
    let model = make(&params, &map);
    let loss_db = |from_m: f64, to_m: f64| {
        let [a, b]: [Antenna; 2] = [from_m, to_m].map(|x_m| map.to_local([x_m, 4.0]).into());
        let there_db = model.loss_db(&map, &a, &b);
        assert_eq!(there_db.to_bits(), model.loss_db(&map, &b, &a).to_bits());
        there_db
    };
    // Within a tile 40 + 25 log10(8); one tile on 40 + 27 log10(20); two 40 + (25 + 8) log10(40).
    assert_db(loss_db(1.0, 9.0), 62.577);
    assert_db(loss_db(1.0, 21.0), 75.128);
    assert_db(loss_db(1.0, 41.0), 92.868);
    // 1 + 3 + 12 are more than 15; beyond the tiles nobody is heard.
    assert!([61.0, 99.0].iter().all(|&to_m| loss_db(1.0, to_m) >= crate::radio::NO_LINK_DB));
    // A map without a graph has no costs.
    let kind = RadioKind::BUILTIN.into_iter().find(|kind| kind.word() == "visibility").unwrap();
    let error = kind.make(&params, &open()).unwrap_err().to_string();
    assert!(error.contains("a map.subt with a graph beside it"), "{error}");
}

#[test]
fn no_loss_is_below_the_least_of_its_distance_and_none_differs_from_end_to_end() {
    let map = open();
    for model in ["log-distance", "multi-wall", "p1238", "two-slope"] {
        for align in [true, false] {
            let model = make(&RadioParams { align, ..of(model) }, &map);
            let mut before_db = f32::NEG_INFINITY;
            for i in 1..2_000 {
                let (a, b) = (Vec2::new(0.5, 0.5), Vec2::new(0.5 + 0.07 * i as f32, 0.5 + 0.003 * i as f32));
                let [there_db, back_db] =
                    [(a, b), (b, a)].map(|(a, b)| model.loss_db(&map, &a.into(), &b.into()));
                let least_db = model.least_loss_db(a.distance(b));
                assert!(
                    there_db.to_bits() == back_db.to_bits() && there_db >= least_db && least_db >= before_db
                );
                before_db = least_db;
            }
        }
    }
}
