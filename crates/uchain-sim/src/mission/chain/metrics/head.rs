//! What the pilot asked of the head, and what came of it.

use std::collections::VecDeque;

use glam::Vec2;

use crate::{
    analyse::{Outcome, Way},
    clock::TICKS_PER_S,
    config::MapConfig,
    mission::chain::{Course, Frame, HeadFrame},
};

/// A head is stuck if within this time (s) …
const STUCK_S: f64 = 10.0;
/// … in which its link allowed it to fly all the time, it came away by less than this share of the way allowed (1).
/// Centering leaves it no less than `center.slow_floor`, 0.2, near walls: half of that has no other cause.
const STUCK_SHARE: f64 = 0.1;
/// Slower than this nobody can be called stuck after so short a time (m/s).
const STUCK_FROM_MPS: f64 = 0.02;
/// What a head may miss of the way asked for and still have arrived: this share (1), but no less than this way (m). Near
/// walls the laws themselves ask for less speed, in bends and narrow tunnels all the way long: over 1,000 seeds each it
/// cost 0 to 24 % in the scenarios that come along.
const MISSED: (f64, f64) = (0.25, 0.5);
/// From here on it is worth a word that the link held back a head that has arrived all the same (m).
const HELD_M: f64 = 0.5;
/// As near to the end of the tunnel as this, in tunnel widths or metres, a head has arrived there: beams ahead of it read
/// the end's wall.
const END: f64 = 1.0;

/// Follows the head. Memory: the places of the last 10 s.
#[derive(Debug, Default)]
pub(super) struct Head {
    /// Whether the frames say what the pilot asked.
    is_known: bool,
    asked_m: f64,
    held_m: f64,
    held_s: f64,
    slowed_m: f64,
    flown_m: f64,
    /// Deeper into the tunnel or back, as the pilot asked last.
    sign: f64,
    depth_m: Option<f64>,
    /// How much it had flown when it was at the end of the tunnel, if it was on its present way (m).
    end_m: Option<f64>,
    /// Places at decisions in which it was allowed to fly one way.
    window: VecDeque<Place>,
    stuck: Option<Stuck>,
}

/// Where it was at a decision.
#[derive(Debug, Clone, Copy)]
struct Place {
    time_s: f64,
    at: Vec2,
    /// Way allowed since the window's begin (m).
    allowed_m: f64,
}

/// A head that stayed where it was.
#[derive(Debug, Clone, Copy)]
struct Stuck {
    from_s: f64,
    /// For how long, all in all (s).
    all_s: f64,
    at: Vec2,
    until_s: f64,
}

impl Head {
    /// One tick.
    pub(super) fn look(&mut self, frame: &Frame, course: &Course) {
        let Some(head) = frame.head else {
            self.window.clear();
            return;
        };
        let v_max_mps = course.scenario.equalize.v_max_mps;
        let pilot_mps = f64::from(head.pilot_mps.max(-v_max_mps).min(v_max_mps));
        self.is_known = true;
        if pilot_mps != 0.0 && pilot_mps.signum() != self.sign {
            self.sign = pilot_mps.signum();
            self.end_m = None;
        } else if self.sign == 0.0 {
            self.sign = 1.0;
        }
        self.reckon(&head, pilot_mps);
        if frame.decision {
            self.decision(frame, &head, course);
        }
    }

    /// Where a tick's way went.
    fn reckon(&mut self, head: &HeadFrame, pilot_mps: f64) {
        let along_m = |mps: f64| self.sign * mps / TICKS_PER_S;
        let (wish_m, allowed_m) = (along_m(pilot_mps), along_m(head.allowed_mps.into()));
        let slowed_m = allowed_m - along_m(head.asked_mps.into());
        let held_m = wish_m - allowed_m;
        self.asked_m += wish_m;
        self.slowed_m += slowed_m;
        self.held_m += held_m;
        // Speeds are single, and rounded.
        self.held_s += if held_m > 1e-6 { 1.0 / TICKS_PER_S } else { 0.0 };
    }

    fn decision(&mut self, frame: &Frame, head: &HeadFrame, course: &Course) {
        let Some(uav) = frame.uavs.get(frame.leader) else { return };
        let at = Vec2::new(uav.x_m, uav.y_m);
        let depth_m = match &course.tunnel {
            Some(tunnel) => tunnel.depth_m(at),
            None => f64::from(frame.head_reach_m),
        };
        if let Some(before_m) = self.depth_m.replace(depth_m) {
            self.flown_m += self.sign * around(course, depth_m - before_m);
        }
        if self.is_at_the_end(course) {
            self.end_m = Some(self.end_m.map_or(self.flown_m, |end_m| end_m.max(self.flown_m)));
        }
        self.wait(
            frame.time_s(),
            at,
            f64::from(head.allowed_mps),
            course.scenario.equalize.decision_s.into(),
        );
    }

