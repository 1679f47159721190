//! Who hears whom: robots whose radio reaches each other, and those they pass on to; and what they have heard.

#[cfg(test)]
mod tests;

use std::sync::Arc;

use uchain_core::explore::{Message, NodeId, Ssg};

use crate::{
    map::Map,
    mission::explore::Site,
    radio::{Antenna, Channel, FaultConfig, Link, NO_LINK_DB, RadioModel, channel, finite_db},
    seed::Seed,
};

/// Groups of robots that hear each other this round. Robots of one group know the same.
#[derive(Debug)]
pub(super) struct Connectivity {
    /// `None`: all hear all.
    radio: Option<TeamRadio>,
    /// Per robot, the lowest index of its group.
    leader: Vec<usize>,
    /// By leader, the robots of its group in index order, itself included.
    members: Vec<Vec<usize>>,
    log: Log,
}

impl Connectivity {
    pub(super) fn new(robots: usize, radio: Option<TeamRadio>) -> Self {
        // Where all hear all, nobody is ever told what was said before.
        let log = Log::new(if radio.is_some() { robots } else { 0 });
        let mut connectivity = Self { radio, leader: Vec::new(), members: Vec::new(), log };
        connectivity.gather(vec![0; robots]);
        connectivity
    }

    /// The robots of a robot's group, itself included, in index order.
    pub(super) fn group_of(&self, robot: usize) -> &[usize] {
        let members = self.leader.get(robot).and_then(|&leader| self.members.get(leader));
        members.map_or(&[], Vec::as_slice)
    }

    /// All groups, by their lowest index.
    pub(super) fn groups(&self) -> impl Iterator<Item = &[usize]> {
        self.members.iter().filter(|members| !members.is_empty()).map(Vec::as_slice)
    }

    /// A robot has said something, and all of its group have heard it.
    pub(super) fn heard(&mut self, speaker: usize, message: &Message) {
        let node = match message {
            Message::Node(report) => report.id,
            Message::Spent(spent) => spent.node,
            // Of this round only.
            Message::Pose { .. } | Message::Target(_) => return,
        };
        if self.radio.is_some() {
            let members = self.leader.get(speaker).and_then(|&leader| self.members.get(leader));
            self.log.say(speaker, node, members.map_or(&[], Vec::as_slice));
        }
    }

    /// Robots stand there at this tick. Those that did not hear each other before tell each other what is new to them.
    pub(super) fn listen(&mut self, tick: u64, robots: &[Antenna], stores: &mut [Ssg]) {
        let Some(radio) = &mut self.radio else { return };
        let now = groups(robots.len(), |i, j| radio.joins(tick, [i, j], robots));
        if now == self.leader {
            return;
        }
        let before = std::mem::take(&mut self.leader);
        self.gather(now);
        for members in &self.members {
            let Some((&leader, others)) = members.split_first() else { continue };
            if others.iter().all(|&i| before.get(i) == before.get(leader)) {
                continue;
            }
            for &member in others {
                self.log.tell(stores, member, leader);
            }
            for &member in others {
                self.log.tell(stores, leader, member);
            }
        }
    }

    fn gather(&mut self, leader: Vec<usize>) {
        self.members.resize(leader.len(), Vec::new());
        self.members.iter_mut().for_each(Vec::clear);
        for (i, &leader) in leader.iter().enumerate() {
            self.members[leader].push(i);
        }
        self.leader = leader;
    }
}

/// The radio between robots.
#[derive(Debug)]
pub(super) struct TeamRadio {
    map: Arc<Map>,
    model: Arc<dyn RadioModel>,
    /// What becomes of packets; `None`: all arrive where there is a link.
    channel: Option<Box<dyn Channel<()>>>,
}

impl TeamRadio {
    /// That of an exploration; `None` where all hear all.
    pub(super) fn new(site: &Site, seed: Seed) -> Option<Self> {
        let model = site.radio.clone()?;
        let model = model.seeded(seed).unwrap_or(model);
        let channel = site
            .scenario
            .radio
            .as_ref()
            .map(|radio| channel(seed, 0, radio, &site.scenario.packets, &FaultConfig::default()));
        Some(Self { map: site.map.clone(), model, channel })
    }

