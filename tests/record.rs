use std::sync::Arc;

use std::{fs, path::Path};

use uchain_core::chain::Tof;
use uchain_sim::{
    mission::chain::{Course, Frame, History, LinkFrame, McapRecorder},
    record::{
        RecordError, Recorder,
        mcap::{End, ReadError},
    },
    replay::{self, Recording},
    run::run,
};

use crate::{course, shared_data};

/// All frames of a run.
#[derive(Default)]
struct All(Vec<Frame>);

impl Recorder<Frame> for All {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.0.push(frame.clone());
        Ok(())
    }
}

fn recorded(course: &Arc<Course>) -> (Vec<u8>, Vec<Frame>) {
    let mut both = (McapRecorder::start(Vec::new(), course, 1).unwrap(), All::default());
    run(course, 1, &mut both).unwrap();
    (both.0.finish().unwrap(), both.1.0)
}

/// What comes out of a file: how it ended, or why it was refused, and after how many frames. Every one of them is the
/// frame that was written, or the test ends here.
fn read(file: &[u8], written: &[Frame], truth: &Recording<&[u8], Course>) -> (Result<End, ReadError>, usize) {
    let mut recording = match Recording::<_, Course>::read(file, "memory") {
        Ok(recording) => recording,
        Err(error) => return (Err(error), 0),
    };
    assert_eq!(recording.about, truth.about);
    assert_eq!(recording.walls.walls(), truth.walls.walls());
    let (mut frame, mut frames) = (Frame::default(), 0);
    loop {
        match recording.frames.read(&mut frame) {
            Ok(true) => assert_eq!(Some(&frame), written.get(frames), "frame {frames}"),
            Ok(false) => return (Ok(recording.frames.end().unwrap()), frames),
            Err(error) => return (Err(error), frames),
        }
        frames += 1;
    }
}

#[test]
fn recording_changes_no_bit_of_a_run() {
    let course = course("corner", &["duration_s=60"]);
    let alone = run(&course, 1, &mut ()).unwrap();
    let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
    assert_eq!(run(&course, 1, &mut recorder).unwrap(), alone);
    let file = recorder.finish().unwrap();
    let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    assert_eq!(recording.summary(&course, &mut ()).unwrap(), alone, "and reading it back sums up the same");
}

#[test]
fn a_file_that_ends_at_any_byte_is_read_up_to_its_last_whole_chunk() {
    let course = course("straight", &["duration_s=2", "chain.uavs=1"]);
    let (file, written) = recorded(&course);
    let truth = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let mut most = 0;
    for length in 0..file.len() {
        let (ended, frames) = read(&file[..length], &written, &truth);
        match ended {
            Ok(end) => assert_eq!(end, End::CutShort, "{length} bytes"),
            Err(ReadError::Empty { bytes }) => assert_eq!((bytes, frames), (length as u64, 0)),
            Err(error) => panic!("{length} bytes: {error}"),
        }
        assert!(frames >= most, "{length} bytes: {frames} frames, {most} of fewer bytes");
        most = frames;
    }
    assert_eq!(most, written.len());
    assert_eq!(read(&file, &written, &truth).0.unwrap(), End::Whole);
}

#[test]
fn a_file_that_ends_in_zeros_from_any_byte_on_is_read_up_to_its_last_whole_chunk() {
    let course = course("straight", &["duration_s=2", "chain.uavs=1"]);
    let (file, written) = recorded(&course);
    let truth = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let cut_at = |length: usize| read(&file[..length], &written, &truth).1;
    for length in 0..=file.len() {
        let mut zeroed = file.clone();
        zeroed[length..].fill(0);
        // As long as it was, one zero longer than what is left, and a block longer.
        for zeros in [file.len() - length, 1, 4096] {
            zeroed.resize(length + zeros, 0);
            let (ended, frames) = read(&zeroed, &written, &truth);
            let what = format!("{length} bytes and {zeros} zeros");
            match ended {
                // The last bytes of the file may be zeros anyway.
                Ok(End::Whole) => assert!(zeroed.starts_with(&file), "{what}"),
                Ok(End::CutShort) => assert!(frames >= cut_at(length), "{what}: {frames} frames"),
                Err(ReadError::Empty { .. }) => assert_eq!(cut_at(length), 0, "{what}"),
                Err(ReadError::NotMcap) if (1..8).contains(&length) => {}
                Err(error) => panic!("{what}: {error}"),
            }
        }
    }
}

