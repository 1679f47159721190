use std::sync::Arc;

use std::{fs, path::PathBuf};

use uchain_sim::{
    analyse::Outcome,
    config::{Source, builtin},
    mission::chain::{Course, Frame, McapRecorder, Summary},
    record::{RecordError, Recorder},
    registry::{AnyScene, Registry},
    replay::{self, Recording},
    run::run,
};

use crate::{course, shared_cases};

fn fly(name: &str, sets: &[&str]) -> Summary {
    run(&course(name, sets), 1, &mut ()).unwrap()
}

/// The outcome's word, and the words.
fn said(summary: &Summary) -> (&'static str, String) {
    (summary.verdict.outcome().word(), summary.verdict.to_string())
}

fn scene(sets: &[&str]) -> Result<Arc<dyn AnyScene>, String> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Registry::default().read(&builtin("straight").unwrap(), &sets).map_err(|error| error.to_string())
}

#[test]
fn a_chain_that_did_what_was_asked_says_so_with_its_numbers() {
    for name in ["straight", "corner", "bend", "circuit"] {
        let (word, words) = said(&fly(name, &[]));
        assert_eq!(word, "completed", "{name}: {words}");
        assert!(words.contains(" m flown") && words.contains("within 60 dB, the worst 5"), "{name}: {words}");
    }
}

#[test]
fn a_row_that_puts_the_head_far_away_is_named_before_the_start_and_after_it() {
    let far = scene(&["chain.uavs=40"]).unwrap();
    let [note] = far.notes().try_into().unwrap();
    assert!(note.contains("the head waits 9.75 m from the base, and loses 66.8 dB"), "{note}");
    let course = far.get::<Course>().expect("a chain");
    let (word, words) = said(&run(course, 1, &mut ()).unwrap());
    assert_eq!(word, "not-launched", "{words}");
    assert!(words.contains("none of 39 relays took off, and 1 of 1 link over 60 dB"), "{words}");

    // What the note asks for helps.
    for set in note.split("--set ").skip(1).map(|set| set.trim_end_matches(" or ")) {
        assert_eq!(scene(&["chain.uavs=40", set]).unwrap().notes(), Vec::<String>::new(), "{set}");
    }
    assert_eq!(scene(&[]).unwrap().notes(), Vec::<String>::new(), "nothing is wrong with a short row");
}

#[test]
fn relays_that_wait_for_ever_are_not_launched_and_those_that_are_not_there_are_short() {
    let (word, words) = said(&fly("straight", &["takeoff.launch_hold_s=600"]));
    assert_eq!(word, "not-launched", "{words}");
    assert!(words.contains("none of 3 relays took off"), "{words}");
    let (word, words) = said(&fly("straight", &["chain.uavs=2"]));
    assert_eq!(word, "relays-short", "{words}");
    assert!(words.contains("1 relay short: 1 in the air, 2 needed, and 2 of 2 links over 60 dB"), "{words}");
    let (word, words) = said(&fly("straight", &["chain.uavs=1"]));
    assert_eq!(word, "relays-short", "{words}");
    assert!(words.contains("2 relays short: 0 in the air, 2 needed, and 1 of 1 link over 60 dB"), "{words}");
}

#[test]
fn thresholds_that_keep_relays_on_the_ground_are_refused_with_what_to_set() {
    let remedy = "--set link.head_stop_db=85 --set link.head_back_db=90 --set link.relay_back_db=95";
    for sets in [&["takeoff.s_min_db=75"][..], &["takeoff.s_min_db=75", "link.head_stop_db=70"]] {
        let error = scene(sets).unwrap_err();
        assert!(
            error.contains("70: else the head stops before the next relay takes off")
                || error.contains("must lie above takeoff.s_min_db = 75"),
            "{error}"
        );
        assert!(error.ends_with(remedy), "{error}");
    }
    let sets: Vec<&str> =
        std::iter::once("takeoff.s_min_db=75").chain(remedy.split("--set ").skip(1).map(str::trim)).collect();
    assert!(scene(&sets).is_ok(), "what it asks for is taken");
    let error = scene(&["link.relay_back_db=60"]).unwrap_err();
    assert!(error.contains("must lie above takeoff.s_min_db = 60: else relays fly back"), "{error}");
    let error = scene(&["link.head_back_db=69"]).unwrap_err();
    assert!(error.contains("must be at least link.head_stop_db = 70"), "{error}");
    // A head alone waits for nobody, and presets are as they were flown.
    for set in ["chain.uavs=1", "preset=cavemod", "preset=frontiers2021"] {
        let s_min = if set == "chain.uavs=1" { "takeoff.s_min_db=75" } else { "takeoff.s_min_db=60" };
        assert!(scene(&[set, s_min]).is_ok(), "{set}");
    }
}

