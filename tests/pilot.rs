use std::{
    collections::BTreeMap,
    sync::{Arc, mpsc},
};

use glam::Vec2;
use uchain_core::chain::{Follow, PilotInput};
use uchain_sim::{
    clock::TICK_NS,
    config::{Source, TEXT_MAX_BYTES, builtin},
    mission::{
        Mission as _,
        chain::{Chain, ChainTopics, Course, Frame, McapRecorder},
        explore::Site,
    },
    pilot::{Asked, INPUTS_MAX, Live, Nobody, Pilot, Scripted},
    record::{
        Channel, RecordError, Recorder, Schema, Sink,
        mcap::{McapWriter, MessageRecorder, PILOT_TOPIC, ReadError},
    },
    replay::{self, Recording, Verdict},
    run::{Piloted, RunError, run, run_with},
};

use crate::{course, reset::frames};

fn input(speed_mps: f32, follow: Follow) -> PilotInput {
    PilotInput { speed_mps, follow }
}

/// A pilot that begins these inputs at these ticks.
fn at_ticks(inputs: &[(u64, PilotInput)]) -> impl FnMut(u64, &Frame) -> Option<PilotInput> {
    |tick, _| inputs.iter().find(|(at, _)| *at == tick).map(|(_, input)| *input)
}

/// The scenario that has the inputs of a flight as its script, by way of its file.
fn as_scenario(course: &Course, inputs: &[Asked<PilotInput>]) -> Arc<Course> {
    let text = course.scenario.by_hand(inputs).to_toml().unwrap();
    assert!(text.len() as u64 <= TEXT_MAX_BYTES, "{} bytes", text.len());
    Course::read(&Source { text, ..builtin("corner").unwrap() }, &[])
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A flight by hand and its recording.
fn recorded(course: &Arc<Course>, pilot: &mut impl Pilot<Frame, PilotInput>) -> (Piloted<Course>, Vec<u8>) {
    let mut recorder = McapRecorder::start(Vec::new(), course, 1).unwrap();
    let flown = run_with(course, 1, pilot, &mut recorder).unwrap();
    (flown, recorder.finish().unwrap())
}

fn open(file: &[u8]) -> Recording<&[u8], Course> {
    Recording::read(file, "memory").unwrap()
}

fn verify(file: &[u8]) -> Verdict {
    replay::verify(&mut open(file)).unwrap()
}

#[test]
fn a_pilot_who_plays_the_script_flies_what_the_script_flies_and_one_who_changes_it_does_not() {
    let course = course("corner", &["duration_s=80"]);
    let of_script = run(&course, 1, &mut ()).unwrap();
    let steps = [(0, input(0.2, Follow::Centre)), (920, input(0.0, Follow::Centre))];
    assert_eq!(run_with(&course, 1, &mut at_ticks(&steps), &mut ()).unwrap().summary, of_script);
    assert_eq!(run_with(&course, 1, &mut Scripted, &mut ()).unwrap().summary, of_script);
    for changed in [(920, input(0.0, Follow::Left)), (921, steps[1].1), (920, input(-0.01, Follow::Centre))] {
        let flown = run_with(&course, 1, &mut at_ticks(&[steps[0], changed]), &mut ()).unwrap();
        assert_ne!(flown.summary.digest, of_script.digest, "the control: {changed:?}");
    }
}

#[test]
fn what_is_asked_for_again_is_nothing_new_and_the_script_is_flown_until_the_first_input() {
    let course = course("corner", &["duration_s=60"]);
    let [on, left] = [input(0.15, Follow::Centre), input(0.15, Follow::Left)];
    let mut pilot = |tick: u64, last: &Frame| {
        assert_eq!(tick, last.tick);
        assert_eq!(last.uavs.is_empty(), tick == 0);
        (tick >= 300).then_some(if tick < 500 { on } else { left })
    };
    let flown = run_with(&course, 1, &mut pilot, &mut ()).unwrap();
    assert_eq!(flown.inputs, [Asked { tick: 300, input: on }, Asked { tick: 500, input: left }]);
    let script = as_scenario(&course, &flown.inputs);
    let steps: Vec<(f64, f32)> =
        script.scenario.pilot.iter().map(|step| (step.start_s, step.speed_mps)).collect();
    assert_eq!(steps, [(0.0, 0.2), (15.0, 0.15), (25.0, 0.15)]);
    assert_eq!(run(&script, 1, &mut ()).unwrap(), flown.summary);
    assert_eq!(course.scenario.by_hand(&[]), course.scenario, "no input leaves the script");
}

/// Waits at every hundredth tick until somebody elsewhere has done what he does then.
struct Wait {
    at: mpsc::Sender<u64>,
    done: mpsc::Receiver<()>,
}

impl Recorder<Frame> for Wait {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if frame.tick.is_multiple_of(100) {
            self.at.send(frame.tick).unwrap();
            self.done.recv().unwrap();
        }
        Ok(())
    }
}

