use std::collections::BTreeMap;

use std::sync::Arc;

use uchain_core::chain::Doing;

use super::Recording;
use crate::mission::chain::McapRecorder;
use crate::{
    config::{PRESETS, Source, builtin, builtin_names},
    mission::{
        Scene as _,
        chain::{Course, Frame, Scenario},
    },
    record::{
        RecordError, Recorder,
        mcap::{About, End, PlayError, ReadError, about},
    },
    replay,
    run::run,
};

fn course(name: &str, sets: &[&str]) -> std::sync::Arc<Course> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Course::read(&builtin(name).unwrap(), &sets).unwrap()
}

fn about_of(course: &Arc<Course>, seed: u64) -> About {
    About::of(course.scenario.to_toml().unwrap(), &course.map, seed)
}

/// All frames of a run.
#[derive(Default)]
struct All<F = Frame>(Vec<F>);

impl<F: Clone> Recorder<F> for All<F> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.0.push(frame.clone());
        Ok(())
    }
}

fn recorded(course: &Arc<Course>, seed: u64) -> (Vec<u8>, Vec<Frame>) {
    let mut both = (McapRecorder::start(Vec::new(), course, seed).unwrap(), All(Vec::new()));
    run(course, seed, &mut both).unwrap();
    (both.0.finish().unwrap(), both.1.0)
}

#[test]
fn every_frame_comes_back_as_it_was() {
    let course = course("corner", &["duration_s=40"]);
    let (file, frames) = recorded(&course, 3);
    assert!(frames.iter().any(|frame| frame.links.len() > 1), "a chain, or little is tested");
    let doing = |of: fn(&Doing) -> bool| {
        let mut all = frames.iter().flat_map(|frame| &frame.uavs).filter_map(|uav| uav.doing.as_ref());
        all.any(of)
    };
    assert!(doing(|doing| doing.launch.is_some()) && doing(|doing| doing.overridden.is_some()));
    assert!(doing(|doing| doing.invalid_wall().is_some()), "{}", frames.len());
    let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let mut read = All::<Frame>(Vec::new());
    recording.frames.play(&mut read).unwrap();
    assert_eq!(read.0, frames);
    assert_eq!(recording.frames.end(), Some(End::Whole));
}

fn open(file: &[u8]) -> Recording<&[u8], Course> {
    Recording::read(file, "memory").unwrap()
}

/// Leaves out what earlier versions did not write.
struct Earlier(McapRecorder<Vec<u8>>);

impl Recorder<Frame> for Earlier {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        frame.head = None;
        frame.links.iter_mut().for_each(|link| link.silence = None);
        frame.uavs.iter_mut().for_each(|uav| uav.doing = None);
        self.0.frame(&frame)
    }
}

#[test]
fn recordings_of_versions_that_wrote_less_are_read_and_flown_again() {
    let course = course("corner", &["duration_s=40"]);
    let (file, frames) = recorded(&course, 3);
    let mut earlier = Earlier(McapRecorder::start(Vec::new(), &course, 3).unwrap());
    run(&course, 3, &mut earlier).unwrap();
    let earlier = earlier.0.finish().unwrap();
    assert!(earlier.len() < file.len(), "less is in it");
    let mut recording = Recording::<_, Course>::read(earlier.as_slice(), "memory").unwrap();
    let mut read = All::<Frame>(Vec::new());
    recording.frames.play(&mut read).unwrap();
    assert_eq!(read.0.len(), frames.len());
    assert!(read.0.iter().flat_map(|frame| &frame.uavs).all(|uav| uav.doing.is_none()));
    assert!(replay::verify(&mut open(&earlier)).unwrap().agrees());
    let compared = replay::diff(&mut open(&file).frames, &mut open(&earlier).frames).unwrap();
    assert!(compared.first.is_none(), "{compared:?}");
}

/// Has one UAV steer by another wall at one decision.
struct OtherWall(McapRecorder<Vec<u8>>);

impl Recorder<Frame> for OtherWall {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        if let (777, Some(doing)) = (frame.tick, &mut frame.uavs[0].doing) {
            doing.walls = None;
        }
        self.0.frame(&frame)
    }
}

