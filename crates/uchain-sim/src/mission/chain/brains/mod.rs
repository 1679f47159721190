//! The brains of a chain, and the links between them.

mod radio;

use std::sync::Arc;

use uchain_core::chain::{
    BASE_ID, Command, Doing, End, Explanation, HEARD_MAX, Heard, LinkEnd, Observation, Packet, equalize,
};

use crate::{
    clock::time_s,
    mission::chain::{Asked, Course, Law, Leveller, LinkFrame, Member, Members, Scenario, Silence},
    radio::{Antenna, Channel, Link, Side},
    seed::Seed,
    world::World,
};

use radio::{base_of, radio_of};

/// All brains of a run, by id.
#[derive(Debug)]
pub(super) struct Brains<B> {
    course: Arc<Course>,
    nodes: Vec<B>,
    pub(super) members: Members,
    radio: Box<dyn Channel<Packet>>,
    /// The other end of the last link, the base: it hears the last UAV, and has nothing to decide.
    base: LinkEnd,
    said: Vec<Packet>,
    /// When each UAV fails, if it is planned to (s); empty if none is.
    fails_s: Vec<Option<f64>>,
    /// The flying chain's links at the last exchange: UAV at the front end, true loss (dB).
    links: Vec<(usize, f32)>,
    /// Who levels the relays; `None`: they themselves.
    leveller: Option<Box<dyn Leveller>>,
    /// Whether the leveller has broken the run off.
    pub(super) is_broken_off: bool,
    /// Whether the first half of this tick's decisions has been made.
    is_prepared: bool,
    /// Who asked for a speed in that half.
    asked: Vec<Asked>,
    /// Room for what they get.
    level_mps: Vec<f32>,
}

impl<B: Law> Brains<B> {
    /// All UAVs on the ground.
    pub(super) fn new(course: Arc<Course>, seed: Seed) -> Self {
        let scenario = &course.scenario;
        let count = course.spawns.len();
        let dead = &scenario.faults.dead;
        let mut fails_s: Vec<Option<f64>> = vec![None; if dead.is_empty() { 0 } else { count }];
        for dead in dead {
            if let Some(first_s) = fails_s.get_mut(dead.uav) {
                *first_s = Some(first_s.map_or(dead.start_s, |s| s.min(dead.start_s)));
            }
        }
        let mut brains = Self {
            nodes: Vec::with_capacity(count),
            members: Members::new(count),
            radio: radio_of(&course, seed),
            base: LinkEnd::new(End::Rear),
            said: Vec::with_capacity(count),
            fails_s,
            links: Vec::with_capacity(count),
            leveller: None,
            is_broken_off: false,
            is_prepared: false,
            asked: Vec::with_capacity(count),
            level_mps: Vec::with_capacity(count),
            course: course.clone(),
        };
        brains.reset(&course, seed);
        brains
    }

    /// As [`Brains::new`] makes it, of the same course as the seed has it.
    pub(super) fn reset(&mut self, course: &Arc<Course>, seed: Seed) {
        self.course = course.clone();
        let count = course.spawns.len();
        self.nodes.clear();
        self.nodes.extend((0..count).map(|i| B::of(course, i)));
        self.members.reset(count);
        self.radio = radio_of(course, seed);
        self.base = LinkEnd::new(End::Rear);
        self.said.clear();
        self.links.clear();
        self.leveller = course.leveller.as_ref().map(|own| own.make(course));
        (self.is_broken_off, self.is_prepared) = (false, false);
    }

    /// Whether a UAV has failed by now.
    fn has_failed(&self, uav: usize, tick: u64) -> bool {
        let fails_s = self.fails_s.get(uav).copied().flatten();
        fails_s.is_some_and(|fails_s| fails_s <= time_s(tick))
    }

    /// Before anybody senses: who fails at this tick lies on the ground, is seen by nobody, says nothing and hears
    /// nothing from this very instant on.
    pub(super) fn fail(&mut self, tick: u64, world: &mut World) {
        for uav in 0..self.fails_s.len() {
            if self.has_failed(uav, tick) && self.members.fail(uav) {
                world.ground(uav);
            }
        }
    }

