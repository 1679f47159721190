//! A law that is asked for all relays at once.

use std::{ops::ControlFlow, sync::Arc};

use pyo3::prelude::*;
use uchain_core::chain::EqualizeParams;
use uchain_sim::mission::chain::{Asked, Leveller};

use super::{Fault, Filling, LawParams, OwnLaw, no_speed, raised, speeds_mps};

/// A law of Python, in one run.
#[derive(Debug)]
pub(super) struct Together {
    law: Arc<OwnLaw>,
    fault: Arc<Fault>,
    equalize: Arc<[EqualizeParams]>,
}

impl Together {
    pub(super) fn new(law: Arc<OwnLaw>, fault: Arc<Fault>, equalize: &EqualizeParams) -> Self {
        Self { law, fault, equalize: Arc::new([equalize.clone()]) }
    }

    fn ask(&self, py: Python<'_>, tick: u64, asked: &[Asked]) -> PyResult<Vec<f32>> {
        let entries = asked.iter().map(|asked| Entry { world: 0, tick, asked: *asked }).collect::<Vec<_>>();
        let speeds = self.law.ask(py, |law| ask(law, &entries, &self.equalize))??;
        for (speed_mps, entry) in speeds.iter().zip(&entries) {
            entry.check(py, *speed_mps)?;
        }
        Ok(speeds)
    }
}

/// A relay among those that are asked together.
pub(crate) struct Entry {
    pub(crate) world: usize,
    pub(crate) tick: u64,
    pub(crate) asked: Asked,
}

impl Entry {
    /// A speed is expected to be a number.
    pub(crate) fn check(&self, py: Python<'_>, speed_mps: f32) -> PyResult<()> {
        if speed_mps.is_finite() {
            return Ok(());
        }
        let what = format!("returned {speed_mps}: expected a finite number, the forward speed (m/s)");
        Err(no_speed(py, &what, self.tick, &format!("UAV {}", self.asked.uav), None))
    }
}

/// Asks for all of them at once; whether what comes back is finite is not asked.
pub(crate) fn ask(
    law: &Bound<'_, PyAny>,
    entries: &[Entry],
    equalize: &Arc<[EqualizeParams]>,
) -> PyResult<Vec<f32>> {
    let py = law.py();
    let tick = entries.first().map_or(0, |entry| entry.tick);
    let whom = || {
        const MOST: usize = 8;
        let uavs: Vec<String> = entries.iter().take(MOST).map(|entry| entry.asked.uav.to_string()).collect();
        let s = if entries.len() == 1 { "" } else { "s" };
        let more = if entries.len() > MOST { ", …" } else { "" };
        format!("UAV{s} {}{more}", uavs.join(", "))
    };
    let mut filling = Filling::new(entries.len());
    for (at, Entry { world, tick, asked }) in entries.iter().enumerate() {
        filling.ask(at, *world, *tick, asked);
    }
    let world = entries.iter().map(|entry| entry.world as u32).collect();
    let seen = filling.done(py, None, LawParams::many(equalize.clone(), world))?;
    let answer = law.call1((seen,)).map_err(|error| raised(py, error, tick, &whom()))?;
    speeds_mps(&answer, &[entries.len()])
        .map_err(|what| no_speed(py, &format!("returned {what}"), tick, &whom(), None))
}

impl Leveller for Together {
    fn level(&mut self, tick: u64, asked: &[Asked], level_mps: &mut [f32]) -> ControlFlow<()> {
        match Python::attach(|py| self.ask(py, tick, asked)) {
            Ok(speeds) => {
                level_mps.copy_from_slice(&speeds);
                ControlFlow::Continue(())
            }
            Err(error) => {
                self.fault.set(error);
                ControlFlow::Break(())
            }
        }
    }
}
