//! A team that explores: its robots, what each of them knows, and who hears whom.

mod connectivity;
mod graph_diff;

use uchain_core::explore::{
    Command, ExploreParams, Explorer, Message, Observation, Purpose, Refusal, Ssg, Target, rule,
};

use crate::{
    mission::{Stopped, explore::Site},
    radio::Antenna,
    seed::{Seed, Source, Stream},
};
use connectivity::{Connectivity, TeamRadio};
pub(crate) use graph_diff::GraphDiff;

/// All brains of an exploration. Where all hear all, one store serves them all; otherwise each has its own.
#[derive(Debug)]
pub struct Team {
    params: ExploreParams,
    explorers: Vec<Explorer>,
    draws: Vec<Stream>,
    connectivity: Connectivity,
    /// One for all, or one each.
    stores: Vec<Ssg>,
    /// All that any robot knows, if stores are not shared. Nobody reads it but the record.
    whole: Option<Ssg>,
    /// By speaker.
    said: Vec<Vec<Message>>,
    targets: Vec<Target>,
    commands: Vec<Command>,
    diff: GraphDiff,
}

impl Team {
    /// A team before its first scan.
    pub fn new(site: &Site, seed: Seed) -> Self {
        let scenario = &site.scenario;
        let robots = scenario.team.robots;
        let count = usize::from(robots);
        let empty = site.empty_store();
        let mut noted = empty.clone();
        noted.note_freed();
        let radio = TeamRadio::new(site, seed);
        let shared = radio.is_none();
        Self {
            params: scenario.params.clone(),
            explorers: (0..robots).map(|i| Explorer::new(i, robots)).collect(),
            draws: (0..u32::from(robots)).map(|i| seed.stream(i, Source::Choice)).collect(),
            connectivity: Connectivity::new(count, radio),
            whole: (!shared).then(|| noted.clone()),
            stores: if shared { vec![noted] } else { vec![empty.clone(); count] },
            said: vec![Vec::new(); count],
            targets: Vec::with_capacity(count),
            commands: Vec::with_capacity(count),
            diff: GraphDiff::default(),
        }
    }

    /// All that any robot knows.
    pub fn whole(&self) -> &Ssg {
        self.whole.as_ref().unwrap_or(&self.stores[0])
    }

    /// What this round has added to it.
    pub(crate) fn diff(&self) -> &GraphDiff {
        &self.diff
    }

    /// What the robots will fly, as they have said this round.
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// What the robots ask for this round; nothing if it is over.
    pub fn commands(&self) -> &[Command] {
        &self.commands
    }

    /// One round (Kim 2021, Algorithm 2), by what every robot sees and by where their antennas truly are at this tick, which
    /// decides who hears whom.
    /// A reason if there is nothing left to fly.
    pub fn round(
        &mut self,
        tick: u64,
        robots: &[super::Observation],
        antennas: &[Antenna],
    ) -> Option<Stopped> {
        self.connectivity.listen(tick, antennas, &mut self.stores);
        self.commands.clear();
        for (i, robot) in robots.iter().enumerate().take(self.explorers.len()) {
            let seen = Observation { pose: robot.pose, arrived: true, scan: robot.scan.as_deref() };
            let store = store_of(&mut self.stores, i);
            match self.explorers[i].perceive(store, &seen, &mut self.said[i]) {
                // A team of checked parameters has no strangers and no odd stars. A robot that believes to be beyond
                // all maps makes no node; it waits, and the run ends in words.
                Ok(())
                | Err(
                    Refusal::Full { .. }
                    | Refusal::Stranger { .. }
                    | Refusal::Sectors { .. }
                    | Refusal::Place,
                ) => {}
            }
        }
        // Only when all have looked around does anybody hear of it.
        for i in 0..self.explorers.len() {
            self.deliver(i);
        }
        self.targets.clear();
        for i in 0..self.explorers.len() {
            let draw = &mut self.draws[i];
            let store = store_of(&mut self.stores, i);
            let target = self.explorers[i].announce(store, &mut || draw.bits(), &mut self.said[i]);
            self.targets.push(target);
            self.deliver(i);
        }
        self.diff.update(self.whole.as_mut().unwrap_or(&mut self.stores[0]));
        self.resolve_conflicts();
        self.over()
    }

    /// What a robot has just said goes to all that hear it.
    fn deliver(&mut self, speaker: usize) {
        for message in self.said[speaker].drain(..) {
            for &i in self.connectivity.group_of(speaker) {
                self.explorers[i].hear(&message);
            }
            self.connectivity.heard(speaker, &message);
            // A shared store has taken it in from its speaker.
            if let Some(whole) = &mut self.whole {
                // Refused by one, refused by all.
                let _ = whole.apply(&message);
                for &i in self.connectivity.group_of(speaker) {
                    let _ = self.stores[i].apply(&message);
                }
            }
        }
    }

    /// Conflicts are resolved among those that hear each other: nobody gives way to whom it does not hear.
    fn resolve_conflicts(&mut self) {
        let mut rulings = vec![None; self.explorers.len()];
        for group in self.connectivity.groups() {
            let targets: Vec<Target> = group.iter().map(|&i| self.targets[i]).collect();
            for (&i, ruling) in group.iter().zip(rule(&targets, &self.params)) {
                rulings[i] = Some(ruling);
            }
        }
        for (explorer, ruling) in self.explorers.iter_mut().zip(rulings) {
            self.commands.push(match ruling {
                Some(ruling) => explorer.follow_ruling(ruling, &self.params),
                None => explorer.resolve(&self.params),
            });
        }
    }

    fn over(&self) -> Option<Stopped> {
        if self.targets.iter().all(|target| target.purpose == Purpose::Park) {
            return Some(match (self.whole().has_hubs(), self.whole().is_full()) {
                (false, _) => Stopped::Explored,
                (true, false) => Stopped::Unreachable,
                (true, true) => Stopped::Full,
            });
        }
        let stays = |command: &Command, target: &Target| command.to == target.from;
        let all_stay =
            self.commands.iter().zip(&self.targets).all(|(command, target)| stays(command, target));
        all_stay.then_some(Stopped::Stuck)
    }
}

fn store_of(stores: &mut [Ssg], robot: usize) -> &mut Ssg {
    let last = stores.len() - 1;
    &mut stores[robot.min(last)]
}
