//! Who could touch something within the coming tick: only they need a solver.
//!
//! Every UAV carries the distance it can fly before that question has to be asked again. It is spent as the UAV
//! moves; two UAVs share the gap between them. So hardly anybody is looked at in a tick.

use super::{Body, MotionParams, crowd::Crowd};
use crate::{clock::TICK_S, map::Map};

/// Slack of "within reach" over what one tick's motion can close (m), …
const SLACK_M: f32 = 0.01;
/// … and over the largest coordinate (m/m): a place that is rounded can be off by so much, and move by so much more.
const ROUNDING_PER_M: f32 = 2.0 * f32::EPSILON;
/// Farthest a UAV may fly unasked (m): it bounds how far its neighbours have to be looked for.
const ROAM_MAX_M: f32 = 0.5;
/// More than rounding can add to a distance flown (m).
const ROUNDING_M: f32 = 1e-4;

/// Who goes through the solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GateMode {
    /// Those who are near something.
    Near,
    /// Everybody in the air, always: the slow way, and the measure of the other.
    Open,
    /// Nobody, ever: what a test of the gate must notice.
    #[cfg(test)]
    Shut,
}

/// Everybody's distance to go, and who is near something now.
#[derive(Debug)]
pub(super) struct Gate {
    /// How far each can fly before it could come within reach of a contact (m).
    roam_m: Vec<f32>,
    near: Vec<bool>,
    /// The near ones in ascending order, now and a tick ago.
    list: Vec<u32>,
    before: Vec<u32>,
    /// Pairs within reach of each other, ascending, lower index first.
    pairs: Vec<(u32, u32)>,
    due: Vec<u32>,
    mode: GateMode,
}

impl Gate {
    pub(super) fn new(count: usize, mode: GateMode) -> Self {
        Self {
            roam_m: vec![0.0; count],
            near: vec![false; count],
            list: Vec::with_capacity(count),
            before: Vec::with_capacity(count),
            pairs: Vec::with_capacity(count),
            due: Vec::with_capacity(count),
            mode,
        }
    }

    /// Farthest a UAV looks for others.
    pub(super) fn reach_m(params: &MotionParams) -> f32 {
        2.0 * (params.radius_m + ROAM_MAX_M) + SLACK_M
    }

    /// Whether this one could touch something within the coming tick.
    pub(super) fn is_near(&self, uav: usize) -> bool {
        self.near[uav]
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

    /// Looks ahead over the coming tick.
    pub(super) fn look(&mut self, map: &Map, crowd: &Crowd, bodies: &[Body], radius_m: f32) {
        core::mem::swap(&mut self.list, &mut self.before);
        self.list.clear();
        self.due.clear();
        self.pairs.clear();
        for &uav in &self.before {
            self.near[uav as usize] = false;
        }
        for (i, body) in bodies.iter().enumerate() {
            if body.airborne && (self.mode == GateMode::Open || self.roam_m[i] < stride_m(body)) {
                self.due.push(i as u32);
            }
        }
        for k in 0..self.due.len() {
            self.ask(self.due[k] as usize, map, crowd, bodies, radius_m);
        }
        if !self.list.is_empty() {
            self.list.sort_unstable();
            self.pairs.sort_unstable();
            self.pairs.dedup();
        }
    }

    fn ask(&mut self, i: usize, map: &Map, crowd: &Crowd, bodies: &[Body], radius_m: f32) {
        let body = &bodies[i];
        let stride_i_m = stride_m(body);
        let slack_m = SLACK_M + ROUNDING_PER_M * body.at.abs().max_element();
        let wall_gap_m = map.clearance_m(body.at) - radius_m - slack_m;
        if self.mode == GateMode::Open || wall_gap_m < stride_i_m {
            self.mark(i);
        }
        // Who is nowhere (NaN) is asked in every tick.
        let roomy = wall_gap_m > ROUNDING_M;
        let mut roam_m = if roomy { (wall_gap_m - ROUNDING_M).min(ROAM_MAX_M) } else { 0.0 };
        let reach_m = 2.0 * radius_m + slack_m + ROAM_MAX_M + stride_i_m.max(ROAM_MAX_M);
        for (j, at) in crowd.near(body.at, reach_m).filter(|(j, _)| *j != i) {
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

    fn mark(&mut self, uav: usize) {
        #[cfg(test)]
        if self.mode == GateMode::Shut {
            return;
        }
        if !self.near[uav] {
            self.near[uav] = true;
            self.list.push(uav as u32);
        }
    }

    /// A UAV has flown this far.
    pub(super) fn spend(&mut self, uav: usize, flown_m: f32) {
        self.roam_m[uav] -= flown_m;
    }

    /// A UAV has been where this gate does not know: it is asked in the next tick.
    pub(super) fn forget(&mut self, uav: usize) {
        self.roam_m[uav] = 0.0;
    }
}

/// How far a body flies in the coming tick if nothing stops it (m).
fn stride_m(body: &Body) -> f32 {
    body.velocity_mps.length() * TICK_S
}
