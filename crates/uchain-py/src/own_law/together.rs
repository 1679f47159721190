//! A law that is asked for all relays at once.

use std::{ops::ControlFlow, sync::Arc};

use pyo3::prelude::*;
use uchain_core::chain::EqualizeParams;
use uchain_sim::mission::chain::{Asked, Leveller};

use super::{Fault, Filling, LawParams, OwnLaw, no_speed, speeds_mps, what_raised};

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
        let speeds = speeds.map_err(|no_answer| no_answer.error(py, &entries))?;
        for (speed_mps, entry) in speeds.iter().zip(&entries) {
            if let Some(what) = no_number(*speed_mps) {
                return Err(NoAnswer { what, cause: None }.error(py, std::slice::from_ref(entry)));
            }
        }
        Ok(speeds)
    }
}

/// A relay among those that are asked together.
pub(super) struct Entry {
    pub(super) world: usize,
    pub(super) tick: u64,
    pub(super) asked: Asked,
}

/// What is wrong with a speed, if anything is.
pub(super) fn no_number(speed_mps: f32) -> Option<String> {
    let words = || format!("returned {speed_mps}: expected a finite number, the forward speed (m/s)");
    (!speed_mps.is_finite()).then(words)
}

/// A law that gave no speeds: what it did.
pub(super) struct NoAnswer {
    pub(super) what: String,
    cause: Option<PyErr>,
}

impl NoAnswer {
    fn error(self, py: Python<'_>, entries: &[Entry]) -> PyErr {
        let tick = entries.first().map_or(0, |entry| entry.tick);
        no_speed(py, &self.what, tick, &whom(entries.iter()), self.cause)
    }
}

/// Relays, for a message.
pub(super) fn whom<'a>(entries: impl Iterator<Item = &'a Entry>) -> String {
    const MOST: usize = 8;
    let mut uavs: Vec<String> = entries.take(MOST + 1).map(|entry| entry.asked.uav.to_string()).collect();
    let s = if uavs.len() == 1 { "" } else { "s" };
    if let Some(last) = uavs.get_mut(MOST) {
        "…".clone_into(last);
    }
    format!("UAV{s} {}", uavs.join(", "))
}

/// Asks for all of them at once; whether what comes back is finite is not asked.
///
/// # Errors
/// What is no error of the law: Ctrl-C and the like, or Python's own.
pub(super) fn ask(
    law: &Bound<'_, PyAny>,
    entries: &[Entry],
    equalize: &Arc<[EqualizeParams]>,
) -> PyResult<Result<Vec<f32>, NoAnswer>> {
    let py = law.py();
    let mut filling = Filling::new(entries.len());
    for (at, Entry { world, tick, asked }) in entries.iter().enumerate() {
        filling.ask(at, *world, *tick, asked);
    }
    let world = entries.iter().map(|entry| entry.world as u32).collect();
    let seen = filling.done(py, None, LawParams::many(equalize.clone(), world))?;
    Ok(match law.call1((seen,)) {
        Ok(answer) => speeds_mps(&answer, &[entries.len()])
            .map_err(|what| NoAnswer { what: format!("returned {what}"), cause: None }),
        Err(error) => {
            let what = what_raised(py, &error);
            Err(NoAnswer { what: what.ok_or(error.clone_ref(py))?, cause: Some(error) })
        }
    })
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
