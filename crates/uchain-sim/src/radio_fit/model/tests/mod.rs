mod draws;

use super::*;
use draws::{TRUTH, Truth, walk};

fn fitted(log: &Log) -> Fit {
    fit(log, &FitOptions::default()).unwrap()
}

/// How many of so many draws have each truth within its interval: L0, exponent, noise, shadowing, length, and the exponent
/// within what least squares claims.
fn covered(
    draws: std::ops::Range<u64>,
    truth: &Truth,
    places: usize,
    step_m: f64,
    packets: usize,
) -> [usize; 6] {
    let mut held = [0; 6];
    for seed in draws {
        let fit = fitted(&walk(seed, truth, places, step_m, packets));
        let holds = [
            fit.reference_loss_db.holds(truth.reference_loss_db),
            fit.alpha.holds(truth.alpha),
            fit.sigma_db.holds(truth.sigma_db),
            fit.sigma_static_db.holds(truth.sigma_static_db),
            fit.correlation_m.holds(truth.correlation_m),
            fit.least_squares.alpha.holds(truth.alpha),
        ];
        for (held, holds) in held.iter_mut().zip(holds) {
            *held += usize::from(holds);
        }
    }
    held
}

/// 0.91 to 0.98 of 200, and of 40 as many as a binomial with 0.945 has but once in a thousand.
fn are_nineteen_of_twenty(held: &[usize], draws: usize) -> bool {
    let (least, most) = if draws == 200 { (182, 196) } else { (33, draws) };
    held.iter().all(|held| (least..=most).contains(held))
}

#[test]
fn intervals_hold_the_truth_in_nineteen_of_twenty_draws_and_those_of_least_squares_do_not() {
    let held = covered(0..40, &TRUTH, 60, 0.4, 3);
    assert!(are_nineteen_of_twenty(&held[..5], 40), "{held:?}");
    // The negative control: who takes packets for independent is wrong most of the time.
    assert!(held[5] < 20, "{held:?}");
}

#[test]
#[ignore = "minutes: the figures in docs/guide/radio-fit.md; L0 with weak shadowing misses the bound by one, 197"]
fn intervals_hold_the_truth_in_nineteen_of_twenty_of_200_draws() {
    let weak = Truth { sigma_static_db: 2.0, ..TRUTH };
    let cut = Truth { limit_db: 85.0, ..TRUTH };
    for (name, truth, places, step_m, packets) in [
        ("as drawn", &TRUTH, 150, 0.2, 2),
        ("denser", &TRUTH, 200, 0.1, 1),
        ("weak shadowing", &weak, 150, 0.2, 2),
        ("cut at 85 dB", &cut, 150, 0.2, 2),
    ] {
        // Not the draws by which the prior of the length was chosen, 0 to 199.
        let held = covered(1000..1200, truth, places, step_m, packets);
        println!("{name}: {held:?}");
        assert!(are_nineteen_of_twenty(&held[..5], 200), "{name}: {held:?}");
        assert!(held[5] < 120, "{name}: {held:?}");
    }
}

#[test]
fn packets_that_were_not_heard_take_the_bias_off_the_exponent() {
    let truth = Truth { limit_db: 80.0, sigma_static_db: 0.5, ..TRUTH };
    let log = walk(3, &truth, 150, 0.2, 4);
    let deaf = Log {
        samples: log.samples.iter().filter(|sample| sample.loss_db.is_some()).cloned().collect(),
        ..log.clone()
    };
    let (told, cut) = (fitted(&log), fitted(&deaf));
    assert!(told.packets.heard + 50 < told.packets.sent, "{:?}", told.packets);
    assert!(
        told.alpha.holds(2.5) && (told.alpha.value - 2.5).abs() < (cut.alpha.value - 2.5).abs(),
        "{} {}",
        told.alpha.value,
        cut.alpha.value
    );
    assert!(cut.alpha.value < 2.4, "the control: {}", cut.alpha.value);
    assert!((told.packets.limit_db.unwrap() - 80.0).abs() < 1.0, "{:?}", told.packets);
    assert!(cut.packets.limit_db.is_none());
}

#[test]
fn packets_lost_by_chance_are_no_limit() {
    let mut log = walk(5, &TRUTH, 100, 0.2, 4);
    for sample in log.samples.iter_mut().step_by(5) {
        sample.loss_db = None;
    }
    let fit = fitted(&log);
    assert_eq!(fit.packets.limit_db, None);
    assert!((fit.packets.random - 0.2).abs() < 1e-9, "{:?}", fit.packets);
    assert!(fit.warnings.iter().any(|words| words.starts_with("20 % of the packets")), "{:?}", fit.warnings);
    assert!(fit.radio_toml().unwrap().contains("[packets]\ndrop_rate = 0.2"));
}

/// A log of one link with a loss for each distance.
fn of_distances(loss_db: impl Fn(f64, usize) -> f64, distances_m: &[f64]) -> Log {
    let packets = distances_m.iter().flat_map(|&distance_m| (0..20).map(move |nth| (distance_m, nth)));
    let samples = packets.map(|(distance_m, nth)| crate::radio_fit::Sample {
        line: 2,
        link: 0,
        loss_db: Some(loss_db(distance_m, nth) + [0.5, -0.7, 0.3, -0.1][nth % 4]),
        distance_m,
        ends_m: [distance_m, 0.0, 0.0, 0.0, 0.0, 0.0],
    });
    Log {
        label: "told".to_owned(),
        links: vec![String::new()],
        samples: samples.collect(),
        has_places: false,
        notes: Vec::new(),
    }
}

