//! A law that is asked relay by relay.

use std::{ops::ControlFlow, sync::Arc};

use pyo3::prelude::*;
use uchain_core::chain::EqualizeParams;
use uchain_sim::mission::chain::{Asked, Leveller};

use super::{Fault, LawParams, OwnLaw, Way, answer, no_speed, raised, seen::Seen};

/// A law of Python, in one run.
#[derive(Debug)]
pub(super) struct Each {
    law: Arc<OwnLaw>,
    fault: Arc<Fault>,
    equalize: EqualizeParams,
    params: Option<Py<LawParams>>,
    /// What is asked for a relay, by id: made at its first decision.
    relays: Vec<Option<Py<PyAny>>>,
}

impl Each {
    pub(super) fn new(law: Arc<OwnLaw>, fault: Arc<Fault>, equalize: &EqualizeParams) -> Self {
        Self { law, fault, equalize: equalize.clone(), params: None, relays: Vec::new() }
    }

    fn params(&mut self, py: Python<'_>) -> PyResult<Py<LawParams>> {
        if let Some(params) = &self.params {
            return Ok(params.clone_ref(py));
        }
        let params = Py::new(py, LawParams::one(&self.equalize))?;
        Ok(self.params.insert(params).clone_ref(py))
    }

    /// What is asked for this relay.
    fn relay<'py>(&mut self, law: &Bound<'py, PyAny>, uav: usize) -> PyResult<Bound<'py, PyAny>> {
        if self.law.way != Way::Started {
            return Ok(law.clone());
        }
        let py = law.py();
        if let Some(Some(relay)) = self.relays.get(uav) {
            return Ok(relay.bind(py).clone());
        }
        let relay = law.call_method1("start", (uav, self.params(py)?))?;
        if self.relays.len() <= uav {
            self.relays.resize_with(uav + 1, || None);
        }
        self.relays[uav] = Some(relay.clone().unbind());
        Ok(relay)
    }

    fn ask(&mut self, law: &Bound<'_, PyAny>, tick: u64, asked: Asked) -> PyResult<f32> {
        let py = law.py();
        let whom = || format!("UAV {}", asked.uav);
        let relay = self.relay(law, asked.uav).map_err(|error| raised(py, error, tick, &whom()))?;
        let params = self.params(py)?;
        let seen = Bound::new(py, Seen::of(tick, &asked, params))?;
        let answer = relay.call1((seen,)).map_err(|error| raised(py, error, tick, &whom()))?;
        answer::speed_mps(&answer).map_err(|what| no_speed(py, &what, tick, &whom(), None))
    }
}

impl Leveller for Each {
    fn level(&mut self, tick: u64, asked: &[Asked], level_mps: &mut [f32]) -> ControlFlow<()> {
        let own = self.law.clone();
        let answered = Python::attach(|py| {
            own.ask(py, |law| -> PyResult<()> {
                for (level_mps, asked) in level_mps.iter_mut().zip(asked) {
                    *level_mps = self.ask(law, tick, *asked)?;
                }
                Ok(())
            })
        });
        match answered.flatten() {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.fault.set(error);
                ControlFlow::Break(())
            }
        }
    }
}
