//! Values at the ends of their ranges: whatever is allowed is flown to its end, and every number is a number.

use std::cell::Cell;

use proptest::{
    prelude::*,
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};
use uchain_core::{
    chain::{CenterParams, EqualizeParams, KalmanParams, LinkParams, TakeoffParams},
    params::Key,
};
use uchain_sim::{
    config::builtin,
    mission::chain::{Course, Frame, Summary},
    radio::{FaultConfig, PacketParams, RadioParams},
    record::{RecordError, Recorder},
    run::run,
    sense::{FlowParams, TofParams},
};

/// The tables whose numbers are drawn.
const TABLES: [(&str, &[Key]); 10] = [
    ("center", CenterParams::KEYS),
    ("kalman", KalmanParams::KEYS),
    ("equalize", EqualizeParams::KEYS),
    ("takeoff", TakeoffParams::KEYS),
    ("link", LinkParams::KEYS),
    ("radio", RadioParams::KEYS),
    ("packets", PacketParams::KEYS),
    ("faults", FaultConfig::KEYS),
    ("tof", TofParams::KEYS),
    ("flow", FlowParams::KEYS),
];

/// Whole numbers, and times that are multiples of the tick of 0.05 s.
const WHOLE: [&str; 2] = ["tof.rays", "packets.delay_ticks"];
const TICKS: [&str; 2] = ["equalize.decision_s", "tof.period_s"];

/// What is no number.
const WORDS: [&str; 14] = [
    "radio={ model = \"disc\", range_m = 0.5 }",
    "packets.wire=true",
    "link.base_flow=false",
    "link.gap=predict",
    "link.signal=raw",
    "equalize.law=inverse-model",
    "equalize.law=bang-bang",
    "equalize.spacing=true",
    "center.law=firmware",
    "takeoff.launch=converged",
    "takeoff.launch_signal=raw",
    "faults.dead=[{ uav = 0, start_s = 0.0 }]",
    "faults.dead=[{ uav = 0, start_s = 0.5 }]",
    "faults.deaf=[{ uav = 0, side = \"back\", start_s = 0.0, stop_s = 0.05 }, { uav = 0, side = \"front\" }]",
];

/// Every number is a number.
struct Numbers;

impl Recorder<Frame> for Numbers {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        for uav in &frame.uavs {
            let speeds = [uav.forward_mps, uav.lateral_mps, uav.yaw_rate_radps];
            let places = [uav.x_m, uav.y_m, uav.heading_rad];
            assert!(speeds.iter().chain(&places).all(|number| number.is_finite()), "{uav:?}");
            assert!(
                uav.tof.is_none_or(|t| [t.nw_m, t.ne_m, t.sw_m, t.se_m].iter().all(|m| *m >= 0.0)),
                "{uav:?}"
            );
        }
        for link in &frame.links {
            let read = [Some(link.true_db), link.filtered_db, link.raw_db];
            assert!(read.into_iter().flatten().all(f32::is_finite), "{link:?}");
        }
        Ok(())
    }
}

/// A run with these settings; `None` where they are refused, in words.
fn fly(name: &str, sets: &[String]) -> Option<Summary> {
    let course = Course::read(&builtin(name).unwrap(), sets).ok()?;
    let summary = run(&course, 1, &mut Numbers).unwrap();
    let text = format!("{summary:?}");
    assert!(
        ![": NaN", "(NaN", ": inf", "(inf", ": -inf", "(-inf"].iter().any(|no| text.contains(no)),
        "{sets:?}: {text}"
    );
    Some(summary)
}

/// An assignment of a value at this share of a key's range; `None` of what is no number.
fn assignment((table, key): (&str, &Key), share: f64) -> Option<String> {
    let name = format!("{table}.{}", key.name);
    let (low, high) = key.range?;
    let value = low + share * (high - low);
    let value = match name.as_str() {
        whole if WHOLE.contains(&whole) => format!("{}", value.round()),
        ticks if TICKS.contains(&ticks) => format!("{:?}", (value / 0.05).round().max(1.0) * 0.05),
        _ => format!("{value:?}"),
    };
    Some(format!("{name}={value}"))
}

#[test]
fn whatever_is_allowed_is_flown_to_its_end_and_every_number_is_one() {
    const CASES: u32 = 128;
    let keys: Vec<(&str, &Key)> =
        TABLES.iter().flat_map(|(table, keys)| keys.iter().map(move |key| (*table, key))).collect();
    let share = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64];
    let settings = (
        prop::collection::vec((0..keys.len(), share), 0..12),
        prop::collection::vec(0..WORDS.len(), 0..3),
        1_usize..5,
        prop_oneof![Just(1_u32), Just(2), 3..200_u32],
    );
    let flown = Cell::new(0);
    let config = Config { failure_persistence: None, ..Config::with_cases(CASES) };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let tried = runner.run(&settings, |(numbers, words, uavs, ticks)| {
        let numbers = numbers.into_iter().filter_map(|(key, share)| assignment(keys[key], share));
        let words = words.into_iter().map(|word| WORDS[word].to_owned());
        let size = [format!("chain.uavs={uavs}"), format!("duration_s={:?}", f64::from(ticks) * 0.05)];
        let sets: Vec<String> = numbers.chain(words).chain(size).collect();
        flown.set(flown.get() + u32::from(fly("straight", &sets).is_some()));
        Ok(())
    });
    tried.unwrap();
    assert!(flown.get() > CASES / 2, "only {} of {CASES} were allowed", flown.get());
}

#[test]
fn the_ends_that_are_asked_for_most_are_flown() {
    let all = |sets: &[&str]| sets.iter().map(ToString::to_string).collect::<Vec<_>>();
    for sets in [
        &["packets.drop_rate=1", "duration_s=20"][..],
        &["packets.limit_db=0", "duration_s=20"],
        &["radio.sigma_db=0", "flow.noise_mps=0", "tof.noise_m=0", "tof.dropout=0", "duration_s=20"],
        &["link.lost_s=0", "duration_s=20"],
        &["tof.dropout=1", "duration_s=20"],
        &["tof.range_m=100", "tof.rays=64", "duration_s=2"],
        &["flow.noise_mps=1", "duration_s=20"],
        &["equalize.decision_s=0.05", "duration_s=20"],
        &["packets.delay_ticks=1000", "duration_s=60"],
        &["duration_s=0.05"],
        &["chain.uavs=1", "duration_s=20"],
    ] {
        assert!(fly("straight", &all(sets)).is_some(), "{sets:?}");
    }
}

#[test]
fn a_thousand_uavs_are_flown() {
    let sets = [
        "chain.uavs=1000",
        "map.corridor.centre_line_m=[[0.0, 0.0], [160.0, 0.0]]",
        "chain.spacing_m=0.15",
        "takeoff.s_min_db=-50",
        "takeoff.launch_hold_s=0",
        "takeoff.after_previous_s=0",
        "duration_s=5",
    ]
    .map(str::to_owned);
    let summary = fly("straight", &sets).expect("a chain of a thousand may be asked for");
    assert!(summary.uavs > 5, "some have taken off: {summary:?}");
}

/// The control: what is watched for is noticed.
#[test]
#[should_panic(expected = "NaN")]
fn a_number_that_is_none_is_noticed() {
    let mut frame = Frame::default();
    frame.links.push(uchain_sim::mission::chain::LinkFrame {
        uav: 0,
        true_db: f32::NAN,
        filtered_db: None,
        raw_db: None,
        silence: None,
    });
    let _ = Numbers.frame(&frame);
}