/// Pseudo-random numbers below a bound, the same in every run of the test.
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % bound as u64) as usize
    }
}

#[test]
fn no_flipped_bit_makes_another_frame() {
    let course = course("corner", &["duration_s=12"]);
    let (file, written) = recorded(&course);
    let truth = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
    let mut dice = Dice(1);
    let (mut refused, mut cut_short) = (0, 0);
    for i in 0..10_000 {
        // Every fourth file is that of a run that was killed: it has no checksum over all of it.
        let length = if i % 4 == 0 { file.len() / 2 + dice.below(file.len() / 2) } else { file.len() };
        let mut flipped = file[..length].to_vec();
        flipped[dice.below(length)] ^= 1 << dice.below(8);
        match read(&flipped, &written, &truth).0 {
            Ok(End::Whole) => panic!("flip {i} went unnoticed"),
            Ok(End::CutShort) => cut_short += 1,
            Err(words) => {
                refused += 1;
                // Nobody knows the MCAP library's name for a checksum.
                assert!(!words.to_string().contains("CRC"), "flip {i}: {words}");
            }
        }
    }
    println!("{} bytes: {refused} flips refused, {cut_short} files taken as cut short", file.len());
    assert!(refused > 7000, "{refused}");
}

/// Changes what one beam of the head read at one tick.
struct Beam(McapRecorder<Vec<u8>>, Change);

/// What happens to a reading.
type Change = fn(&mut Tof);

impl Recorder<Frame> for Beam {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        if frame.tick >= 50 && frame.tick < 60 {
            frame.uavs[0].tof.iter_mut().for_each(self.1);
        }
        self.0.frame(&frame)
    }
}

fn open(file: &[u8]) -> Recording<&[u8], Course> {
    Recording::<_, Course>::read(file, "memory").unwrap()
}

#[test]
fn one_ulp_of_any_of_the_four_beams_is_found_and_half_a_reading_is_refused() {
    let course = course("corner", &["duration_s=5"]);
    let ulps: [(&str, Change); 4] = [
        ("tof.nw_m", |tof| tof.nw_m = tof.nw_m.next_up()),
        ("tof.ne_m", |tof| tof.ne_m = tof.ne_m.next_up()),
        ("tof.sw_m", |tof| tof.sw_m = tof.sw_m.next_up()),
        ("tof.se_m", |tof| tof.se_m = tof.se_m.next_up()),
    ];
    let beams = |change| {
        let mut beam = Beam(McapRecorder::start(Vec::new(), &course, 1).unwrap(), change);
        run(&course, 1, &mut beam).unwrap();
        beam.0.finish().unwrap()
    };
    let untouched = beams(|_| {});
    assert!(replay::verify(&mut open(&untouched)).unwrap().agrees());
    for (name, change) in ulps {
        let file = beams(change);
        let first = replay::verify(&mut open(&file)).unwrap().first.unwrap();
        assert_eq!((first.field, first.tick / 10), (name, 5));
        let compared = replay::diff(&mut open(&untouched).frames, &mut open(&file).frames).unwrap();
        assert_eq!(compared.first.unwrap().field, name);
        assert_eq!(compared.largest.keys().collect::<Vec<_>>(), [&name]);
    }
    let halves: [Change; 4] = [
        |tof| tof.nw_m = f32::NAN,
        |tof| tof.ne_m = f32::NAN,
        |tof| tof.sw_m = f32::NAN,
        |tof| (tof.nw_m, tof.ne_m, tof.sw_m) = (f32::NAN, f32::NAN, f32::NAN),
    ];
    for change in halves {
        let file = beams(change);
        let error = replay::verify(&mut open(&file)).unwrap_err().to_string();
        assert!(error.contains("of UAV 0: expected four numbers, or none"), "{error}");
    }
}