#[test]
fn data_that_support_no_fit_are_refused_with_the_reason_and_give_no_table() {
    let line = |m: f64, _: usize| 35.0 + 25.0 * libm::log10(m / 0.25);
    let good = fitted(&of_distances(line, &[0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0]));
    assert!(
        good.refusals.is_empty() && good.radio_toml().is_some() && !good.sets().is_empty(),
        "{:?}",
        good.refusals
    );
    let humped = |m: f64, _: usize| if m < 2.0 { 40.0 + 10.0 * m } else { 60.0 - 4.0 * (m - 2.0) };
    for (log, reason) in [
        (
            of_distances(line, &[3.0, 3.2, 3.4, 3.6, 3.8, 4.0]),
            "distances from 3.00 to 4.00 m tell no exponent",
        ),
        (of_distances(line, &[1.0, 3.0, 9.0]), "3 distances that differ are too few"),
        (
            of_distances(humped, &[0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0]),
            "the mean loss falls with the distance",
        ),
        (of_distances(|_, _| 50.0, &[0.5, 1.0, 2.0, 3.0, 4.0, 5.0]), "holds 0 or less"),
    ] {
        let fit = fitted(&log);
        assert!(fit.refusals.iter().any(|words| words.contains(reason)), "{reason}: {:?}", fit.refusals);
        assert_eq!((fit.radio_toml(), fit.sets()), (None, Vec::new()));
        assert!(fit.text().contains("refused: ") && !fit.text().contains("[radio]"));
    }
    // Links of which each is a clean line, and no line is both.
    let mut two = of_distances(line, &[0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0]);
    let steep =
        of_distances(|m, _| 35.0 + 40.0 * libm::log10(m / 0.25), &[0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0]);
    two.links = vec!["a".to_owned(), "b".to_owned()];
    two.samples
        .extend(steep.samples.into_iter().map(|sample| crate::radio_fit::Sample { link: 1, ..sample }));
    let fit = fitted(&two);
    assert!(
        fit.exponents_agree.unwrap() < 0.01 || fit.warnings.iter().any(|words| words.contains("range from")),
        "{fit:?}"
    );
    let few = of_distances(line, &[1.0]);
    assert!(fit_error(&few).contains("at 1 places: expected at least 8 at 3"));
}

fn fit_error(log: &Log) -> String {
    fit(log, &FitOptions::default()).unwrap_err().to_string()
}

#[test]
fn a_length_that_no_walk_tells_is_said_to_be_open() {
    // 4 m of walk under shadowing of 20 m.
    let fit = fitted(&walk(2, &Truth { correlation_m: 20.0, ..TRUTH }, 40, 0.1, 3));
    assert!(
        fit.warnings
            .iter()
            .any(|words| words.contains("not bounded above") || words.contains("not told from noise")),
        "{:?}",
        fit.warnings
    );
}

#[test]
fn many_packets_are_counted_together_in_bounded_time_and_their_intervals_hold_as_well() {
    let fit = fitted(&walk(1, &TRUTH, 6_000, 0.004, 1));
    assert!(fit.places <= places::PLACES_MAX && fit.cell_m > 0.0, "{} {}", fit.places, fit.cell_m);
    let held = covered(0..6, &TRUTH, 6_000, 0.004, 1);
    assert!(held[..5].iter().all(|held| *held >= 4), "{held:?}");
}

/// The fitting of what the simulator's own radio loses: its shadowing is a sum of waves, its noise that of a channel.
#[test]
fn a_log_of_the_simulator_is_fitted_back() {
    use crate::{
        config::builtin,
        mission::chain::Course,
        seed::{Seed, Source},
    };
    let sets = [
        "map.corridor.centre_line_m=[[0.0, 0.0], [40.0, 0.0]]",
        "radio.sigma_static_db=4",
        "radio.correlation_m=1.5",
        "radio.alpha_free=2.5",
    ];
    let course = Course::read(&builtin("straight").unwrap(), &sets.map(str::to_owned)).unwrap();
    let mut held = [0; 5];
    for seed in 0..20 {
        let radio = course.radio.seeded(Seed(seed)).unwrap();
        let mut stream = Seed(seed).stream(0, Source::Start);
        let base = crate::radio::Antenna::from(course.base);
        let samples = (0..300_u16).map(|nth| {
            let distance_m = 0.5 + 0.1 * f32::from(nth / 2 * 2);
            let at = course.base + glam::Vec2::new(distance_m, 0.0);
            let loss_db =
                radio.loss_db(&course.map, &base, &crate::radio::Antenna::from(at)) + 3.0 * stream.normal();
            let [x1, y1, x2, y2] = [at.x, at.y, course.base.x, course.base.y].map(f64::from);
            crate::radio_fit::Sample {
                line: 2,
                link: 0,
                loss_db: Some(loss_db.into()),
                distance_m: distance_m.into(),
                ends_m: [x1, y1, 0.0, x2, y2, 0.0],
            }
        });
        let (label, links) = ("flown".to_owned(), vec![String::new()]);
        let fit =
            fitted(&Log { label, links, samples: samples.collect(), has_places: true, notes: Vec::new() });
        let truths = [
            (fit.reference_loss_db, 35.0),
            (fit.alpha, 2.5),
            (fit.sigma_db, 3.0),
            (fit.sigma_static_db, 4.0),
            (fit.correlation_m, 1.5),
        ];
        for (held, (interval, truth)) in held.iter_mut().zip(truths) {
            *held += usize::from(interval.holds(truth));
        }
    }
    println!("of 20 logs of the simulator: {held:?}");
    assert!(held.iter().all(|held| *held >= 15), "{held:?}");
}
