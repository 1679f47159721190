//! Who chooses where to fly: a function of what a robot knows to a goal.

mod baseline;
mod comparators;
mod kind;
mod target;
#[cfg(test)]
mod tests;

use alloc::boxed::Box;
use core::fmt::Debug;

pub use baseline::RandomFrontier;
pub use comparators::{NearestFrontier, Utility};
pub use kind::StrategyKind;
pub use target::{Cssg, Taken};

use super::{
    Dijkstra, ExploreParams, NodeId, Point, Pose, Run, Sector, Ssg, Target, runs, ssg::middle_sectors,
};

/// Where one robot flies from a node, decided from all that it knows. It may remember what it has decided: every robot
/// has its own. The same decisions from the same views are what makes a run repeatable, so whatever is random is drawn
/// from [`View::draw`].
///
/// [`Cssg`], [`RandomFrontier`], [`NearestFrontier`] and [`Utility`] are built in. A program's own gets its word in
/// scenarios by a [`StrategyKind`].
pub trait Strategy: CloneStrategy + Debug + Send + Sync {
    /// Where to go from a node. A place for a new node that is refused, because a node stands there, is spent, and the
    /// robot asks again.
    fn goal(&mut self, view: &mut View<'_>) -> Goal;
}

/// Copies of a boxed strategy, memory and all: every [`Strategy`] that is [`Clone`] has them.
pub trait CloneStrategy {
    /// A copy.
    fn boxed(&self) -> Box<dyn Strategy>;
}

impl<T: Strategy + Clone + 'static> CloneStrategy for T {
    fn boxed(&self) -> Box<dyn Strategy> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Strategy> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// What a strategy decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// A new node, seen from the node the robot is at.
    Frontier(Candidate),
    /// A known node, by slot, along the graph.
    Node(usize),
    /// The robot's first node, along the graph.
    Home,
}

/// A place for a new node (Kim 2021, §6.1.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The place.
    pub at: Point,
    /// Its direction from the inertial x axis, `θ_F` (rad).
    pub direction_rad: f32,
    /// The merged sectors it stands for.
    pub run: Run,
    /// The one or two sectors flown along: the middle of the run. Twice the same for one.
    pub sectors: [u16; 2],
}

impl Candidate {
    /// The place for a new node that merged sectors of a known node give, to a robot with this heading (rad).
    pub fn of(ssg: &Ssg, slot: usize, heading_rad: f32, run: Run) -> Option<Self> {
        let (cones, sectors, from) = (ssg.cones(), ssg.sectors(slot), ssg.at(slot)?);
        let n = cones.count();
        let radius_m = |k: usize| sectors.get(k).map_or(0.0, |s| s.r_m);
        let half = run.middle_half(n);
        if run.count < n {
            let sectors = middle_sectors(half, n);
            let reach_m = ssg.params().alpha * radius_m(sectors[0]).min(radius_m(sectors[1]));
            let direction_rad = cones.angle_rad(half);
            let at = cones.point(from, half, reach_m);
            let sectors = sectors.map(|k| k as u16);
            return Some(Self { at, direction_rad, run, sectors });
        }
        // Frontiers all around have no middle: straight on.
        let direction_rad = if heading_rad.is_finite() { heading_rad } else { 0.0 };
        let k = cones.facing_rad(direction_rad);
        let reach_m = ssg.params().alpha * radius_m(k);
        let at = Point {
            x_m: from.x_m + reach_m * libm::cosf(direction_rad),
            y_m: from.y_m + reach_m * libm::sinf(direction_rad),
        };
        Some(Self { at, direction_rad, run, sectors: [k as u16; 2] })
    }
}

/// Another robot, as far as it has been heard.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mate {
    /// Where it last said it was.
    pub at: Option<Point>,
    /// What it has said it will fly this round.
    pub target: Option<Target>,
}

/// All that a robot knows at a node, and its ways from there.
pub struct View<'a> {
    /// What is known of the place.
    pub ssg: &'a Ssg,
    /// The robot.
    pub robot: u16,
    /// Slot of the node it is at.
    pub here: usize,
    /// Where it believes it is.
    pub pose: Pose,
    /// The team by index; its own entry is empty.
    pub mates: &'a [Mate],
    /// The hub it was on its way to.
    pub previous: Option<NodeId>,
    /// Room for searches.
    pub routes: &'a mut Dijkstra,
    /// Uniformly random bits, from the robot's own stream.
    pub draw: &'a mut dyn FnMut() -> u32,
}

impl Debug for View<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("View").field("robot", &self.robot).field("here", &self.here).finish_non_exhaustive()
    }
}

impl View<'_> {
    /// What the team flies by.
    pub fn params(&self) -> &ExploreParams {
        self.ssg.params()
    }

    /// The sectors of the node the robot is at.
    pub fn sectors(&self) -> &[Sector] {
        self.ssg.sectors(self.here)
    }

    /// The merged frontiers here, as places for new nodes; by first sector.
    pub fn merged(&self) -> impl Iterator<Item = Candidate> + '_ {
        runs(self.sectors()).filter_map(|run| self.candidate(run))
    }

    /// The place for a new node that merged sectors here give (Kim 2021, §6.1.1 and §6.1.2).
    pub fn candidate(&self, run: Run) -> Option<Candidate> {
        Candidate::of(self.ssg, self.here, self.pose.heading_rad, run)
    }

    /// What the others, as far as heard, will fly this round.
    pub fn taken(&self) -> impl Iterator<Item = &Target> + '_ {
        self.others().filter_map(|mate| mate.target.as_ref())
    }

    /// The others.
    pub fn others(&self) -> impl Iterator<Item = &Mate> + '_ {
        let own = usize::from(self.robot);
        self.mates.iter().enumerate().filter(move |(i, _)| *i != own).map(|(_, mate)| mate)
    }

    /// The nearest other hub of the robot's own, else of the others', else home (Kim 2021, Algorithm 2, lines 5–15).
    /// Hubs that no way leads to do not count.
    pub fn backtrack(&mut self) -> Goal {
        let (ssg, robot, here) = (self.ssg, self.robot, self.here);
        let hub_of = |slot: usize, own: bool| {
            let mine = ssg.id(slot).is_some_and(|id| id.robot == robot);
            slot != here && ssg.is_hub(slot) && mine == own
        };
        let mut hub = None;
        if ssg.hubs_of(robot) > 0 {
            hub = self.nearest(|slot| hub_of(slot, true));
        }
        if hub.is_none() && ssg.has_hubs() {
            hub = self.nearest(|slot| hub_of(slot, false));
        }
        hub.map_or(Goal::Home, Goal::Node)
    }

    /// The nearest node of a kind by the graph, by slot. Of those within `tie_m` the previous hub is taken, else the
    /// lowest node.
    pub fn nearest(&mut self, wanted: impl Fn(usize) -> bool) -> Option<usize> {
        let (ssg, previous, tie_m) = (self.ssg, self.previous, self.ssg.params().tie_m);
        let mut limit_m = f32::INFINITY;
        let mut best: Option<(bool, NodeId, usize)> = None;
        self.routes.search(ssg.graph(), self.here, |slot, distance_m| {
            if distance_m > limit_m {
                return true;
            }
            if let Some(id) = ssg.id(slot).filter(|_| wanted(slot)) {
                limit_m = limit_m.min(distance_m + tie_m);
                let found = (previous != Some(id), id, slot);
                best = Some(best.map_or(found, |best| best.min(found)));
            }
            false
        });
        best.map(|(_, _, slot)| slot)
    }
}
