//! The speed that levels a relay's links may come from elsewhere: from whoever sees all relays of a run at once, or from
//! outside, at whatever time.

use std::{ops::ControlFlow, sync::Arc};

use uchain_core::chain::{EqualizeParams, PilotInput, equalize};
use uchain_sim::{
    mission::{
        Mission, UnderWay,
        chain::{Asked, Chain, ChainOf, Course, Flight, History, Leveller, McapRecorder},
    },
    record::RecordError,
    registry::AnyScene,
    replay::{self, Recording},
    run::run,
};

use super::own_law::Mine;
use crate::course;

/// Eq. 12, until it breaks off at a tick.
#[derive(Debug)]
struct Eq12 {
    params: EqualizeParams,
    until: u64,
}

fn speed_mps(asked: &Asked, params: &EqualizeParams) -> f32 {
    equalize(asked.levelling.back_db, asked.levelling.front_db, params)
}

impl Leveller for Eq12 {
    fn level(&mut self, tick: u64, asked: &[Asked], level_mps: &mut [f32]) -> ControlFlow<()> {
        assert!(!asked.is_empty() && asked.is_sorted_by_key(|asked| asked.uav));
        for (level_mps, asked) in level_mps.iter_mut().zip(asked) {
            *level_mps = speed_mps(asked, &self.params);
        }
        if tick >= self.until { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

fn levelled(course: &Course, gain: f32, until: u64) -> Arc<Course> {
    course.with_leveller("eq-12", move |course| {
        let mut params = course.scenario.equalize.clone();
        params.k_db_per_m *= gain;
        Eq12 { params, until }
    })
}

/// Scenarios in which relays fail, deliver late, decide by raw losses, and by other laws.
fn courses() -> [Arc<Course>; 4] {
    [
        course("straight", &["duration_s=150", "faults.dead=[{ uav = 1, start_s = 70 }]"]),
        course("corner", &["packets.delay_ticks=6", "faults.burst_rate=0.05"]),
        course("circuit", &["link.signal=raw", "takeoff.launch=converged"]),
        course("corner", &["equalize.law=bang-bang", "equalize.decision_s=0.1"]),
    ]
}

#[test]
fn whoever_levels_by_eq_12_has_the_digest_of_the_built_in_law() {
    for built_in in courses() {
        let digest = |course: &Arc<Course>| run(course, 3, &mut ()).unwrap().digest;
        assert_eq!(digest(&levelled(&built_in, 1.0, u64::MAX)), digest(&built_in));
        if built_in.scenario.equalize.law == EqualizeParams::default().law {
            assert_ne!(digest(&levelled(&built_in, 1.001, u64::MAX)), digest(&built_in), "the control");
        }
    }
}

#[test]
fn a_flight_that_is_levelled_from_outside_by_eq_12_is_the_run_and_is_reset_to_it() {
    for course in courses() {
        let mut flight = Flight::start(&course, 5);
        for seed in [5, 3] {
            flight.reset(seed);
            let mut frames = History::default();
            while flight.stopped().is_none() {
                let first = flight.asked().to_vec();
                assert_eq!(flight.asked(), first, "a second look");
                let level_mps: Vec<f32> =
                    first.iter().map(|asked| speed_mps(asked, &course.scenario.equalize)).collect();
                flight.go_on(&level_mps, &mut frames).unwrap();
            }
            let mut wanted = History::default();
            assert_eq!(flight.summary(), run(&course, seed, &mut wanted).unwrap());
            assert_eq!(frames.frames, wanted.frames);
            // It is over: nobody asks, and nothing moves.
            assert!(flight.asked().is_empty());
            flight.go_on(&[1.0], &mut ()).unwrap();
            assert_eq!(flight.summary().digest, run(&course, seed, &mut ()).unwrap().digest);
        }
    }
}

#[test]
fn other_speeds_are_another_flight_and_no_number_is_none() {
    let course = course("corner", &[]);
    let digest = |wish_mps: f32| {
        let mut flight = Flight::start(&course, 1);
        while flight.go_on(&[wish_mps; 4], &mut ()).unwrap().is_none() {}
        flight.summary().digest
    };
    assert_ne!(digest(0.1), run(&course, 1, &mut ()).unwrap().digest);
    assert_ne!(digest(0.1), digest(0.0));
    for none in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(digest(none), digest(0.0));
    }
}

#[test]
fn who_breaks_off_ends_the_run_at_that_very_tick() {
    let course = course("corner", &[]);
    let (broken, mut frames) = (levelled(&course, 1.0, 1200), History::default());
    let error = run(&broken, 1, &mut frames).unwrap_err();
    assert!(matches!(error, RecordError::Interrupted { time_s: 60.0 }), "{error}");
    assert!(frames.frames.last().is_some_and(|last| last.tick == 1197), "{:?}", frames.frames.last());
    // Through the doors of all missions as well, and another run of the same course is not broken off.
    let any = <dyn AnyScene>::of(broken);
    assert!(any.get::<Course>().is_some());
    assert!(any.fly(1, &mut ()).is_err());
    let whole = <dyn AnyScene>::of(levelled(&course, 1.0, u64::MAX));
    assert_eq!(whole.fly(1, &mut ()).unwrap().digest(), run(&course, 1, &mut ()).unwrap().digest);
}

#[test]
fn a_recording_of_a_law_that_nobody_here_has_is_read_and_not_flown() {
    let course = levelled(&course("straight", &["duration_s=60"]), 1.5, u64::MAX);
    let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
    let flown = run(&course, 1, &mut recorder).unwrap();
    let file = recorder.finish().unwrap();
    let read = || Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let mut recording = read();
    let scene = recording.scene().unwrap();
    assert_eq!(scene.scenario.to_toml().unwrap(), course.scenario.to_toml().unwrap());
    assert_eq!(recording.summary(&scene, &mut ()).unwrap(), flown);
    assert!(matches!(run(&scene, 1, &mut ()), Err(RecordError::Interrupted { .. })));
    let error = replay::verify(&mut read()).unwrap_err().to_string();
    assert!(error.contains("chain.brain = \"eq-12\": unknown choice"), "{error}");
}

#[test]
fn halves_and_wholes_of_decisions_may_take_turns() {
    let course = course("corner", &[]);
    let (mut halves, mut whole) = (Chain::start(course.clone(), 2), Chain::start(course.clone(), 2));
    let mut commands = Vec::new();
    let mut asked_for = 0;
    for tick in 0..2400 {
        match tick % 3 {
            0 => {
                halves.sense();
                halves.decide(&mut commands);
            }
            1 => {
                asked_for += halves.prepare().len();
                halves.decide(&mut commands);
            }
            _ => {
                let asked = halves.prepare().to_vec();
                let level_mps: Vec<f32> =
                    asked.iter().map(|asked| speed_mps(asked, &course.scenario.equalize)).collect();
                halves.conclude(&level_mps, &mut commands);
            }
        }
        halves.act(&commands);
        whole.step(&mut ()).unwrap();
        assert_eq!(halves.frame(), whole.frame());
    }
    assert!(asked_for > 100, "{asked_for}");
}

#[test]
fn brains_that_decide_as_a_whole_ask_nobody() {
    let built_in = course("corner", &[]);
    let own = built_in.with_law("mine", Mine::new);
    let mut flight = Flight::start(&own, 1);
    while flight.stopped().is_none() {
        assert!(flight.asked().is_empty());
        flight.go_on(&[], &mut ()).unwrap();
    }
    assert_eq!(flight.summary().digest, run(&built_in, 1, &mut ()).unwrap().digest);
}

#[test]
fn who_steers_a_flight_steers_its_head_from_the_next_tick_on() {
    let course = course("straight", &["duration_s=60"]);
    let mut flight = Flight::start(&course, 1);
    assert!(flight.steer(PilotInput { speed_mps: 3.0, ..PilotInput::default() }).is_err());
    flight.steer(PilotInput::default()).unwrap();
    while flight.go_on(&[], &mut ()).unwrap().is_none() {}
    assert!(flight.summary().head_reach_m < 0.5 * run(&course, 1, &mut ()).unwrap().head_reach_m);
}

#[test]
fn a_mission_under_way_is_summed_up_whenever_one_asks_and_starts_again() {
    let course = course("corner", &["duration_s=30"]);
    let mut under_way = UnderWay::<ChainOf<uchain_core::chain::Node>>::start(&course, 7);
    assert_eq!(under_way.summary().sim_s, 0.0);
    for seed in [7, 1] {
        under_way.reset(seed);
        while under_way.tick(&mut ()).unwrap().is_none() {
            assert!(under_way.summary().sim_s > 0.0);
        }
        assert_eq!(under_way.summary(), run(&course, seed, &mut ()).unwrap());
    }
}