#[test]
fn a_reception_below_the_threshold_and_a_pilot_too_fast_are_noted() {
    let [note] = scene(&["packets.limit_db=50"]).unwrap().notes().try_into().unwrap();
    assert!(note.ends_with("try --set packets.limit_db=100"), "{note}");
    let [note] = scene(&["pilot.0.speed_mps=0.5"]).unwrap().notes().try_into().unwrap();
    assert!(note.ends_with("try --set equalize.v_max_mps=0.5"), "{note}");
}

/// A pocket 8 m long; nobody says where its middle is, so nobody knows that it ends there.
fn pocket(seconds: f64) -> Arc<Course> {
    let text = format!(
        "name = \"pocket\"\nduration_s = {seconds}\n[map.walls]\nouter_m = [[0, 0], [8, 0], [8, 1], [0, 1]]\n[chain]\n\
         uavs = 4\nbase_m = [0.5, 0.5]\n[[pilot]]\nstart_s = 0.0\nspeed_mps = 0.2\n"
    );
    let source = Source { label: "pocket.toml".to_owned(), text, folder: PathBuf::new() };
    // The laws as printed stay at a wall ahead; the default one turns away.
    Course::read(&source, &["center.law=paper".to_owned()]).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_head_that_may_fly_and_stays_where_it_is_is_stuck() {
    let s = run(&pocket(70.0), 1, &mut ()).unwrap();
    let (word, words) = said(&s);
    assert_eq!(word, "head-stuck", "{words}");
    let Outcome::HeadStuck { way, from_s, stuck_s, at_m } = s.verdict.outcome() else { panic!("{words}") };
    assert!((30.0..45.0).contains(from_s) && (25.0..40.0).contains(stuck_s), "{words}");
    assert!(at_m[0] > 7.0 && way.asked_m > way.flown_m + 4.0, "{words}");
    // Nobody calls it so before it has come to the wall.
    let (word, words) = said(&run(&pocket(30.0), 1, &mut ()).unwrap());
    assert_eq!(word, "completed", "{words}");
}

#[test]
fn every_head_that_stays_in_a_corner_is_named() {
    for (name, seeds) in [("corner", [220, 426, 451]), ("circuit", [52, 66, 118])] {
        for (law, stays) in [("center.law=\"paper\"", true), ("center.law=\"wall\"", false)] {
            let course = course(name, &[law]);
            for seed in seeds {
                let (word, words) = said(&run(&course, seed, &mut ()).unwrap());
                // One slides on along the wall, and is short of the way asked for.
                let is_named = word == "head-stuck" || word == "head-short";
                assert_eq!(is_named, stays, "{name}, {law}, seed {seed}: {word}: {words}");
            }
        }
    }
}

#[test]
fn a_head_at_the_end_of_its_tunnel_is_not_stuck() {
    let (word, words) = said(&fly("straight", &["pilot.1.start_s=119"]));
    assert_eq!(word, "completed", "{words}");
    assert!(words.contains("m flown, up to the tunnel's end"), "{words}");
}

#[test]
fn a_head_that_its_link_holds_back_is_held_and_not_stuck() {
    // 70 dB are 3.7 m, and nobody follows.
    let (word, words) = said(&fly("straight", &["chain.uavs=1", "radio.alpha_free=3"]));
    assert_eq!(word, "relays-short", "{words}");
    assert!(words.contains("; the head was held back by its link: ") && !words.contains("stuck"), "{words}");
}

#[test]
fn a_planned_fault_that_healed_is_no_failure_and_one_that_did_not_is() {
    let deaf =
        |stop: &str| fly("circuit", &[&format!("faults.deaf=[{{uav=1,side=\"front\",start_s=60.0{stop}}}]")]);
    let (word, words) = said(&deaf(",stop_s=63.0"));
    assert_eq!(word, "completed", "{words}");
    let (word, words) = said(&deaf(""));
    assert_eq!(word, "chain-broken", "{words}");
    assert!(words.contains("nobody had heard the head for 6"), "{words}");
}

#[test]
fn connected_is_who_is_heard_both_ways_and_below_the_limit_is_the_measure_by_loss_alone() {
    let fractions = |s: &Summary| (s.connected_fraction, s.below_limit_fraction);
    assert_eq!(fractions(&fly("straight", &["packets.limit_db=0"])), (Some(0.0), Some(0.0)));
    assert_eq!(fractions(&fly("straight", &["packets.drop_rate=1"])), (Some(0.0), Some(1.0)));
    assert_eq!(fractions(&fly("straight", &["packets.drop_rate=0"])), (Some(1.0), Some(1.0)));
    let s = fly("straight", &["faults.dead=[{uav=0,start_s=0.0}]"]);
    assert_eq!((said(&s).0, fractions(&s)), ("never-flew", (None, None)), "of nobody nothing is true");
}

#[test]
fn a_head_that_hears_nobody_is_connected_to_nobody() {
    let Some(cases) = shared_cases() else { return };
    let text = fs::read_to_string(cases.join("deaf/deaf.toml")).unwrap();
    let source = Source { label: "deaf.toml".to_owned(), text, folder: PathBuf::new() };
    let s = run(&Course::read(&source, &[]).unwrap(), 1, &mut ()).unwrap();
    assert_eq!(
        (said(&s).0, s.connected_fraction, s.below_limit_fraction),
        ("chain-broken", Some(0.0), Some(1.0))
    );
    assert!(said(&s).1.contains("the head never heard anybody"), "{}", said(&s).1);
}

/// Frames as versions before wrote them.
struct Older<R>(R);

impl<R: Recorder<Frame>> Recorder<Frame> for Older<R> {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        frame.head = None;
        frame.links.iter_mut().for_each(|link| link.silence = None);
        self.0.frame(&frame)
    }
}

