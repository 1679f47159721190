//! What a page may ask of a flight.

use serde_json::{Value, json};
use uchain_sim::{
    clock::{TICK_S, total_ticks},
    map::Map,
    mission::{Metrics as _, Mission, Shown, Stopped, Summary as _},
    pilot::{Asked, INPUTS_MAX},
    record::{Event, Recorder, Snapshot, mcap::End as FileEnd},
    run::FrameOf,
};

use super::{Advanced, End, Flight, Flown, Origin, Series, Taped, Watched, again::steer, tape::Tape};
use crate::{
    problem::Problem,
    seed,
    seen::{Viewed, map_json},
    told::{FlightFile, Input, Since, TimedInput},
};

/// Most events that a page is told of at once.
const EVENTS_MAX: usize = 10_000;

impl<S: Viewed> Watched<S> {
    fn frame(&mut self, scene: &S, frame: &FrameOf<S>) -> Result<(), Problem> {
        let Self { metrics, digest, log, extra, .. } = self;
        let mut all = ((metrics, digest), (log.as_deref_mut().map(AsRecorder), extra));
        all.frame(frame).map_err(Problem::new)?;
        if S::is_row(frame) {
            let metrics = &self.metrics;
            self.rows.push(|to| scene.row(frame, metrics, to));
        }
        S::read_on(&mut self.read, frame);
        if self.film.wants(frame.tick()) {
            let kept = S::kept(frame, &self.read);
            let bytes = S::bytes(&kept);
            self.film.push(kept, bytes);
        }
        Ok(())
    }
}

/// A logbook as a recorder.
struct AsRecorder<'a, L: ?Sized>(&'a mut L);

impl<F, L: Recorder<F> + ?Sized> Recorder<F> for AsRecorder<'_, L> {
    fn frame(&mut self, frame: &F) -> Result<(), uchain_sim::record::RecordError> {
        self.0.frame(frame)
    }
}

fn over(stopped: Stopped) -> End {
    let why = serde_json::to_value(stopped).ok().and_then(|word| word.as_str().map(str::to_owned));
    End { why: why.unwrap_or_default(), words: stopped.words().to_owned() }
}

fn told(event: &Event) -> Value {
    json!({
        "tick": event.tick,
        "time_s": event.time_s(),
        "gravity": event.gravity.word(),
        "kind": event.kind,
        "uav": event.robot,
        "text": event.text,
    })
}

impl<S: Viewed> Flown<S> {
    /// One tick, flown or read.
    fn tick(&mut self, next: &mut usize) -> Result<(), Problem> {
        match &mut self.origin {
            Origin::Live(mission) => {
                steer(mission, &self.inputs, next);
                let stopped = mission.step(&mut ()).map_err(Problem::new)?;
                self.tick = mission.frame().tick();
                self.watched.frame(&self.scene, mission.frame())?;
                self.end = stopped.map(over);
            }
            Origin::File(recording) => {
                let mut frame = FrameOf::<S>::default();
                match recording.frames.read(&mut frame) {
                    Ok(true) => {
                        self.tick = frame.tick();
                        if let Some(input) = S::Mission::input_of(&frame)
                            && self.inputs.len() < INPUTS_MAX
                        {
                            self.inputs.push(Asked { tick: frame.tick() - 1, input });
                        }
                        self.watched.frame(&self.scene, &frame)?;
                    }
                    Ok(false) => {
                        let (why, words) = match recording.frames.end() {
                            Some(FileEnd::Whole) => ("recorded", "the recording ends here"),
                            _ => ("cut-short", "the recording was cut short here"),
                        };
                        self.end = Some(End { why: why.to_owned(), words: words.to_owned() });
                    }
                    Err(error) => {
                        self.end = Some(End { why: "damaged".to_owned(), words: error.to_string() });
                    }
                }
            }
        }
        Ok(())
    }

    /// Which input is the next one at this tick.
    fn next_input(&self) -> usize {
        self.inputs.partition_point(|asked| asked.tick < self.tick)
    }
}

impl<S: Viewed> Flight for Flown<S> {
    fn scene(&self) -> Result<Value, Problem> {
        let scene = &*self.scene;
        let runs_to_the_end = S::Mission::RUNS_TO_THE_END;
        let (kind, more) = scene.of_its_kind();
        let map: &Map = scene.map();
        let mut value = json!({
            "mission": kind,
            "name": scene.name(),
            "title": scene.title(),
            "notes": scene.notes(),
            "crew": scene.crew(),
            "robot": S::ROBOT,
            "tick_s": TICK_S,
            "duration_s": scene.duration_s(),
            "ticks": total_ticks(scene.duration_s()),
            "runs_to_the_end": runs_to_the_end,
            "seed": seed::to_json(self.file.seed),
            "label": self.file.label,
            "text": self.file.text,
            "recorded": matches!(self.origin, Origin::File(_)),
            "flies_again": self.flies_again,
            "map": map_json(map),
            "radius_m": scene.radius_m(),
        });
        value[kind] = more;
        Ok(value)
    }

    fn advance(&mut self, ticks: u64) -> Result<Advanced, Problem> {
        let mut next = self.next_input();
        for _ in 0..ticks {
            if self.end.is_some() {
                break;
            }
            self.tick(&mut next)?;
        }
        let watched = &mut self.watched;
        let all = watched.log.as_ref().map_or(&[][..], |log| &log.log().events);
        let events = all.iter().skip(watched.told).take(EVENTS_MAX).map(told).collect();
        watched.told = all.len();
        Ok(Advanced {
            tick: self.tick,
            stopped: self.end.clone(),
            kept_every: watched.film.every(),
            events,
            rows: watched.rows.count(),
            generation: watched.rows.generation(),
        })
    }