#[test]
fn a_flight_steered_from_another_thread_is_a_scenario_and_its_recording_is_what_was_flown() {
    let course = course("corner", &["duration_s=60"]);
    let (mut pilot, controls) = Live::new(PilotInput::default());
    let ((at, ticks), (ready, done)) = (mpsc::channel(), mpsc::channel());
    let hand = std::thread::spawn(move || {
        for tick in ticks {
            let follow = if tick < 700 { Follow::Centre } else { Follow::Right };
            // All but the last are overwritten.
            (0..=tick / 100).for_each(|of_twelve| controls.set(input(0.02 * of_twelve as f32, follow)));
            ready.send(()).unwrap();
        }
    });
    let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
    let flown = {
        let mut both = (&mut recorder, Wait { at, done });
        run_with(&course, 1, &mut pilot, &mut both)
    };
    hand.join().unwrap();
    let (flown, file) = (flown.unwrap(), recorder.finish().unwrap());
    let digest = flown.summary.digest.clone();
    assert!(flown.inputs.len() > 5, "{:?}", flown.inputs);
    assert_eq!(flown.inputs[0], Asked { tick: 0, input: PilotInput::default() });

    assert_eq!(run(&as_scenario(&course, &flown.inputs), 1, &mut ()).unwrap(), flown.summary);
    let one_less = as_scenario(&course, &flown.inputs[..flown.inputs.len() - 2]);
    assert_ne!(run(&one_less, 1, &mut ()).unwrap().digest, digest, "the control: inputs that are missing");

    assert_eq!(open(&file).inputs().unwrap(), flown.inputs);
    let verdict = verify(&file);
    assert!(verdict.agrees() && (verdict.ticks, verdict.of) == (1200, 1200), "{verdict:?}");
    let mut recording = open(&file);
    let scene = recording.scene().unwrap();
    assert_eq!(recording.summary(&scene, &mut ()).unwrap(), flown.summary);
}

#[test]
fn a_recording_changes_no_bit_of_a_flight_by_hand_and_a_script_leaves_no_trace_of_a_pilot() {
    let course = course("bend", &["duration_s=40"]);
    let inputs =
        [(0, input(0.2, Follow::Left)), (7, input(0.1, Follow::Right)), (600, input(-0.1, Follow::Centre))];
    let alone = run_with(&course, 1, &mut at_ticks(&inputs), &mut ()).unwrap();
    let (flown, by_hand) = recorded(&course, &mut at_ticks(&inputs));
    assert_eq!(flown.summary, alone.summary);

    let has = |file: &[u8], words: &str| file.windows(words.len()).any(|window| window == words.as_bytes());
    assert!(has(&by_hand, PILOT_TOPIC) && has(&by_hand, "uchain.PilotInput"));
    let (flown, scripted) = recorded(&course, &mut Scripted);
    assert!(flown.inputs.is_empty());
    assert!(!has(&scripted, PILOT_TOPIC) && !has(&scripted, "PilotInput"));
    let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
    run(&course, 1, &mut recorder).unwrap();
    assert!(recorder.finish().unwrap() == scripted, "without a pilot the file is another one");

    // A flight by hand and the scenario that came of it differ in nothing.
    let again = as_scenario(&course, &alone.inputs);
    let mut recorder = McapRecorder::start(Vec::new(), &again, 1).unwrap();
    run(&again, 1, &mut recorder).unwrap();
    let again = recorder.finish().unwrap();
    let found = replay::diff(&mut open(&by_hand).frames, &mut open(&again).frames).unwrap();
    assert_eq!((found.ticks, found.differing), (800, 0), "{found:?}");
    let found = replay::diff(&mut open(&by_hand).frames, &mut open(&scripted).frames).unwrap();
    assert!(found.differing > 100, "the control: {found:?}");
}

/// Records that the pilot asked for something else at a tick.
struct Tamper(McapRecorder<Vec<u8>>, u64, Option<PilotInput>);

impl Recorder<Frame> for Tamper {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let input = if frame.tick == self.1 { self.2 } else { frame.input };
        self.0.frame(&Frame { input, ..frame.clone() })
    }
}