#[test]
fn of_a_recording_that_does_not_say_who_heard_whom_nobody_knows_how_long_it_was_connected() {
    let course = course("straight", &["duration_s=30"]);
    let mut older = Older(McapRecorder::start(Vec::new(), &course, 1).unwrap());
    let flown = run(&course, 1, &mut older).unwrap();
    let file = older.0.finish().unwrap();
    let read =
        Recording::<_, Course>::read(file.as_slice(), "memory").unwrap().summary(&course, &mut ()).unwrap();
    assert_eq!((read.connected_fraction, read.below_limit_fraction), (None, flown.below_limit_fraction));
    assert!(
        said(&read).1.ends_with("; the recording does not say who heard whom, and what the pilot asked for")
    );
    assert_eq!(read.digest, flown.digest);
    let verdict =
        replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
    assert!(verdict.agrees(), "what was not written is not held against it: {verdict:?}");
}

#[test]
fn a_flight_that_is_known_in_part_has_the_links_it_had_there() {
    let course = course("straight", &["duration_s=60"]);
    let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
    run(&course, 1, &mut recorder).unwrap();
    let file = recorder.finish().unwrap();
    let cut = &file[..file.len() / 2];
    let s = Recording::<_, Course>::read(cut, "memory").unwrap().summary(&course, &mut ()).unwrap();
    assert!(s.sim_s > 5.0 && s.sim_s < 60.0, "{}", s.sim_s);
    assert_eq!(said(&s).0, "interrupted");
    assert_eq!((s.links.len(), s.spread_db.is_some()), (s.uavs, s.uavs > 1), "{s:?}");
}
