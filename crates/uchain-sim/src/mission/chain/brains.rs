//! The chain: brains in order, the links between them, and the pilot of the head.

use std::sync::Arc;

use uchain_core::{
    chain::{Command, End, LinkEnd, Node, NodeParams, Observation, Packet, PilotInput, RadioSlot, Role},
    seam::Brain,
};

use crate::{
    clock::time_s,
    mission::chain::{Course, LinkFrame, Scenario, Silence},
    radio::{Antenna, Receiver, Side, receiver},
    seed::Seed,
    world::World,
};

/// All brains of a run. UAVs take off in order; those in the air are the chain.
#[derive(Debug)]
pub(super) struct Brains {
    course: Arc<Course>,
    nodes: Vec<Node>,
    receivers: Vec<Box<dyn Receiver>>,
    base: BaseStation,
    said: Vec<Packet>,
    /// When each UAV fails, if it is planned to (s).
    fails_s: Vec<Option<f64>>,
    /// UAVs in the air, head first.
    flying: Vec<usize>,
    /// The first UAV that has neither flown nor failed; it listens from the ground.
    in_line: usize,
    /// The flying chain's links at the last exchange: UAV at the front end, true loss (dB).
    links: Vec<(usize, f32)>,
}

/// What one of the chain hears by.
fn receiver_of(course: &Course, seed: Seed, i: usize) -> Box<dyn Receiver> {
    let scenario = &course.scenario;
    receiver(seed, i, scenario.radio.sigma_db, &scenario.packets, &scenario.faults)
}

/// The other end of the last link: it hears the last UAV, and has nothing to decide.
#[derive(Debug)]
struct BaseStation {
    receiver: Box<dyn Receiver>,
    ear: LinkEnd,
}

fn node_params(scenario: &Scenario) -> NodeParams {
    NodeParams {
        kalman: scenario.kalman.clone(),
        equalize: scenario.equalize.clone(),
        center: scenario.center.clone(),
        takeoff: scenario.takeoff.clone(),
        link: scenario.link.clone(),
        tof_range_m: scenario.tof.range_m,
    }
}

impl Brains {
    /// All UAVs on the ground.
    pub(super) fn new(course: Arc<Course>, seed: Seed) -> Self {
        let scenario = &course.scenario;
        let count = course.spawns.len();
        let mut fails_s: Vec<Option<f64>> = vec![None; count];
        for dead in &scenario.faults.dead {
            if let Some(first_s) = fails_s.get_mut(dead.uav) {
                *first_s = Some(first_s.map_or(dead.start_s, |s| s.min(dead.start_s)));
            }
        }
        let mut brains = Self {
            nodes: Vec::with_capacity(count),
            receivers: Vec::with_capacity(count),
            base: BaseStation { receiver: receiver_of(&course, seed, count), ear: LinkEnd::new(End::Rear) },
            said: Vec::with_capacity(count),
            fails_s,
            flying: Vec::with_capacity(count),
            in_line: 0,
            links: Vec::with_capacity(count),
            course,
        };
        brains.reset(seed);
        brains
    }

    /// As [`Brains::new`] makes it.
    pub(super) fn reset(&mut self, seed: Seed) {
        let (course, count) = (&self.course, self.course.spawns.len());
        let params = node_params(&course.scenario);
        let role = |i| if i == 0 { Role::Head } else { Role::Relay };
        self.nodes.clear();
        self.nodes.extend((0..count).map(|i| Node::new(role(i), params.clone())));
        self.receivers.clear();
        self.receivers.extend((0..count).map(|i| receiver_of(course, seed, i)));
        // One number beyond the UAVs', so that it draws from streams of its own.
        self.base = BaseStation { receiver: receiver_of(course, seed, count), ear: LinkEnd::new(End::Rear) };
        self.said.clear();
        self.flying.clear();
        self.in_line = 0;
        self.links.clear();
    }

    /// What the pilot asks of the head at this time.
    pub(super) fn pilot_at(&self, time_s: f64) -> PilotInput {
        let now = self.course.scenario.pilot.iter().take_while(|step| step.start_s <= time_s).last();
        now.map_or_else(PilotInput::default, |step| PilotInput {
            speed_mps: step.speed_mps,
            follow: step.follow,
        })
    }

    /// Whether a UAV has failed by now.
    fn has_failed(&self, uav: usize, tick: u64) -> bool {
        let fails_s = self.fails_s.get(uav).copied().flatten();
        fails_s.is_some_and(|fails_s| fails_s <= time_s(tick))
    }

