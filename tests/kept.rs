//! All of a run at once: what programs that look into runs keep of it.

use std::{
    io::{Cursor, ErrorKind},
    ops::ControlFlow,
};

use uchain_sim::{
    config::builtin,
    mission::{
        Keep, Log,
        chain::{PlanError, PlanOptions, plan_while},
    },
    record::{
        RecordError,
        mcap::ReadError,
        table::{Table, Values},
    },
    registry::{AnyScene, Kept, Now, Registry, Watch},
};

fn read(name: &str, sets: &[&str]) -> std::sync::Arc<dyn AnyScene> {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Registry::default().read(&builtin(name).unwrap(), &sets).unwrap()
}

/// Of equal bits, what is no number included.
fn text(log: &Log) -> String {
    format!("{log:?}")
}

fn table<'a>(log: &'a Log, name: &str) -> &'a Table {
    log.tables.iter().find(|table| table.name == name).unwrap()
}

fn numbers<'a>(table: &'a Table, name: &str) -> &'a [f64] {
    match &table.columns.iter().find(|column| column.name == name).unwrap().values {
        Values::Numbers(values) => values,
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_kept_of_a_run_is_kept_of_its_recording_too() {
    for name in ["corner", "apartment"] {
        let scene = read(name, &["duration_s=20"]);
        let mut file = Vec::new();
        let mut flown = scene.keep(3, Some(Keep::Ticks), Some(Box::new(&mut file)), &mut ()).unwrap();
        let mut recording = Registry::default().open_bytes(Box::new(Cursor::new(file)), "memory").unwrap();
        let mut played = recording.keep(Some(Keep::Ticks), &mut ()).unwrap();
        assert!(played.is_whole() && played.ticks() == flown.ticks(), "{name}");
        assert_eq!(played.digest(), flown.digest(), "{name}");
        assert_eq!(played.json(None, "0").unwrap(), flown.json(None, "0").unwrap(), "{name}");
        assert!(played.graph() == flown.graph(), "{name}");
        assert_eq!(played.graph().is_some(), name == "apartment");
        let (log, again) = (flown.take_log(), played.take_log());
        assert!(text(&log) == text(&again), "{name}");
        assert!(!log.events.is_empty() && table(&log, "frames").rows as u64 == flown.ticks(), "{name}");
        assert_eq!(flown.take_log(), Log::default(), "handed over once");
        let other = scene.keep(4, Some(Keep::Ticks), None, &mut ()).unwrap().take_log();
        assert!(text(&log) != text(&other), "{name}: the control, another seed");
    }
}

#[test]
fn frames_of_decisions_are_some_of_all_frames_and_without_any_the_run_is_the_same() {
    let scene = read("corner", &["duration_s=20"]);
    let keep = |keep| scene.keep(1, keep, None, &mut ()).unwrap();
    let (mut all, mut some, mut none) = (keep(Some(Keep::Ticks)), keep(Some(Keep::Decisions)), keep(None));
    assert_eq!((all.digest(), some.digest()), (none.digest(), none.digest()));
    let (all, some, none) = (all.take_log(), some.take_log(), none.take_log());
    assert!(none.tables.is_empty() && none.events == all.events);
    let (every, few) = (table(&all, "frames"), table(&some, "frames"));
    assert_eq!((every.rows, few.rows), (400, 100));
    assert_eq!(numbers(few, "time_s")[..2], [0.05, 0.25]);
    assert_eq!(numbers(few, "time_s"), numbers(table(&some, "links"), "time_s"));
}

#[test]
fn frames_that_take_too_much_are_refused_before_the_first_tick() {
    struct Never;
    impl Watch for Never {
        fn tick(&mut self, _: &Now<'_>) -> ControlFlow<()> {
            panic!("it has begun")
        }
    }
    let long = read("staircase", &["duration_s=86400", "chain.uavs=30"]);
    let Err(error) = long.keep(1, Some(Keep::Ticks), None, &mut Never) else { panic!("not refused") };
    assert!(matches!(error, RecordError::TooMuch { name: "frames", .. }), "{error}");
}

#[test]
fn whoever_watches_stops_it() {
    struct Until(u64);
    impl Watch for Until {
        fn tick(&mut self, now: &Now<'_>) -> ControlFlow<()> {
            if now.tick < self.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        }
    }
    let scene = read("apartment", &["duration_s=20"]);
    let stopped = scene.keep(1, None, None, &mut Until(40)).map(|_: Box<dyn Kept>| ());
    assert!(matches!(stopped, Err(RecordError::Interrupted { time_s: 2.0 })), "{stopped:?}");
}

#[test]
fn who_no_longer_wants_a_plan_or_a_verdict_gets_none() {
    let straight = crate::course("straight", &[]);
    let mut rows = 0;
    let mut three_rows = || {
        rows += 1;
        rows <= 3
    };
    assert_eq!(plan_while(&straight, &PlanOptions::default(), &mut three_rows), Err(PlanError::Interrupted));
    assert_eq!(rows, 4);

    let mut file = Vec::new();
    read("corner", &["duration_s=5"]).keep(1, None, Some(Box::new(&mut file)), &mut ()).unwrap();
    let opened =
        |file: &Vec<u8>| Registry::default().open_bytes(Box::new(Cursor::new(file.clone())), "memory");
    let refused = opened(&file).unwrap().verify_while(&mut || false).unwrap_err();
    assert!(matches!(&refused, ReadError::Io(cause) if cause.kind() == ErrorKind::Interrupted), "{refused}");
    assert!(opened(&file).unwrap().verify_while(&mut || true).unwrap().agrees(), "the control");
}