    /// One exchange of packets: everyone in the air speaks, neighbours and the next UAV in line listen.
    pub(super) fn exchange(&mut self, tick: u64, world: &World, seen: &mut [Observation]) {
        for (uav, observation) in seen.iter_mut().enumerate() {
            observation.place = self.members.place_of(uav);
            observation.radio.get_or_insert_default().clear();
        }
        self.said.clear();
        self.said.extend(self.nodes.iter().zip(&*seen).map(|(node, seen)| node.say(seen)));
        let course = &*self.course;
        let antenna = |i: usize| {
            let body = &world.bodies()[i];
            Antenna::flying(body.at, body.heading_rad()).on_ground(!body.airborne).carried_by(i as u16)
        };
        let base = course.base_antenna();
        let mut transfer = |from: u16, to: u16, side: Option<Side>, true_db, packet| {
            let link = Link { from, to, side };
            let received = self.radio.transfer(link, tick, true_db, packet)?;
            Some(Heard { from: received.from, loss_db: received.loss_db, packet: received.payload })
        };
        let id = |uav: usize| uav as u16;
        let mut hear = |to: usize, heard: Option<Heard>| {
            if let (Some(heard), Some(slot)) = (heard, &mut seen[to].radio) {
                slot.push(heard);
            }
        };
        let mut at_base = None;
        self.links.clear();
        let flying = self.members.flying();
        for (i, &uav) in flying.iter().enumerate() {
            if let Some(&behind) = flying.get(i + 1) {
                let true_db = course.loss_db(&antenna(uav), &antenna(behind));
                hear(uav, transfer(id(behind), id(uav), Some(Side::Back), true_db, self.said[behind]));
                hear(behind, transfer(id(uav), id(behind), Some(Side::Front), true_db, self.said[uav]));
                self.links.push((uav, true_db));
            } else {
                let true_db = course.loss_db(&antenna(uav), &base);
                hear(uav, transfer(BASE_ID, id(uav), Some(Side::Back), true_db, Packet::BASE));
                at_base = transfer(id(uav), base_of(course), Some(Side::Front), true_db, self.said[uav]);
                self.links.push((uav, true_db));
            }
        }
        let in_line = self.members.in_line();
        let ahead = in_line.and_then(|uav| self.members.ahead_of(self.members.place_of(uav)?));
        if let (Some(uav), Some(ahead)) = (in_line, ahead) {
            let true_db = course.loss_db(&antenna(ahead), &antenna(uav));
            hear(uav, transfer(id(ahead), id(uav), Some(Side::Front), true_db, self.said[ahead]));
        }
        // Whoever wants to hear more than his neighbours: links of no neighbours have random numbers of their own.
        for (i, &uav) in flying.iter().enumerate() {
            for off in 2..=usize::from(self.nodes[uav].reach()).min(HEARD_MAX / 2) {
                let others = [i.checked_sub(off).and_then(|i| flying.get(i)), flying.get(i + off)];
                for &other in others.into_iter().flatten() {
                    let true_db = course.loss_db(&antenna(uav), &antenna(other));
                    hear(uav, transfer(id(other), id(uav), None, true_db, self.said[other]));
                }
                if i + off == flying.len() {
                    let true_db = course.loss_db(&antenna(uav), &base);
                    hear(uav, transfer(BASE_ID, id(uav), None, true_db, Packet::BASE));
                }
            }
        }
        let Scenario { kalman, equalize, link, .. } = &self.course.scenario;
        self.base.hear(at_base.as_ref(), None, equalize.decision_s, kalman, link);
    }

    /// A new instant has come: what was prepared of the last one is void.
    pub(super) fn forget(&mut self) {
        self.is_prepared = false;
    }

    /// Every brain sees the same instant and asks; a dead one asks for nothing any more.
    pub(super) fn decide(&mut self, tick: u64, seen: &[Observation], commands: &mut Vec<Command>) {
        if self.leveller.is_some() || self.is_prepared {
            self.decide_in_halves(tick, seen, commands);
            return;
        }
        commands.resize(self.nodes.len(), Command::default());
        for (i, (command, seen)) in commands.iter_mut().zip(seen).enumerate() {
            *command = if self.has_failed(i, tick) { Command::default() } else { self.nodes[i].decide(seen) };
        }
    }