#[test]
fn verify_finds_a_decision_with_another_wall() {
    let course = course("corner", &["duration_s=40"]);
    let mut other = OtherWall(McapRecorder::start(Vec::new(), &course, 1).unwrap());
    run(&course, 1, &mut other).unwrap();
    let file = other.0.finish().unwrap();
    let verdict =
        replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
    let first = verdict.first.unwrap().to_string();
    assert!(first.starts_with("tick 777 (38.85 s), UAV 0, doing.walls: none and "), "{first}");
}

#[test]
fn the_scenario_in_a_recording_is_the_whole_scenario() {
    let presets = PRESETS.map(|preset| format!("preset={}", preset.name));
    // Chains, but for the one with a map that is not compiled in.
    for name in
        builtin_names().iter().filter(|name| !["stata", "apartment", "corridors", "lab"].contains(name))
    {
        for sets in [&[][..], &presets[..1], &presets[1..]] {
            let asked = Course::read(&builtin(name).unwrap(), sets).unwrap();
            let about = about_of(&asked, 1);
            let map = about::walls_from_csv(about::walls_to_csv(&asked.map).as_bytes()).unwrap();
            assert_eq!(map.walls(), asked.map.walls());
            let source = Source { text: about.scenario, ..builtin(name).unwrap() };
            let map = map.with_offset_m(about.map_offset_m);
            let again = Course::read_in(&source, map, Course::BUILTIN).unwrap();
            let without = Scenario { preset: None, ..asked.scenario.clone() };
            assert_eq!(again.scenario, without, "{name} {sets:?}");
            assert_eq!(again.spawns, asked.spawns);
            assert_eq!(again.map.offset_m(), asked.map.offset_m());
        }
    }
}

#[test]
fn one_letter_of_the_metadata_that_changed_is_noticed() {
    let about = about_of(&course("bend", &[]), u64::MAX);
    let entries = about.entries();
    assert_eq!(About::from_entries(entries.clone()).unwrap(), about);
    let changed = |key: &str, value: &str| {
        let mut entries = entries.clone();
        entries.insert(key.to_owned(), value.to_owned());
        About::from_entries(entries).unwrap_err()
    };
    assert!(changed("seed", "7").starts_with("checksum = "));
    assert!(changed("scenario", &about.scenario.replacen('5', "6", 1)).starts_with("checksum = "));
    assert_eq!(changed("format", "2"), "format = \"2\": expected \"1\"");
    assert!(About::from_entries(BTreeMap::new()).unwrap_err().contains("format"));
}

#[test]
fn walls_that_are_no_walls_are_refused_by_line() {
    let refused = |text: &str| about::walls_from_csv(text.as_bytes()).unwrap_err();
    assert!(refused("").contains("columns"));
    assert!(refused("loop,x_m,y_m\n").contains("wall loops"));
    for line in ["0,1", "0,1,2,3", "1,0,0", "0,NaN,0", "0,1e9,0", "18446744073709551615,0,0", "0,a,0"] {
        assert!(refused(&format!("loop,x_m,y_m\n{line}\n")).starts_with("line 2: "), "{line}");
    }
}

#[test]
fn scenarios_are_told_apart_key_by_key() {
    let about = |sets: &[&str], seed| about_of(&course("bend", sets), seed);
    let (here, there) = (about(&[], 1), about(&["chain.uavs=3", "pilot.0.follow=left"], 2));
    assert_eq!(here.differences(&here), []);
    let some = |text: &str| Some(text.to_owned());
    let expected = [
        ("seed".to_owned(), some("1"), some("2")),
        ("chain.uavs".to_owned(), some("4"), some("3")),
        ("pilot.0.follow".to_owned(), some("\"centre\""), some("\"left\"")),
    ];
    assert_eq!(here.differences(&there), expected);
}

/// Moves one UAV by one ulp at one tick.
struct Tamper(McapRecorder<Vec<u8>>);

impl Recorder<Frame> for Tamper {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        if frame.tick == 777 {
            frame.uavs[1].x_m = frame.uavs[1].x_m.next_up();
        }
        self.0.frame(&frame)
    }
}

