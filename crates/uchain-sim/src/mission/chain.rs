//! The chain: brains in order, the links between them, and the pilot of the head.

use glam::Vec2;
use uchain_core::{
    chain::{Command, Node, NodeParams, Observation, Packet, Pilot, RadioSlot, Role},
    seam::Brain,
};

use crate::{
    config::{Course, PilotStep, Scenario},
    radio::{PathLoss, Radio, Side},
    record::LinkFrame,
    seed::Seed,
    world::World,
};

/// All brains of a run. UAVs take off in order, so those in the air are the first `flying`.
#[derive(Debug)]
pub struct ChainMission<'a> {
    base: Vec2,
    pilot: &'a [PilotStep],
    path_loss: PathLoss,
    nodes: Vec<Node>,
    radios: Vec<Radio>,
    said: Vec<Packet>,
    true_db: Vec<f32>,
    flying: usize,
}

fn node_params(scenario: &Scenario) -> NodeParams {
    NodeParams {
        kalman: scenario.kalman.clone(),
        equalize: scenario.equalize.clone(),
        center: scenario.center.clone(),
        takeoff: scenario.takeoff.clone(),
        link: scenario.link.clone(),
    }
}

impl<'a> ChainMission<'a> {
    /// All UAVs on the ground.
    pub fn new(course: &'a Course, seed: Seed) -> Self {
        let scenario = &course.scenario;
        let params = node_params(scenario);
        let count = course.spawns.len();
        let role = |i| if i == 0 { Role::Head } else { Role::Relay };
        let radio = |i| Radio::new(seed, i, scenario.radio.sigma_db, scenario.packets.clone());
        Self {
            base: course.base,
            pilot: &scenario.pilot,
            path_loss: PathLoss::new(scenario.radio.clone()),
            nodes: (0..count).map(|i| Node::new(role(i), params.clone())).collect(),
            radios: (0..count as u32).map(radio).collect(),
            said: Vec::with_capacity(count),
            true_db: Vec::with_capacity(count),
            flying: 0,
        }
    }

    /// What the pilot asks of the head at this time.
    pub fn pilot_at(&self, time_s: f64) -> Pilot {
        let now = self.pilot.iter().take_while(|step| step.start_s <= time_s).last();
        now.map_or_else(Pilot::default, |step| Pilot { speed_mps: step.speed_mps, follow: step.follow })
    }

    /// One exchange of packets: everyone in the air speaks, neighbours and the next UAV in line listen.
    pub fn exchange(&mut self, world: &World<'_>, seen: &mut [Observation]) {
        self.said.clear();
        self.said.extend(self.nodes.iter().zip(&*seen).map(|(n, o)| n.say(o.ground_speed_mps)));
        let bodies = world.bodies();
        let place = |i: usize| if i < self.flying { bodies[i].at } else { self.base };
        let loss = |from, to| self.path_loss.loss_db(world.map(), from, to);
        self.true_db.clear();
        self.true_db.extend((0..self.flying).map(|i| loss(place(i), place(i + 1))));

        for (i, (radio, observation)) in self.radios.iter_mut().zip(seen).enumerate() {
            let mut slot = RadioSlot::default();
            if i < self.flying {
                let packet = if i + 1 < self.flying { self.said[i + 1] } else { Packet::default() };
                slot.back = radio.receive(Side::Back, self.true_db[i], packet);
            }
            if i > 0 && i <= self.flying {
                let true_db = if i < self.flying {
                    self.true_db[i - 1]
                } else {
                    // The next in line still stands on the ground and listens to the chain's last UAV.
                    loss(bodies[i].at, bodies[i - 1].at)
                };
                slot.front = radio.receive(Side::Front, true_db, self.said[i - 1]);
            }
            observation.radio = Some(slot);
        }
    }

    /// Every brain sees the same instant and asks.
    pub fn decide(&mut self, seen: &[Observation], asked: &mut [Command]) {
        for ((node, observation), command) in self.nodes.iter_mut().zip(seen).zip(asked.iter_mut()) {
            *command = node.decide(observation);
        }
        self.flying = asked.iter().take_while(|command| command.airborne).count();
    }

    /// Links of the flying chain as of the last exchange, with the estimates of now.
    pub fn links(&self) -> impl Iterator<Item = LinkFrame> {
        self.true_db
            .iter()
            .zip(&self.nodes)
            .map(|(true_db, node)| LinkFrame { true_db: *true_db, filtered_db: node.back_loss_db() })
    }
}