    /// The same, with whoever levels asked in between.
    fn decide_in_halves(&mut self, tick: u64, seen: &[Observation], commands: &mut Vec<Command>) {
        self.prepare(tick, seen);
        let mut level_mps = std::mem::take(&mut self.level_mps);
        level_mps.clear();
        level_mps.resize(self.asked.len(), 0.0);
        match &mut self.leveller {
            Some(leveller) if !self.asked.is_empty() => {
                self.is_broken_off |= leveller.level(tick, &self.asked, &mut level_mps).is_break();
            }
            Some(_) => {}
            None => {
                let params = &self.course.scenario.equalize;
                for (level_mps, Asked { levelling, .. }) in level_mps.iter_mut().zip(&self.asked) {
                    *level_mps = equalize(levelling.back_db, levelling.front_db, params);
                }
            }
        }
        self.conclude(tick, seen, &level_mps, commands);
        self.level_mps = level_mps;
    }

    /// The first half of all decisions of an instant, made once: who asks for a speed.
    pub(super) fn prepare(&mut self, tick: u64, seen: &[Observation]) -> &[Asked] {
        if !std::mem::replace(&mut self.is_prepared, true) {
            self.asked.clear();
            for (uav, seen) in seen.iter().enumerate() {
                if !self.has_failed(uav, tick)
                    && let Some(levelling) = self.nodes[uav].prepare(seen)
                {
                    self.asked.push(Asked { uav, levelling });
                }
            }
        }
        &self.asked
    }

    /// The second half: speeds for those that asked, in their order.
    pub(super) fn conclude(
        &mut self,
        tick: u64,
        seen: &[Observation],
        level_mps: &[f32],
        commands: &mut Vec<Command>,
    ) {
        self.prepare(tick, seen);
        self.is_prepared = false;
        commands.resize(self.nodes.len(), Command::default());
        let mut speeds = self.asked.iter().zip(level_mps).peekable();
        for (uav, (command, seen)) in commands.iter_mut().zip(seen).enumerate() {
            let own_mps =
                speeds.next_if(|(asked, _)| asked.uav == uav).map_or(0.0, |(_, level_mps)| *level_mps);
            let has_failed = self.fails_s.get(uav).copied().flatten().is_some_and(|s| s <= time_s(tick));
            *command = if has_failed { Command::default() } else { self.nodes[uav].conclude(seen, own_mps) };
        }
    }

    /// Who is in the air by these commands: whoever gave them, a dead UAV does nothing any more.
    pub(super) fn take_off_and_land(&mut self, tick: u64, asked: &mut [Command]) {
        for (uav, command) in asked.iter_mut().enumerate() {
            if self.has_failed(uav, tick) {
                *command = Command::default();
            }
        }
        self.members.fly(asked.iter().map(|command| command.airborne));
    }

    /// Links of the flying chain as of the last exchange, with the estimates of now.
    pub(super) fn links(&self) -> impl Iterator<Item = LinkFrame> {
        self.links.iter().enumerate().map(|(place, &(uav, true_db))| {
            let behind = self.links.get(place + 1).map(|&(behind, _)| self.nodes[behind].estimates().front);
            let rear_s = behind.map_or_else(|| self.base.silent_s(), |link| link.silent_s);
            let back = self.nodes[uav].estimates().back;
            LinkFrame {
                uav,
                true_db,
                filtered_db: back.filtered_db,
                raw_db: back.raw_db,
                silence: Some(Silence { front_s: back.silent_s, rear_s }),
            }
        })
    }

    /// What its pilot's wish has become when overrides have had their say (m/s); `None` while the head cannot fly freely.
    pub(super) fn head_allowed_mps(&self) -> Option<f32> {
        self.members.leader().and_then(|head| self.nodes[head].estimates().allowed_mps)
    }

    /// What a UAV tells whoever hears it; `None` if there is none of this id.
    pub(super) fn says(&self, uav: usize, seen: &[Observation]) -> Option<Packet> {
        Some(self.nodes.get(uav)?.say(seen.get(uav)?))
    }

    /// What a UAV believes and why it asks for what it asks; `None` if there is none of this id, or its law does not say.
    pub(super) fn explain(&self, uav: usize, seen: &[Observation]) -> Option<Explanation> {
        self.nodes.get(uav)?.explain(seen.get(uav)?)
    }

    /// What a UAV is about after its decision; `None` if it has failed, or its law does not say.
    pub(super) fn doing(&self, uav: usize, seen: &Observation) -> Option<Doing> {
        if self.members.member(uav) == Some(Member::Failed) {
            return None;
        }
        // A recording has no other word for a loss that is none.
        let doing = self.nodes.get(uav)?.doing(seen)?;
        Some(Doing { launch: doing.launch.filter(|launch| launch.loss_db.is_finite()), ..doing })
    }
}
