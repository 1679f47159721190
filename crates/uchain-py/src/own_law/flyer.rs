//! Runs of a sweep by a law of one's own.

use std::{
    ops::ControlFlow,
    sync::{Arc, Mutex, PoisonError},
};

use pyo3::prelude::*;
use uchain_core::chain::EqualizeParams;
use uchain_sim::{
    mission::chain::{Course, Flight},
    record::RecordError,
    registry::{self, Flown, Now},
    sweep::{
        Run, Sweep, caught,
        folder::{FolderError, Watch},
        table::Flyer,
    },
};

use super::{
    OwnLaw, Way, course,
    together::{self, Entry, no_number, whom},
    what_raised, words,
};
use crate::errors::LawError;

/// Most runs side by side.
const SIDE_BY_SIDE: usize = 256;

/// Flies runs of a sweep by a law of one's own.
pub(crate) struct LawFlyer {
    law: Arc<OwnLaw>,
    /// What ended the sweep: no error of the law in a run, which is a row.
    raised: Mutex<Option<PyErr>>,
}

/// What became of a run.
type Row = Result<Flown, String>;

/// Stops a run.
struct Stop<'a>(&'a dyn Watch);

impl registry::Watch for Stop<'_> {
    fn tick(&mut self, _: &Now<'_>) -> ControlFlow<()> {
        if self.0.stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl LawFlyer {
    pub(crate) fn new(law: Arc<OwnLaw>) -> Self {
        Self { law, raised: Mutex::default() }
    }

    /// Ends what is in the law: see [`OwnLaw::interrupt`].
    pub(crate) fn interrupt(&self, py: Python<'_>) {
        self.law.interrupt(py);
    }

    /// What ended the sweep, if that was an exception.
    pub(crate) fn take(&self) -> Option<PyErr> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// The sweep ends with an exception; the first one counts.
    fn end(&self, error: PyErr) -> FolderError {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        FolderError::Interrupted
    }

    /// One run, relay by relay.
    fn alone(&self, sweep: &Sweep, run: Run, watch: &dyn Watch) -> Result<Row, FolderError> {
        let flown = sweep.one(run, |scene, run| {
            let flying = Python::attach(|py| self.law.flying(py, scene));
            let (scene, fault) = flying.map_err(|error| self.end(error))?;
            match scene.fly(run.seed, &mut Stop(watch)) {
                Ok(flown) => Ok(Ok(flown)),
                Err(RecordError::Interrupted { .. }) => match fault.take() {
                    None => Err(FolderError::Interrupted),
                    Some(error) => Python::attach(|py| {
                        if error.is_instance_of::<LawError>(py) {
                            Ok(Err(error.value(py).to_string()))
                        } else {
                            Err(self.end(error))
                        }
                    }),
                },
                Err(error) => Ok(Err(error.to_string())),
            }
        });
        flown.unwrap_or_else(|reason| Ok(Err(reason)))
    }

    /// Runs side by side.
    fn together(&self, sweep: &Sweep, runs: &[Run], watch: &dyn Watch) -> Result<Vec<Row>, FolderError> {
        let mut worlds = Vec::with_capacity(runs.len());
        let mut equalize = Vec::with_capacity(runs.len());
        for run in runs {
            let started = sweep.one(*run, |scene, run| {
                course(scene)
                    .map(|course| (Flight::start(course, run.seed), course.scenario.equalize.clone()))
            });
            match started {
                Ok(Ok((flight, params))) => {
                    worlds.push(World::Flying(Box::new(flight)));
                    equalize.push(params);
                }
                Ok(Err(error)) => return Err(self.end(error)),
                Err(reason) => {
                    worlds.push(World::Done(Err(reason)));
                    equalize.push(EqualizeParams::default());
                }
            }
        }
        let equalize: Arc<[EqualizeParams]> = equalize.into();
        while worlds.iter().any(|world| matches!(world, World::Flying(_))) {
            if watch.stop() {
                return Err(FolderError::Interrupted);
            }
            let entries = entries(&mut worlds);
            let answered = self.ask(&entries, &equalize)?;
            let mut entries = entries.as_slice();
            let mut speeds = answered.as_deref().unwrap_or_default();
            for (number, world) in worlds.iter_mut().enumerate() {
                let asked = entries.iter().take_while(|entry| entry.world == number).count();
                let (own, others) = entries.split_at(asked);
                let (own_mps, others_mps) = speeds.split_at(asked.min(speeds.len()));
                (entries, speeds) = (others, others_mps);
                let no_speed = match &answered {
                    Err(what) => own.first().map(|first| words(what, first.tick, &whom(own.iter()))),
                    Ok(_) => own.iter().zip(own_mps).find_map(|(entry, speed_mps)| {
                        let what = no_number(*speed_mps)?;
                        Some(words(&what, entry.tick, &whom([entry].into_iter())))
                    }),
                };
                match no_speed {
                    Some(reason) => *world = World::Done(Err(reason)),
                    None => world.go_on(own_mps),
                }
            }
        }
        let not_flown = || Err("not flown".to_owned());
        Ok(worlds
            .into_iter()
            .map(|world| if let World::Done(row) = world { row } else { not_flown() })
            .collect())
    }

    /// Asks the law for all; what it did instead of answering is an error of these runs alone.
    fn ask(
        &self,
        entries: &[Entry],
        equalize: &Arc<[EqualizeParams]>,
    ) -> Result<Result<Vec<f32>, String>, FolderError> {
        if entries.is_empty() {
            return Ok(Ok(Vec::new()));
        }
        Python::attach(|py| {
            let answered = self.law.ask(py, |law| together::ask(law, entries, equalize)).flatten();
            match answered {
                Ok(speeds) => Ok(speeds.map_err(|no_answer| no_answer.what)),
                Err(error) => match what_raised(py, &error) {
                    Some(what) => Ok(Err(what)),
                    None => Err(self.end(error)),
                },
            }
        })
    }
}

/// A run among others.
enum World {
    Flying(Box<Flight>),
    Done(Row),
}

impl World {
    /// To its next decision, or to its end.
    fn go_on(&mut self, level_mps: &[f32]) {
        let Self::Flying(flight) = self else { return };
        let gone_on = caught(|| match flight.go_on(level_mps, &mut ()) {
            Ok(None) => None,
            Ok(Some(_)) => Some(Ok(Flown::of::<Course>(flight.summary()))),
            Err(error) => Some(Err(error.to_string())),
        });
        match gone_on {
            Ok(None) => {}
            Ok(Some(row)) => *self = Self::Done(row),
            Err(reason) => *self = Self::Done(Err(reason)),
        }
    }
}

/// Those that ask, world by world.
fn entries(worlds: &mut [World]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (number, world) in worlds.iter_mut().enumerate() {
        if let World::Flying(flight) = world {
            let tick = flight.chain().tick();
            entries.extend(flight.asked().iter().map(|asked| Entry { world: number, tick, asked: *asked }));
        }
    }
    entries
}

impl Flyer for LawFlyer {
    fn at_a_time(&self) -> usize {
        if self.law.way == Way::Together { SIDE_BY_SIDE } else { 1 }
    }

    fn fly(&self, sweep: &Sweep, runs: &[Run], watch: &dyn Watch) -> Result<Vec<Row>, FolderError> {
        // Python knows this thread all the while, and need not meet it anew at every decision.
        Python::attach(|py| {
            py.detach(|| match self.law.way {
                Way::Together => self.together(sweep, runs, watch),
                Way::Each | Way::Started => runs.iter().map(|run| self.alone(sweep, *run, watch)).collect(),
            })
        })
    }
}
