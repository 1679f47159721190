//! A flight that is flown once more, into a recording.

use std::sync::Arc;

use uchain_sim::{
    mission::{Mission as _, Recorded},
    pilot::Asked,
    record::{Snapshot as _, mcap::McapRecorder},
    run::InputOf,
};

use super::again::steer;
use crate::{problem::Problem, seen::Viewed};

/// Longest recording that a page makes (bytes): it opens no longer one.
const MOST_BYTES: u64 = 64 << 20;

type RecorderOf<S> = McapRecorder<Vec<u8>, <<S as uchain_sim::mission::Scene>::Mission as Recorded>::Topics>;

/// A recording under way.
#[derive(Debug)]
pub(super) struct Tape<S: Viewed> {
    mission: S::Mission,
    recorder: RecorderOf<S>,
    next: usize,
}

impl<S: Viewed> Tape<S> {
    pub(super) fn start(scene: &Arc<S>, seed: u64) -> Result<Self, Problem> {
        let mission = S::Mission::start(scene.clone(), seed);
        let recorder = McapRecorder::start(Vec::new(), &**scene, seed).map_err(Problem::new)?;
        Ok(Self { mission, recorder, next: 0 })
    }

    /// Flies on by so many ticks, at most to `end`; gives the tick that it has come to.
    pub(super) fn go_on(
        &mut self,
        inputs: &[Asked<InputOf<S>>],
        ticks: u64,
        end: u64,
    ) -> Result<u64, Problem> {
        for _ in 0..ticks {
            if self.mission.frame().tick() >= end {
                break;
            }
            steer(&mut self.mission, inputs, &mut self.next);
            self.mission.step(&mut self.recorder).map_err(Problem::new)?;
        }
        Ok(self.mission.frame().tick())
    }

    /// The file.
    pub(super) fn finish(self) -> Result<Vec<u8>, Problem> {
        let file = self.recorder.finish().map_err(Problem::new)?;
        if file.len() as u64 > MOST_BYTES {
            let mib = file.len() >> 20;
            return Err(Problem::new(format!(
                "the recording would have {mib} MiB, more than a page opens again (64): save the scenario instead, and \
                 record it with `uchain run`"
            )));
        }
        Ok(file)
    }
}