    /// Whether two robots hear each other: a packet arrives, and the answer to it.
    fn joins(&mut self, tick: u64, [i, j]: [usize; 2], robots: &[Antenna]) -> bool {
        // Whoever is asked for first: both ways lose the same.
        let (low, high) = (i.min(j), i.max(j));
        let loss_db = finite_db(self.model.loss_db(&self.map, &robots[low], &robots[high]));
        let Some(channel) = &mut self.channel else { return loss_db < NO_LINK_DB };
        let mut arrives = |from: usize, to: usize| {
            let link = Link { from: from as u16, to: to as u16, side: None };
            channel.transfer(link, tick, loss_db, ()).is_some()
        };
        arrives(low, high) && arrives(high, low)
    }
}

/// Per robot the lowest index that messages can come from or go to: connected components, found by looking at all that
/// are left: they are a thousand at most, and it is asked once a round. No two robots are asked for twice.
fn groups(robots: usize, mut joins: impl FnMut(usize, usize) -> bool) -> Vec<usize> {
    let mut group: Vec<usize> = (0..robots).collect();
    // Those that nobody has reached yet, in index order.
    let mut apart: Vec<usize> = group.clone();
    while let Some(&first) = apart.first() {
        let mut open = vec![first];
        apart.remove(0);
        while let Some(i) = open.pop() {
            apart.retain(|&j| {
                let hears = joins(i, j);
                if hears {
                    group[j] = first;
                    open.push(j);
                }
                !hears
            });
        }
    }
    group
}

/// What every robot has said of nodes and arcs, and how much of it every other one has heard: always all up to one
/// moment, for robots that meet leave nothing out.
#[derive(Debug)]
struct Log {
    /// By speaker, the nodes it has spoken of, in order.
    said: Vec<Vec<NodeId>>,
    /// By hearer and speaker, how much of it.
    heard: Vec<Vec<usize>>,
}

impl Log {
    fn new(robots: usize) -> Self {
        Self { said: vec![Vec::new(); robots], heard: vec![vec![0; robots]; robots] }
    }

    fn say(&mut self, speaker: usize, node: NodeId, hearers: &[usize]) {
        self.said[speaker].push(node);
        for &hearer in hearers {
            self.heard[hearer][speaker] = self.said[speaker].len();
        }
    }

    /// One robot tells another one, of all it has heard, what the other has not: the nodes with their labels of now, in
    /// the order in which it came to know them. Labels that fell because of these nodes fall by themselves.
    fn tell(&mut self, stores: &mut [Ssg], from: usize, to: usize) {
        let Some(known) = stores.get(from) else { return };
        let reports: Vec<Message> = self
            .unheard(known, from, to)
            .into_iter()
            .filter_map(|slot| known.report(slot))
            .map(Message::Node)
            .collect();
        for speaker in 0..self.said.len() {
            let upto = self.heard[from][speaker];
            self.heard[to][speaker] = self.heard[to][speaker].max(upto);
        }
        if let Some(store) = stores.get_mut(to) {
            for report in &reports {
                // Where the store is full, so it is.
                let _ = store.apply(report);
            }
        }
    }

    /// Slots of one robot's nodes that it has heard something of and another robot has not, in order.
    fn unheard(&self, known: &Ssg, from: usize, to: usize) -> Vec<usize> {
        let mut new: Vec<usize> = Vec::new();
        for (speaker, said) in self.said.iter().enumerate() {
            let unheard = said.get(self.heard[to][speaker]..self.heard[from][speaker]).unwrap_or_default();
            // What the teller's store had no room for, it cannot tell.
            new.extend(unheard.iter().filter_map(|&id| known.slot(id)));
        }
        new.sort_unstable();
        new.dedup();
        new
    }
}
