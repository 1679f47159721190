//! The broad phase: who could touch something within the coming tick. Only they need a solver.
//!
//! Every body carries the distance it can fly before that question has to be asked again (conservative advancement). It
//! is spent as the body moves; two bodies share the gap between them. So hardly anybody is looked at in a tick.

use super::{Body, MotionParams, NeighbourGrid};
use crate::{clock::TICK_S, map::Map};

/// Slack of "within reach" over what one tick's motion can close (m), …
const SLACK_M: f32 = 0.01;
/// … and over the largest coordinate (m/m): a place that is rounded can be off by so much, and move by so much more.
const ROUNDING_PER_M: f32 = 2.0 * f32::EPSILON;
/// Farthest a body may fly unasked (m): it bounds how far its neighbours have to be looked for.
const ROAM_MAX_M: f32 = 0.5;
/// More than rounding can add to a distance flown (m).
const ROUNDING_M: f32 = 1e-4;

/// Who goes through the solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::world) enum Solved {
    /// Those who are near something.
    Near,
    /// Everybody in the air, always: the slow way, and the measure of the other.
    Everybody,
    /// Nobody, ever: what a test of the broad phase must notice.
    #[cfg(test)]
    Nobody,
}

/// Everybody's distance to go, and who is near something now.
#[derive(Debug)]
pub(in crate::world) struct BroadPhase {
    /// How far each can fly before it could come within reach of a contact (m).
    roam_m: Vec<f32>,
    near: Vec<bool>,
    /// The near ones in ascending order, now and a tick ago.
    list: Vec<u32>,
    before: Vec<u32>,
    /// Pairs within reach of each other, ascending, lower index first.
    pairs: Vec<(u32, u32)>,
    due: Vec<u32>,
    solved: Solved,
}

impl BroadPhase {
    pub(super) fn new(count: usize, solved: Solved) -> Self {
        Self {
            roam_m: vec![0.0; count],
            near: vec![false; count],
            list: Vec::with_capacity(count),
            before: Vec::with_capacity(count),
            pairs: Vec::with_capacity(count),
            due: Vec::with_capacity(count),
            solved,
        }
    }

    /// Farthest a body looks for others.
    pub(in crate::world) fn reach_m(params: &MotionParams) -> f32 {
        2.0 * (params.radius_m + ROAM_MAX_M) + SLACK_M
    }

    /// Whether this one could touch something within the coming tick.
    pub(super) fn is_near(&self, body: usize) -> bool {
        self.near[body]
    }

    /// All who could, ascending.
    pub(super) fn near(&self) -> &[u32] {
        &self.list
    }

    /// Those who could a tick ago, ascending.
    pub(super) fn near_before(&self) -> &[u32] {
        &self.before
    }

    /// All pairs that could touch each other, ascending.
    pub(super) fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// Nobody has been asked yet.
    pub(super) fn reset(&mut self) {
        self.roam_m.fill(0.0);
        self.near.fill(false);
        for list in [&mut self.list, &mut self.before, &mut self.due] {
            list.clear();
        }
        self.pairs.clear();
    }

    /// Looks ahead over the coming tick.
    pub(super) fn look(&mut self, map: &Map, neighbours: &NeighbourGrid, bodies: &[Body], radius_m: f32) {
        core::mem::swap(&mut self.list, &mut self.before);
        self.list.clear();
        self.due.clear();
        self.pairs.clear();
        for &body in &self.before {
            self.near[body as usize] = false;
        }
        for (i, body) in bodies.iter().enumerate() {
            if body.airborne && (self.solved == Solved::Everybody || self.roam_m[i] < stride_m(body)) {
                self.due.push(i as u32);
            }
        }
        for k in 0..self.due.len() {
            self.ask(self.due[k] as usize, map, neighbours, bodies, radius_m);
        }
        if !self.list.is_empty() {
            self.list.sort_unstable();
            self.pairs.sort_unstable();
            self.pairs.dedup();
        }
    }

    fn ask(&mut self, i: usize, map: &Map, neighbours: &NeighbourGrid, bodies: &[Body], radius_m: f32) {
        let body = &bodies[i];
        let stride_i_m = stride_m(body);
        let slack_m = SLACK_M + ROUNDING_PER_M * body.at.abs().max_element();
        // Walls are in no waypoint's way: whoever flies to one is looked at for the others' sake only.
        let wall_gap_m =
            if body.kinematic { f32::INFINITY } else { map.clearance_m(body.at) - radius_m - slack_m };
        if self.solved == Solved::Everybody || wall_gap_m < stride_i_m {
            self.mark(i);
        }
        // Who is nowhere (NaN) is asked in every tick.
        let roomy = wall_gap_m > ROUNDING_M;
        let mut roam_m = if roomy { (wall_gap_m - ROUNDING_M).min(ROAM_MAX_M) } else { 0.0 };
        let reach_m = 2.0 * radius_m + slack_m + ROAM_MAX_M + stride_i_m.max(ROAM_MAX_M);
        let others = neighbours.near(body.at, reach_m).filter(|(j, _)| *j != i);
        for (j, at) in others.filter(|(j, _)| solves(body, &bodies[*j])) {
            let gap_m = at.distance(body.at) - 2.0 * radius_m - slack_m;
            if gap_m < stride_i_m + stride_m(&bodies[j]) {
                self.mark(i);
                self.mark(j);
                self.pairs.push((i.min(j) as u32, i.max(j) as u32));
            }
            // What the other one has left of the gap, at most half of it, is its own.
            let gap_m = (gap_m - ROUNDING_M).max(0.0);
            self.roam_m[j] = self.roam_m[j].min(0.5 * gap_m);
            roam_m = roam_m.min(gap_m - self.roam_m[j]);
        }
        self.roam_m[i] = roam_m;
    }

    fn mark(&mut self, body: usize) {
        #[cfg(test)]
        if self.solved == Solved::Nobody {
            return;
        }
        if !self.near[body] {
            self.near[body] = true;
            self.list.push(body as u32);
        }
    }

    /// A body has flown this far.
    pub(super) fn spend(&mut self, body: usize, flown_m: f32) {
        self.roam_m[body] -= flown_m;
    }

    /// A body has been where this broad phase does not know: it is asked once it moves.
    pub(super) fn forget(&mut self, body: usize) {
        self.roam_m[body] = 0.0;
    }

    /// A body is in others' way who do not know of it yet: it is asked in the next tick, moving or not.
    pub(super) fn ask_next(&mut self, body: usize) {
        self.roam_m[body] = -1.0;
    }
}

/// Whether a pair's contacts are a solver's: on one level, with at least one that can be pushed.
fn solves(a: &Body, b: &Body) -> bool {
    a.level_m == b.level_m && !(a.kinematic && b.kinematic)
}

/// How far a body flies in the coming tick if nothing stops it (m).
fn stride_m(body: &Body) -> f32 {
    body.velocity_mps.length() * TICK_S
}