#[test]
fn an_input_that_was_changed_in_a_recording_is_found() {
    let course = course("corner", &["duration_s=60"]);
    let inputs = [(0, input(0.2, Follow::Centre)), (700, input(0.1, Follow::Centre))];
    let tampered = |tick, asked| {
        let mut tamper = Tamper(McapRecorder::start(Vec::new(), &course, 1).unwrap(), tick, asked);
        run_with(&course, 1, &mut at_ticks(&inputs), &mut tamper).unwrap();
        tamper.0.finish().unwrap()
    };
    // The input at tick 700, counted from 0, is that of the 701st frame.
    assert!(verify(&tampered(701, Some(inputs[1].1))).agrees(), "the control");
    for (tick, asked) in [
        (701, None),
        (701, Some(input(0.1_f32.next_up(), Follow::Centre))),
        (701, Some(input(0.1, Follow::Left))),
        (651, Some(input(0.0, Follow::Centre))),
    ] {
        let first = verify(&tampered(tick, asked)).first.unwrap();
        assert!((tick..tick + 60).contains(&first.tick), "{first}");
    }
    // What no pilot may ask for.
    let file = tampered(701, Some(input(f32::NAN, Follow::Centre)));
    let error = replay::verify(&mut open(&file)).unwrap_err();
    let words = "damaged: the frame after tick 700: speed_mps = NaN: must lie in -1..=1";
    assert_eq!(error.to_string(), words);
}

/// Writes every input of the pilot so many times, so many ticks late.
struct Misplaced {
    file: McapWriter<Vec<u8>>,
    pilot: Option<Channel>,
    times: usize,
    late_ticks: u64,
}

impl Sink for Misplaced {
    fn metadata(&mut self, name: &str, entries: &BTreeMap<String, String>) -> Result<(), RecordError> {
        self.file.metadata(name, entries)
    }

    fn attachment(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), RecordError> {
        self.file.attachment(name, media_type, data)
    }

    fn channel(&mut self, topic: &str, schema: Option<Schema<'_>>) -> Result<Channel, RecordError> {
        let channel = self.file.channel(topic, schema)?;
        if topic == PILOT_TOPIC {
            self.pilot = Some(channel);
        }
        Ok(channel)
    }

    fn message(&mut self, channel: Channel, time_ns: u64, message: &[u8]) -> Result<(), RecordError> {
        if self.pilot != Some(channel) {
            return self.file.message(channel, time_ns, message);
        }
        let time_ns = time_ns + self.late_ticks * TICK_NS;
        (0..self.times).try_for_each(|_| self.file.message(channel, time_ns, message))
    }

    fn flush(&mut self) -> Result<(), RecordError> {
        self.file.flush()
    }
}

#[test]
fn inputs_in_a_recording_stand_where_they_belong_or_it_is_refused() {
    let course = course("corner", &["duration_s=1"]);
    let inputs = |times, late_ticks| {
        let sink = Misplaced { file: McapWriter::begin(Vec::new()).unwrap(), pilot: None, times, late_ticks };
        let mut recorder = MessageRecorder::<_, ChainTopics>::start_in(sink, &*course, 1).unwrap();
        let asked = [(0, input(0.2, Follow::Left))];
        run_with(&course, 1, &mut at_ticks(&asked), &mut recorder).unwrap();
        open(&recorder.into_sink().file.finish().unwrap()).inputs()
    };
    assert_eq!(inputs(0, 0).unwrap(), []);
    assert_eq!(inputs(1, 0).unwrap(), [Asked { tick: 0, input: input(0.2, Follow::Left) }]);
    for (error, words) in [
        (inputs(2, 0).unwrap_err(), "two inputs of the pilot: expected one"),
        (
            inputs(1, 1).unwrap_err(),
            "log_time = 50000000 of the pilot's input: expected 0 ticks of 50000000 ns",
        ),
    ] {
        assert_eq!(error.to_string(), format!("damaged: the frame after tick 0: {words}"));
        assert!(matches!(error, ReadError::Frame { tick: 0, .. }));
    }
}

#[test]
fn what_no_scenario_may_ask_for_ends_the_flight_in_words_and_with_its_time() {
    let course = course("corner", &["duration_s=60"]);
    for (speed_mps, words) in [
        (f32::NAN, "the pilot's input at 0.35 s of simulated time: speed_mps = NaN: must lie in -1..=1"),
        (1.5, "the pilot's input at 0.35 s of simulated time: speed_mps = 1.5: must lie in -1..=1"),
    ] {
        let inputs = [(7, input(speed_mps, Follow::Centre))];
        let error = run_with(&course, 1, &mut at_ticks(&inputs), &mut ()).unwrap_err();
        assert!(matches!(error, RunError::Input { .. }));
        assert_eq!(error.to_string(), words);
    }
    let inputs = [(7, input(-1.0, Follow::Centre))];
    assert_eq!(run_with(&course, 1, &mut at_ticks(&inputs), &mut ()).unwrap().inputs.len(), 1, "the control");
}

