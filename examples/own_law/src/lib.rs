//! `pip install ./examples/own_law`, and in Python `own_law` is `uchain` with one more word for `chain.brain`, as fast as
//! the built-in law:
//!
//! ```python
//! import own_law
//!
//! print(own_law.run(own_law.Scenario.from_name("corner").with_(**{"chain.brain": "half"})).verdict)
//! table = own_law.sweep("corner", vary={"chain.brain": ["node", "half"]})
//! ```

use pyo3::prelude::*;
use uchain_core::chain::{Brain, Command, Estimates, Node, NodeParams, Observation, Packet, Role};
use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    mission::{Scene as _, chain::ChainExtensions, chain::Course},
    registry::{AnyMission, Of, Registry},
};

/// Does what the built-in law does at half its speed.
#[derive(Debug)]
struct Half(Node);

impl Brain for Half {
    fn decide(&mut self, seen: &Observation) -> Command {
        let command = self.0.decide(seen);
        Command { forward_mps: 0.5 * command.forward_mps, ..command }
    }

    fn say(&self, seen: &Observation) -> Packet {
        self.0.say(seen)
    }

    fn estimates(&self) -> Estimates {
        self.0.estimates()
    }
}

/// A law for the UAV of this id: 0 leads the chain.
fn half(uav: usize, params: &NodeParams) -> Box<dyn Brain> {
    let role = if uav == 0 { Role::Head } else { Role::Relay };
    Box::new(Half(Node::new(role, params.clone())))
}

static MISSIONS: [&dyn AnyMission; 1] =
    [&Of::<Course>::with(ChainExtensions { brains: &[("half", half)], ..Course::BUILTIN })];

#[pymodule]
fn own_law(module: &Bound<'_, PyModule>) -> PyResult<()> {
    uchain_py::fill(module, Registry::new(&MISSIONS))
}