    fn steer(&mut self, input: Input) -> Result<(), Problem> {
        let Origin::Live(mission) = &mut self.origin else {
            return Err(Problem::new("a recording is steered no more: cut it here to fly on by hand"));
        };
        let input = S::input(input)?;
        if self.end.is_some() {
            return Err(Problem::new("the flight is over"));
        }
        // What was to come is no more.
        let now = self.tick;
        self.inputs.retain(|asked| asked.tick < now);
        if self.inputs.last().is_some_and(|last| last.input == input) {
            return Ok(());
        }
        if self.inputs.len() == INPUTS_MAX {
            return Err(Problem::new(format!(
                "one input of the pilot more than {INPUTS_MAX}: expected at most these"
            )));
        }
        mission.steer(input.clone()).map_err(|why| Problem::new(format!("the pilot's input: {why}")))?;
        self.inputs.push(Asked { tick: now, input });
        Ok(())
    }

    fn cut(&mut self, tick: u64) -> Result<(), Problem> {
        if !self.flies_again {
            return Err(Problem::new(
                "this page does not have the law that was flown by: it can only be looked at",
            ));
        }
        let inputs = self.inputs.iter().filter(|asked| asked.tick < tick).cloned().collect();
        let mission = S::Mission::start(self.scene.clone(), self.file.seed);
        *self = Self::new(self.scene.clone(), self.file.clone(), Origin::Live(mission), true, inputs)?;
        Ok(())
    }

    fn frame(&mut self, tick: u64) -> Result<String, Problem> {
        let tick = tick.min(self.tick);
        let kept = self.watched.film.at(tick).ok_or_else(|| Problem::new("nothing has been flown yet"))?;
        let between = kept.tick() != tick;
        if between
            && self.flies_again
            && self.again.seek(&self.scene, self.file.seed, &self.inputs, tick)
            && let Some(frame) = self.again.kept()
        {
            return self.scene.frame_json(&frame, &self.watched.extra, true);
        }
        self.scene.frame_json(kept, &self.watched.extra, !between || !self.flies_again)
    }

    fn why(&mut self, tick: u64, uav: usize) -> Result<Value, Problem> {
        let tick = tick.min(self.tick);
        if let Origin::Live(mission) = &self.origin
            && mission.frame().tick() == tick
        {
            return self.scene.why(mission, &self.watched.read, uav);
        }
        if !self.flies_again {
            return Err(Problem::new(
                "this page does not have the law that was flown by: nobody can say why",
            ));
        }
        if !self.again.seek(&self.scene, self.file.seed, &self.inputs, tick) {
            return Ok(json!({ "reached": false }));
        }
        let (Some(mission), Some(kept)) = (self.again.mission(), self.watched.film.at(tick)) else {
            return Ok(json!({ "reached": false }));
        };
        if kept.tick() == tick && !same(kept, &S::kept(mission.frame(), &S::Read::default())) {
            return Err(Problem::new(format!(
                "flown again, it is another flight by tick {tick}: it was recorded by another version, and nobody can say why"
            )));
        }
        self.scene.why(mission, self.again.read(), uav)
    }

    fn series(&self, from: usize) -> Series {
        self.watched.rows.from(from)
    }

    fn events(&self) -> Vec<Value> {
        let log = self.watched.log.as_ref();
        log.map_or(&[][..], |log| &log.log().events).iter().take(EVENTS_MAX).map(told).collect()
    }

    fn graph(&self, from: Since) -> Value {
        S::graph(&self.watched.extra, from)
    }

    fn inputs(&self) -> Vec<TimedInput> {
        let timed = |asked: &Asked<_>| {
            let Input { speed_mps, follow } = S::shown(&asked.input)?;
            Some(TimedInput { tick: asked.tick, speed_mps, follow })
        };
        self.inputs.iter().filter_map(timed).collect()
    }

    fn summary(&self) -> Result<Value, Problem> {
        let summary = self.watched.metrics.sum_up(self.file.seed, self.watched.digest.hex());
        let mut value = serde_json::to_value(&summary).map_err(Problem::new)?;
        value["text"] = S::Mission::text(&summary, None, "").into();
        value["digest"] = summary.digest().into();
        Ok(value)
    }

    fn to_file(&self) -> FlightFile {
        self.file.with_inputs(self.inputs())
    }

    fn toml(&self, by_hand: bool) -> Result<String, Problem> {
        let inputs = if by_hand { &self.inputs[..] } else { &[] };
        let text = self.scene.to_text(inputs)?;
        let (seed, name) = (self.file.seed, self.scene.name());
        Ok(format!("# Flown again bit for bit by: uchain run ./{name}.toml --seed {seed}\n{text}"))
    }

    fn record(&mut self, ticks: u64) -> Result<Taped, Problem> {
        if matches!(self.origin, Origin::File(_)) {
            return Err(Problem::new("it is a recording already"));
        }
        let tape = match &mut self.tape {
            Some(tape) => tape,
            None => self.tape.insert(Tape::start(&self.scene, self.file.seed)?),
        };
        let tick = tape.go_on(&self.inputs, ticks, self.tick)?;
        if tick < self.tick {
            return Ok(Taped { tick, file: None });
        }
        let file = self.tape.take().map(Tape::finish).transpose()?;
        Ok(Taped { tick, file })
    }
}

/// Whether two frames make the same digest.
fn same<F: Snapshot>(here: &F, there: &F) -> bool {
    let (mut a, mut b) = (Vec::new(), Vec::new());
    here.hash(&mut a);
    there.hash(&mut b);
    a == b
}
