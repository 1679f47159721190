//! A law of one's own, flown by every UAV of a chain: it needs no fork, only the trait `Brain`.
//!
//! `cargo run --release --example own_law`
//!
//! ```text
//! node: 8.1 of 8.8 m flown; 3 links within 60 dB, the worst 56.5 dB; its link held the head back for 4.8 s, 1.0 m
//! bang: 7.2 of 8.8 m flown; 2 links within 60 dB, the worst 59.9 dB; its link held the head back for 9.4 s, 1.9 m
//! ```

use std::error::Error;

use uchain_core::chain::{
    Brain, Command, Estimates, Explanation, Node, NodeParams, Observation, Packet, Role, Stage,
};
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
        // Why the built-in law asks for it: on the ground, as a head or where an override has a say, that stands.
        let Some(Explanation {
            stage: Stage::Flying,
            overridden: None,
            imbalance_db: Some(imbalance_db),
            ..
        }) = self.node.explain(seen)
        else {
            return command;
        };
        let forward_mps = match imbalance_db {
            worse_db if worse_db > 3.0 => 0.15,
            better_db if better_db < -3.0 => -0.15,
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
