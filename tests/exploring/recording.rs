//! What is recorded of an exploration can be read again, bit for bit.

use std::sync::Arc;

use uchain_sim::{
    mission::{
        chain::{Course, McapRecorder},
        explore::{ExploreFrame, ExploreHistory, ExploreRecorder, Site},
    },
    record::{
        RecordError, Recorder,
        mcap::{End, ReadError},
    },
    replay::{self, Recording},
    run::{self, run},
};

use super::site;

/// All frames of an exploration.
#[derive(Default)]
struct All(Vec<ExploreFrame>);

impl Recorder<ExploreFrame> for All {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        self.0.push(frame.clone());
        Ok(())
    }
}

fn recorded(site: &Arc<Site>, seed: u64) -> (Vec<u8>, Vec<ExploreFrame>) {
    let mut both = (ExploreRecorder::start(Vec::new(), site, seed).unwrap(), All::default());
    run(site, seed, &mut both).unwrap();
    (both.0.finish().unwrap(), both.1.0)
}

/// How a file ends, or why it is refused, and after how many frames; all of them are those that were written.
fn read(file: &[u8], written: &[ExploreFrame]) -> (Result<End, ReadError>, usize) {
    let mut recording = match Recording::<_, Site>::read(file, "memory") {
        Ok(recording) => recording,
        Err(error) => return (Err(error), 0),
    };
    let (mut frame, mut frames) = (ExploreFrame::default(), 0);
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
fn a_recorded_exploration_has_the_summary_and_the_picture_of_the_one_that_was_flown() {
    for (name, sets) in [
        ("apartment", &["explore.strategy=srg", "explore.position_sigma_m=0.02"][..]),
        ("corridors", &["explore.robots=2", "explore.range_m=3", "explore.scan_s=1"]),
        ("lab", &["explore.quadrotor.snap=false"]),
    ] {
        let site = site(name, sets);
        let mut both = (ExploreRecorder::start(Vec::new(), &site, 2).unwrap(), ExploreHistory::default());
        let flown = run::fly(&site, 2, &mut both).unwrap();
        assert_eq!(flown.0, run(&site, 2, &mut ()).unwrap(), "recording changes nothing");
        let file = both.0.finish().unwrap();

        let mut recording = Recording::<_, Site>::read(file.as_slice(), "memory").unwrap();
        let again = recording.scene().unwrap();
        assert_eq!(again.scenario, site.scenario);
        let mut history = ExploreHistory::default();
        let (summary, metrics) = recording.play(&again, &mut history).unwrap();
        assert_eq!(summary, flown.0);
        let survey = metrics.survey();
        let picture = uchain_sim::mission::explore::explore_png(&again, &history, &survey, &summary).unwrap();
        assert!(
            picture
                == uchain_sim::mission::explore::explore_png(&site, &both.1, &flown.1.survey(), &flown.0)
                    .unwrap(),
            "another picture"
        );
    }
}

#[test]
fn a_file_cut_anywhere_holds_the_begin_of_the_exploration_and_no_flipped_bit_another_one() {
    let (file, written) = recorded(&site("apartment", &["duration_s=40"]), 1);
    assert!(matches!(read(&file, &written), (Ok(End::Whole), frames) if frames == written.len()));
    let mut most = 0;
    for length in (0..file.len()).step_by(997) {
        let (end, frames) = read(&file[..length], &written);
        assert!(!matches!(end, Ok(End::Whole)), "{length} bytes");
        assert!(frames >= most, "{length} bytes hold {frames} frames, fewer bytes {most}");
        most = frames;
    }
    assert!(most > 100, "{most}");
    for i in 0..2_000_usize {
        let mut flipped = file.clone();
        flipped[i.wrapping_mul(7_919) % file.len()] ^= 1 << (i % 8);
        assert!(!matches!(read(&flipped, &written).0, Ok(End::Whole)), "flip {i} went unnoticed");
    }
}

/// Moves one robot by one ulp at one tick.
struct Tamper(ExploreRecorder<Vec<u8>>);

impl Recorder<ExploreFrame> for Tamper {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        let mut frame = frame.clone();
        if frame.tick == 777 {
            frame.robots[1].x_m = frame.robots[1].x_m.next_up();
        }
        self.0.frame(&frame)
    }
}

#[test]
fn verify_finds_a_planted_ulp_of_an_exploration_and_diff_where_two_part() {
    let site = site("apartment", &["duration_s=60"]);
    let (file, _) = recorded(&site, 1);
    let verify =
        |file: &[u8]| replay::verify(&mut Recording::<_, Site>::read(file, "memory").unwrap()).unwrap();
    let verdict = verify(&file);
    assert!(verdict.agrees() && (verdict.ticks, verdict.of) == (1200, 1200), "{verdict:?}");

    let mut tamper = Tamper(ExploreRecorder::start(Vec::new(), &site, 1).unwrap());
    run(&site, 1, &mut tamper).unwrap();
    let other = tamper.0.finish().unwrap();
    let found = verify(&other).first.unwrap();
    assert!(found.to_string().starts_with("tick 777 (38.85 s), robot 1, x_m: "), "{found}");

    let open = |file| Recording::<_, Site>::read(file, "memory").unwrap();
    let (mut here, mut there) = (open(file.as_slice()), open(other.as_slice()));
    let comparison = replay::diff(&mut here.frames, &mut there.frames).unwrap();
    assert_eq!((comparison.ticks, comparison.differing), (1200, 1));

    let (other, _) = recorded(&site, 2);
    let (mut here, mut there) = (open(file.as_slice()), open(other.as_slice()));
    let comparison = replay::diff(&mut here.frames, &mut there.frames).unwrap();
    assert_eq!(comparison.first.unwrap().tick, 1, "another seed moves the starts");
}

#[test]
fn an_exploration_is_not_read_as_a_chain_nor_a_chain_as_an_exploration() {
    let (file, _) = recorded(&site("apartment", &["duration_s=1"]), 1);
    let said =
        Recording::<_, Course>::read(file.as_slice(), "memory").unwrap().scene().unwrap_err().to_string();
    assert!(said.contains("this is an exploration; expected a chain"), "{said}");
    let course = crate::course("corner", &["duration_s=1"]);
    let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
    run(&course, 1, &mut recorder).unwrap();
    let file = recorder.finish().unwrap();
    let said =
        Recording::<_, Site>::read(file.as_slice(), "memory").unwrap().scene().unwrap_err().to_string();
    assert!(said.contains("belongs to a chain"), "{said}");
}