#[test]
fn a_hundred_thousand_inputs_are_a_scenario_and_one_more_is_refused() {
    let course = course("straight", &["duration_s=5001", "chain.uavs=1"]);
    let to_and_fro = |inputs: usize| {
        let speed_mps = |tick: u64| if tick.is_multiple_of(2) { 0.2 } else { -0.2 + 1e-7 * tick as f32 };
        let mut pilot =
            |tick: u64, _: &Frame| (tick < inputs as u64).then(|| input(speed_mps(tick), Follow::Centre));
        run_with(&course, 1, &mut pilot, &mut ())
    };
    let flown = to_and_fro(INPUTS_MAX).unwrap();
    assert_eq!(flown.inputs.len(), INPUTS_MAX);
    let again = as_scenario(&course, &flown.inputs);
    assert_eq!(run(&again, 1, &mut ()).unwrap(), flown.summary);
    // The longest script there may be is within what a recording may be of.
    let file = McapRecorder::start(Vec::new(), &again, 1).unwrap().finish().unwrap();
    assert_eq!(open(&file).scene().unwrap().scenario, again.scenario);

    let error = to_and_fro(INPUTS_MAX + 1).unwrap_err();
    assert!(matches!(error, RunError::TooManyInputs { .. }));
    assert_eq!(
        error.to_string(),
        "the pilot's input at 5000.00 s of simulated time is one more than 100000: expected at most these"
    );
}

/// How far the head was from where it waited, at most (m), and whether it flew.
struct Farthest {
    from: Vec2,
    m: f32,
    has_flown: bool,
}

impl Recorder<Frame> for Farthest {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let head = &frame.uavs[0];
        self.m = self.m.max(self.from.distance(Vec2::new(head.x_m, head.y_m)));
        self.has_flown |= head.airborne;
        Ok(())
    }
}

#[test]
fn without_a_pilot_the_head_hovers() {
    let course = course("straight", &["duration_s=60"]);
    let farthest = || Farthest { from: course.spawns[0].at, m: 0.0, has_flown: false };
    let (mut hovering, mut scripted) = (farthest(), farthest());
    let flown = run_with(&course, 1, &mut Nobody, &mut hovering).unwrap();
    assert!(hovering.has_flown && hovering.m < 0.1, "{} m", hovering.m);
    assert_eq!(flown.inputs, [Asked { tick: 0, input: PilotInput::default() }]);
    run_with(&course, 1, &mut Scripted, &mut scripted).unwrap();
    assert!(scripted.m > 2.0, "the control: {} m", scripted.m);
}

#[test]
fn a_mission_without_a_pilot_is_flown_by_its_script_alone() {
    let site = Site::read(&builtin("apartment").unwrap(), &["duration_s=20".to_owned()]).unwrap();
    let flown = run_with(&site, 1, &mut Scripted, &mut ()).unwrap();
    assert_eq!((flown.summary, flown.inputs.len()), (run(&site, 1, &mut ()).unwrap(), 0));
}

#[test]
fn steering_begins_with_the_next_tick_that_was_not_sensed_and_ends_with_a_reset() {
    let course = course("corner", &[]);
    let of_script = frames(&mut Chain::start(course.clone(), 1), 400);
    let (mut chain, mut commands) = (Chain::start(course, 1), Vec::new());
    let asked = input(-0.1, Follow::Right);
    let mut tick = |chain: &mut Chain, is_steered| {
        let before = chain.sense()[0].pilot;
        if is_steered {
            chain.steer(asked).unwrap();
        }
        assert_eq!(chain.sense()[0].pilot, before, "what was sensed stays as it was");
        chain.decide(&mut commands);
        chain.act(&commands);
        chain.frame().input
    };
    assert_eq!(
        [tick(&mut chain, true), tick(&mut chain, false), tick(&mut chain, false)],
        [None, Some(asked), None]
    );
    assert_eq!(chain.sense()[0].pilot, Some(asked));
    chain.steer(input(0.1, Follow::Left)).unwrap();
    assert!(frames(&mut chain, 400) != of_script, "the control");
    chain.reset(1);
    assert!(frames(&mut chain, 400) == of_script);
}