#[test]
fn recordings_of_others_are_refused_in_words() {
    let Some(data) = shared_data() else { return };
    let expected = [
        (
            "mcap/chunk_not_closed.mcap",
            "the record at byte 39 has 18446744073709551615 bytes: expected at most",
        ),
        ("mcap/compressed.mcap", "the chunk at byte 61 is compressed (zstd)"),
        ("mcap/damaged/truncated_at_300000.mcap", "the chunk at byte 61 is compressed (zstd)"),
        ("mcap/damaged/one_byte_flipped_at_200000.mcap", "the chunk at byte 61 is compressed (zstd)"),
        ("mcap/../maps/ros/willow/willow-full-0.05.pgm", "not an MCAP file"),
        ("mcap/absent.mcap", "cannot read: No such file"),
    ];
    for (name, words) in expected {
        let error = Recording::<_, Course>::open(&data.join(name)).map(drop).unwrap_err().to_string();
        assert!(error.contains(words), "{name}: {error}");
    }
}

#[test]
fn a_run_on_a_map_file_is_flown_again_without_the_file() {
    let Some(data) = shared_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    let from = data.join("maps/ros/f1tenth");
    for name in ["stata_basement.yaml", "stata_basement.png"] {
        fs::copy(from.join(name), folder.path().join(name)).unwrap();
    }
    let file = format!("map.ros.file={:?}", folder.path().join("stata_basement.yaml"));
    let (recording, _) = recorded(&course("stata", &[&file, "duration_s=10"]));
    let place = folder.path().to_owned();
    drop(folder);
    assert!(!Path::new(&place).exists());
    let verdict =
        replay::verify(&mut Recording::<_, Course>::read(recording.as_slice(), "memory").unwrap()).unwrap();
    assert!(verdict.agrees() && verdict.ticks == 200, "{verdict:?}");
}

/// Replaces what a run came to by numbers from the edge of what a file may hold.
struct Wild(McapRecorder<Vec<u8>>, Dice);

impl Recorder<Frame> for Wild {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        let numbers = [0.0, -0.0, f32::MIN_POSITIVE, 1e-30, 0.05, 1.0, 60.0, 99.9, 1e4, 1e6, -1e6];
        let mut any = || numbers[self.1.below(numbers.len())];
        for uav in &mut frame.uavs {
            (uav.x_m, uav.y_m, uav.heading_rad) = (any(), any(), any());
            (uav.forward_mps, uav.lateral_mps, uav.yaw_rate_radps) = (any(), any(), any());
            uav.airborne = any() > 0.0;
            (uav.wall_contacts, uav.uav_contacts) = (4_000_000, 4_000_000);
        }
        frame.links = (0..frame.uavs.len())
            .map(|_| LinkFrame {
                uav: self.1.below(4),
                true_db: 1e6,
                filtered_db: Some(-1e6),
                raw_db: Some(1e6),
                silence: None,
            })
            .collect();
        frame.head_reach_m = 1e9;
        frame.decision = true;
        self.0.frame(&frame)
    }
}

#[test]
fn a_whole_file_of_impossible_numbers_is_summed_up_drawn_and_refuted() {
    let course = course("corner", &["duration_s=12"]);
    for seed in 0..20 {
        let mut wild = Wild(McapRecorder::start(Vec::new(), &course, 1).unwrap(), Dice(seed));
        run(&course, 1, &mut wild).unwrap();
        let file = wild.0.finish().unwrap();
        let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
        let mut history = History::default();
        let summary = recording.summary(&course, &mut history).unwrap();
        uchain_sim::mission::chain::run_png(&course, &history, &summary).unwrap();
        assert_eq!(history.frames.len(), 240);
        let verdict =
            replay::verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
        assert_eq!(verdict.first.unwrap().tick, 1);
    }
}
