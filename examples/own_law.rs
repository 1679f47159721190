//! A law of one's own, flown by every UAV of a chain: it needs no fork, only the trait `Brain`.
//!
//! `cargo run --release --example own_law`

use std::error::Error;

use uchain_core::chain::{Brain, Command, Estimates, Node, NodeParams, Observation, Packet, Role};
use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    config::builtin,
    mission::{
        Scene as _,
        chain::{ChainExtensions, Course, Summary},
    },
    registry::{AnyMission, Of, Registry},
};

/// Takes off, holds its links and keeps to mid-tunnel as the built-in law does, but levels at one speed, whatever the
/// imbalance: forward if the link in front is the worse one by more than 3 dB, backward if it is the better one.
#[derive(Debug)]
struct Bang {
    node: Node,
}

impl Brain for Bang {
    fn decide(&mut self, seen: &Observation) -> Command {
        let command = self.node.decide(seen);
        let estimates = self.node.estimates();
        let (Some(front_db), Some(back_db)) = (estimates.front.filtered_db, estimates.back.filtered_db)
        else {
            return command; // a head, or nothing heard yet
        };
        if command.forward_mps == 0.0 {
            return command; // on the ground, or held
        }
        let forward_mps = match front_db - back_db {
            imbalance_db if imbalance_db > 3.0 => 0.15,
            imbalance_db if imbalance_db < -3.0 => -0.15,
            _ => 0.0,
        };
        Command { forward_mps, ..command }
    }

    /// What it tells whoever hears it.
    fn say(&self, seen: &Observation) -> Packet {
        self.node.say(seen)
    }

    /// What it believes, for summaries, pictures and recordings.
    fn estimates(&self) -> Estimates {
        self.node.estimates()
    }
}

/// A law for the UAV of this id: 0 leads the chain.
fn bang(uav: usize, params: &NodeParams) -> Box<dyn Brain> {
    let role = if uav == 0 { Role::Head } else { Role::Relay };
    Box::new(Bang { node: Node::new(role, params.clone()) })
}

/// The missions of this program: chains whose scenarios may say `chain.brain = "bang"`.
static MISSIONS: [&dyn AnyMission; 1] =
    [&Of::<Course>::with(ChainExtensions { brains: &[("bang", bang)], ..Course::BUILTIN })];

fn main() -> Result<(), Box<dyn Error>> {
    let registry = Registry::new(&MISSIONS);
    let corner = builtin("corner").ok_or("corner comes along")?;
    for brain in ["node", "bang"] {
        let scene = registry.read(&corner, &[format!("chain.brain={brain}")])?;
        let flown = scene.fly(1, &mut ())?;
        let summary = flown.summary::<Summary>().ok_or("a chain")?;
        println!("{brain}: {}", summary.verdict);
    }
    Ok(())
}