#[test]
fn verify_finds_a_planted_ulp_at_its_tick_and_nothing_where_nothing_was_planted() {
    let course = course("corner", &["duration_s=60"]);
    let (file, frames) = recorded(&course, 1);
    let verdict =
        replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
    assert!(verdict.agrees() && verdict.ticks == 1200 && verdict.end == Some(End::Whole), "{verdict:?}");

    let mut tamper = Tamper(McapRecorder::start(Vec::new(), &course, 1).unwrap());
    run(&course, 1, &mut tamper).unwrap();
    let file = tamper.0.finish().unwrap();
    let verdict =
        replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
    assert!(!verdict.agrees());
    let true_m = frames[776].uavs[1].x_m;
    let words = format!("tick 777 (38.85 s), UAV 1, x_m: {} and {true_m}", true_m.next_up());
    assert_eq!(verdict.first.unwrap().to_string(), words);
}

#[test]
fn a_recording_that_is_longer_than_its_scenario_is_refused_and_a_shorter_one_was_stopped() {
    let long = course("corner", &["duration_s=3"]);
    let short = course("corner", &["duration_s=2"]);
    // What was flown is not what the file says.
    let mut liar = McapRecorder::start(Vec::new(), &short, 1).unwrap();
    run(&long, 1, &mut liar).unwrap();
    let file = liar.finish().unwrap();
    let error =
        replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap_err();
    assert!(matches!(error, ReadError::Frame { tick: 40, .. }), "{error}");

    let mut liar = McapRecorder::start(Vec::new(), &long, 1).unwrap();
    run(&short, 1, &mut liar).unwrap();
    let file = liar.finish().unwrap();
    let verdict =
        replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
    assert!(
        verdict.agrees() && (verdict.ticks, verdict.of) == (40, 60),
        "as if it had been stopped: {verdict:?}"
    );
}

#[test]
fn frames_of_another_number_of_uavs_are_refused() {
    let (four, three) =
        (course("corner", &["duration_s=1"]), course("corner", &["duration_s=1", "chain.uavs=3"]));
    let mut liar = McapRecorder::start(Vec::new(), &three, 1).unwrap();
    run(&four, 1, &mut liar).unwrap();
    let file = liar.finish().unwrap();
    let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let course = recording.scene().unwrap();
    let error = recording.summary(&course, &mut ()).unwrap_err();
    assert!(matches!(error, PlayError::Read(ReadError::Frame { tick: 0, .. })), "{error}");
}

/// Takes so many bytes, then says the disk is full.
struct Disk(Vec<u8>, usize);

impl std::io::Write for &mut Disk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let room = self.1.saturating_sub(self.0.len()).min(bytes.len());
        self.0.extend_from_slice(&bytes[..room]);
        if room == 0 { Err(std::io::ErrorKind::StorageFull.into()) } else { Ok(room) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_ends_the_run_in_words_and_leaves_a_readable_file() {
    let course = course("corner", &["duration_s=60"]);
    let (_, frames) = recorded(&course, 1);
    for bytes in [0, 100, 50_000, 300_000, 600_000] {
        let mut disk = Disk(Vec::new(), bytes);
        let ended = match McapRecorder::start(&mut disk, &course, 1) {
            Ok(mut recorder) => run(&course, 1, &mut recorder).unwrap_err().to_string(),
            Err(error) => error.to_string(),
        };
        assert!(ended.starts_with("cannot write the recording: "), "{ended}");
        let mut read = All::<Frame>(Vec::new());
        match Recording::<_, Course>::read(disk.0.as_slice(), "memory") {
            Ok(mut recording) => {
                recording.frames.play(&mut read).unwrap();
                assert_eq!(recording.frames.end(), Some(End::CutShort));
                match replay::verify(&mut Recording::<_, Course>::read(disk.0.as_slice(), "memory").unwrap())
                {
                    Ok(verdict) => assert!(verdict.agrees() && verdict.ticks > 0, "{verdict:?}"),
                    Err(error) => assert!(matches!(error, ReadError::NoFrames), "{error}"),
                }
            }
            Err(error) => assert!(bytes < 30_000 && matches!(error, ReadError::Empty { .. }), "{error}"),
        }
        assert_eq!(read.0, frames[..read.0.len()]);
        assert!(bytes < 300_000 || read.0.len() > 20, "{bytes} bytes, {} frames", read.0.len());
    }
}
