use super::*;
use crate::{config::builtin, mission::chain::Course};

#[test]
fn the_loss_of_a_cell_is_that_of_the_model_and_the_limit_is_where_its_distance_says() {
    let course = Course::read(&builtin("straight").unwrap(), &[]).unwrap();
    // 35 dB at 0.25 m and an exponent of 2: 35 + 20 log10(d / 0.25) = 61 dB at 0.25 · 10^1.3 = 4.988 m.
    let losses = LossMap::of(&course.map, &*course.radio, course.base, 61.0);
    let expected_m = 0.25 * libm::exp10(1.3);
    assert!(
        (losses.farthest_m - expected_m).abs() < 2.0 * losses.cell_m,
        "{} {expected_m}",
        losses.farthest_m
    );
    assert_eq!(losses.loss_db.len(), losses.size[0] * losses.size[1]);
    let [column, row] = [losses.size[0] / 2, losses.size[1] / 2];
    let [x, y] = losses.middle_m(column, row);
    let straight = course.loss_db(&Antenna::from(course.base), &Antenna::from(course.map.to_local([x, y])));
    assert!((losses.at(column, row).unwrap() - straight).abs() < 1e-3);
    assert_eq!(losses.at(losses.size[0], 0), None, "beyond the last column lies no cell of the next row");
    let free = losses.loss_db.iter().flatten().count();
    assert_eq!(losses.csv().lines().count(), free + 1);
}

#[test]
fn along_a_tunnel_the_loss_passes_the_limit_where_its_distance_says() {
    let course = Course::read(&builtin("straight").unwrap(), &[]).unwrap();
    let tunnel = course.tunnel.as_ref().unwrap();
    let depths = (0..=200).map(|step| tunnel.length_m() * f64::from(step) / 200.0);
    let places = depths.map(|depth_m| (depth_m, tunnel.at(depth_m).0));
    let along = LossAlong::of(&course.map, &*course.radio, course.base, 61.0, places);
    assert_eq!(along.passes_m.len(), 1, "{:?}", along.passes_m);
    assert!((along.passes_m[0] - 0.25 * libm::exp10(1.3)).abs() < 0.1, "{:?}", along.passes_m);
    assert_eq!(along.csv().lines().count(), 202);
}

#[test]
fn losses_that_are_no_number_count_as_no_link() {
    #[derive(Debug)]
    struct Nothing;
    impl RadioModel for Nothing {
        fn loss_db(&self, _: &Map, _: &Antenna, _: &Antenna) -> f32 {
            f32::NAN
        }
    }
    let course = Course::read(&builtin("corner").unwrap(), &[]).unwrap();
    let losses = LossMap::of(&course.map, &Nothing, course.base, 61.0);
    assert!(losses.loss_db.contains(&None), "rock has no loss");
    assert!(losses.loss_db.iter().flatten().all(|db| *db == crate::radio::NO_LINK_DB));
    assert_eq!((losses.share_within, losses.farthest_m), (0.0, 0.0));
}