    /// Before anybody senses: who fails at this tick lies on the ground, is seen by nobody, says nothing and hears
    /// nothing from this very instant on.
    pub(super) fn fail(&mut self, tick: u64, world: &mut World) {
        let mut flying = std::mem::take(&mut self.flying);
        flying.retain(|&uav| {
            let has_failed = self.has_failed(uav, tick);
            if has_failed {
                world.ground(uav);
            }
            !has_failed
        });
        self.flying = flying;
        while self.has_failed(self.in_line, tick) {
            self.in_line += 1;
        }
    }

    /// One exchange of packets: everyone in the air speaks, neighbours and the next UAV in line listen.
    pub(super) fn exchange(&mut self, tick: u64, world: &World, seen: &mut [Observation]) {
        self.said.clear();
        self.said.extend(self.nodes.iter().zip(&*seen).map(|(n, o)| n.say(o.ground_speed_mps)));
        for observation in &mut *seen {
            observation.radio = Some(RadioSlot::default());
        }
        let course = &*self.course;
        let antenna = |i: usize| {
            let body = &world.bodies()[i];
            Antenna { at: body.at, heading_rad: Some(body.heading_rad()) }
        };
        let base = course.base.into();
        let loss_db = |from: &Antenna, to: &Antenna| course.path_loss.loss_db(&course.map, from, to);
        let mut hear = |i: usize, side, true_db, packet| {
            let heard = self.receivers[i].receive(tick, side, true_db, packet);
            if let Some(slot) = &mut seen[i].radio {
                match side {
                    Side::Back => slot.back = heard,
                    Side::Front => slot.front = heard,
                }
            }
        };
        let mut at_base = None;
        self.links.clear();
        for (place, &i) in self.flying.iter().enumerate() {
            if let Some(&behind) = self.flying.get(place + 1) {
                let true_db = loss_db(&antenna(i), &antenna(behind));
                hear(i, Side::Back, true_db, self.said[behind]);
                hear(behind, Side::Front, true_db, self.said[i]);
                self.links.push((i, true_db));
            } else {
                let true_db = loss_db(&antenna(i), &base);
                hear(i, Side::Back, true_db, Packet::BASE);
                at_base = self.base.receiver.receive(tick, Side::Front, true_db, self.said[i]);
                self.links.push((i, true_db));
            }
        }
        if let Some(&last) = self.flying.last().filter(|_| self.in_line < self.nodes.len()) {
            let true_db = loss_db(&antenna(last), &antenna(self.in_line));
            hear(self.in_line, Side::Front, true_db, self.said[last]);
        }
        let Scenario { kalman, equalize, link, .. } = &self.course.scenario;
        self.base.ear.hear(at_base.as_ref(), None, equalize.decision_s, kalman, link);
    }

    /// Every brain sees the same instant and asks; a dead one asks for nothing any more.
    pub(super) fn decide(&mut self, tick: u64, seen: &[Observation], commands: &mut Vec<Command>) {
        commands.resize(self.nodes.len(), Command::default());
        for (i, (command, seen)) in commands.iter_mut().zip(seen).enumerate() {
            *command = if self.has_failed(i, tick) { Command::default() } else { self.nodes[i].decide(seen) };
        }
    }

    /// Who is in the air by these commands, and who waits in line: whoever gave them, a dead UAV does nothing any more.
    pub(super) fn take_off_and_land(&mut self, tick: u64, asked: &mut [Command]) {
        let mut flying = std::mem::take(&mut self.flying);
        flying.clear();
        for (i, command) in asked.iter_mut().enumerate() {
            if self.has_failed(i, tick) {
                *command = Command::default();
            }
            if command.airborne {
                flying.push(i);
            }
        }
        self.flying = flying;
        while self.in_line < asked.len()
            && (asked[self.in_line].airborne || self.has_failed(self.in_line, tick))
        {
            self.in_line += 1;
        }
    }

    /// Links of the flying chain as of the last exchange, with the estimates of now.
    pub(super) fn links(&self) -> impl Iterator<Item = LinkFrame> {
        self.links.iter().enumerate().map(|(place, &(uav, true_db))| {
            let behind = self.links.get(place + 1).map(|&(uav, _)| &self.nodes[uav]);
            let rear_s = behind.map_or_else(|| self.base.ear.silent_s(), Node::front_silent_s);
            LinkFrame {
                uav,
                true_db,
                filtered_db: self.nodes[uav].back_loss_db(),
                raw_db: self.nodes[uav].back_raw_db(),
                silence: Some(Silence { front_s: self.nodes[uav].back_silent_s(), rear_s }),
            }
        })
    }

    /// What its pilot's wish has become when overrides have had their say (m/s); `None` while the head cannot fly freely.
    pub(super) fn head_allowed_mps(&self) -> Option<f32> {
        self.nodes.first().and_then(Node::allowed_mps)
    }
}