    /// Whether it stays where it is although it may fly.
    fn wait(&mut self, time_s: f64, at: Vec2, allowed_mps: f64, period_s: f64) {
        let goes_on = allowed_mps * self.sign >= STUCK_FROM_MPS;
        if !goes_on {
            self.window.clear();
            return;
        }
        let before_m = self.window.back().map_or(0.0, |place| place.allowed_m);
        self.window.push_back(Place { time_s, at, allowed_m: before_m + allowed_mps.abs() * period_s });
        while self.window.get(1).is_some_and(|second| time_s - second.time_s >= STUCK_S) {
            self.window.pop_front();
        }
        let Some(first) = self.window.front().filter(|first| time_s - first.time_s >= STUCK_S) else {
            return;
        };
        let away_m = f64::from(first.at.distance(at));
        if away_m >= STUCK_SHARE * (before_m + allowed_mps.abs() * period_s - first.allowed_m) {
            return;
        }
        let stuck =
            self.stuck.get_or_insert(Stuck { from_s: first.time_s, all_s: 0.0, at, until_s: first.time_s });
        if stuck.until_s < first.time_s {
            stuck.from_s = first.time_s;
            stuck.until_s = first.time_s;
        }
        stuck.all_s += time_s - stuck.until_s;
        (stuck.until_s, stuck.at) = (time_s, at);
    }

    /// What it was asked for, and what came; `None` where the frames do not say.
    pub(super) fn way(&self) -> Option<Way> {
        let (asked_m, flown_m) = (self.asked_m, self.end_m.unwrap_or(self.flown_m));
        self.is_known.then_some(Way { asked_m, flown_m, is_end: self.end_m.is_some() })
    }

    /// Whether the tunnel goes no deeper.
    fn is_at_the_end(&self, course: &Course) -> bool {
        let Some(tunnel) = course.tunnel.as_ref().filter(|_| !is_ring(course)) else { return false };
        let width_m = match &course.scenario.map {
            MapConfig::Corridor(corridor) => corridor.width_m.max(END),
            _ => END,
        };
        self.sign > 0.0 && self.depth_m.is_some_and(|depth_m| depth_m >= tunnel.length_m() - width_m)
    }

    /// Why it is not where its pilot asked it to be, if it is not.
    pub(super) fn finding(&self, course: &Course) -> Option<Outcome> {
        let way = self.way().filter(|way| !way.is_end)?;
        let Self { held_m, held_s, slowed_m, .. } = *self;
        if let Some(Stuck { from_s, all_s, at, .. }) = self.stuck {
            let [east_m, north_m] = course.map.offset_m();
            let at_m = [f64::from(at.x) + east_m, f64::from(at.y) + north_m];
            return Some(Outcome::HeadStuck { way, from_s, stuck_s: all_s, at_m });
        }
        let missed_m = way.asked_m - way.flown_m;
        if missed_m <= (MISSED.0 * way.asked_m).max(MISSED.1) {
            return None;
        }
        // What neither link nor walls account for is the tunnel's doing, or the law's.
        let other_m = missed_m - held_m;
        Some(if held_m >= other_m {
            Outcome::HeadHeld { way, held_m, held_s }
        } else {
            Outcome::HeadShort { way, slowed_m }
        })
    }

    /// What is worth a word besides.
    pub(super) fn remark(&self) -> Option<String> {
        let Self { held_m, held_s, .. } = self;
        (*held_m > HELD_M).then(|| format!("its link held the head back for {held_s:.1} s, {held_m:.1} m"))
    }
}

fn is_ring(course: &Course) -> bool {
    course.tunnel.as_ref().is_some_and(|tunnel| tunnel.line().is_closed())
}

/// A step along the tunnel, the short way round a ring (m).
fn around(course: &Course, step_m: f64) -> f64 {
    let Some(tunnel) = course.tunnel.as_ref().filter(|_| is_ring(course)) else { return step_m };
    let round_m = f64::from(tunnel.line().length_m());
    step_m - round_m * (step_m / round_m).round()
}
