//! How near robots come to each other: beside, above and below.

use glam::DVec3;
use serde::Serialize;

use crate::{clock::time_s, mission::explore::RobotFrame};

/// What was least between two robots over time, middle to middle. One is *below* the other if it is lower by more than
/// two radii; else they are *beside* each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Gap {
    /// The two, lower index first.
    pub robots: [u16; 2],
    /// Least distance through the air (m).
    pub least_m: f64,
    /// Least distance over ground while they were beside each other (m); `None` if they never were.
    pub beside_m: Option<f64>,
    /// Least difference of heights while one was in the downwash of the other (m): below it, and no farther over
    /// ground than the downwash's radius; `None` if none ever was.
    pub below_m: Option<f64>,
    /// How long one was in the downwash of the other (s).
    pub downwash_s: f64,
}

/// More than rounding makes of distances and of sums of ways (m).
const ROUNDING_M: f64 = 1e-5;
/// Pairs that are asked at once whether one of them is due.
const AT_ONCE: usize = 16;

/// Watches all pairs. A pair is looked at again once one of its two has climbed or sunk, or both have flown far enough to
/// come nearer to each other than they ever were, or into the downwash or out of it: of many robots few pairs are due in
/// a tick, and none whose two rest.
#[derive(Debug)]
pub(super) struct Gaps {
    body_m: f64,
    downwash_m: f64,
    /// Ticks so far.
    ticks: u64,
    pairs: Vec<Pair>,
    /// By pair, the sum of its two's ways beyond which it is due (m).
    due_m: Vec<f64>,
    /// Per robot, its way over ground so far (m).
    flown_m: Vec<f64>,
    /// The same, but infinite for those that changed their height in this tick: all their pairs are due.
    reach_m: Vec<f64>,
    /// Where robots were in the last tick.
    at: Vec<DVec3>,
    /// Who moved in this tick, lowest index first.
    movers: Vec<usize>,
    /// Per robot, ticks in anybody's downwash.
    under: Vec<u64>,
    /// Per robot, how many it has above it now.
    above: Vec<u32>,
}

/// The same, while it is counted.
#[derive(Debug, Clone, Copy)]
struct Pair {
    least_m: f64,
    beside_m: f64,
    below_m: f64,
    /// Ticks in the downwash, but for the stay that lasts.
    ticks: u64,
    /// Who of the two is in the downwash of the other now.
    lower: Option<u16>,
    /// Ticks that had passed when that began.
    since: u64,
}

impl Pair {
    /// Ticks in the downwash, when so many have passed.
    fn ticks(&self, now: u64) -> u64 {
        self.ticks + self.lower.map_or(0, |_| now - self.since)
    }
}

impl Gaps {
    /// For robots of a radius, with a downwash of a radius (m).
    pub(super) fn new(robots: u16, r_body_m: f32, downwash_m: f32) -> Self {
        let robots = usize::from(robots);
        let far = Pair {
            least_m: f64::INFINITY,
            beside_m: f64::INFINITY,
            below_m: f64::INFINITY,
            ticks: 0,
            lower: None,
            since: 0,
        };
        let pairs = vec![far; robots * robots.saturating_sub(1) / 2];
        Self {
            body_m: 2.0 * f64::from(r_body_m),
            downwash_m: downwash_m.into(),
            ticks: 0,
            due_m: vec![f64::NEG_INFINITY; pairs.len()],
            pairs,
            flown_m: vec![0.0; robots],
            reach_m: vec![0.0; robots],
            at: Vec::with_capacity(robots),
            movers: Vec::with_capacity(robots),
            under: vec![0; robots],
            above: vec![0; robots],
        }
    }

    /// One tick has passed.
    pub(super) fn look(&mut self, robots: &[RobotFrame]) {
        if robots.len() < self.under.len() {
            return;
        }
        self.go(robots);
        let mut first = 0;
        let mut moved = 0;
        for j in 0..self.under.len() {
            if self.movers.get(moved) == Some(&j) {
                moved += 1;
                self.look_at_pairs_of(j, first);
            } else {
                for before in 0..moved {
                    let i = self.movers[before];
                    if is_due(self.reach_m[i] + self.reach_m[j], self.due_m[first + i]) {
                        self.look_at(i, j, first + i);
                    }
                }
            }
            first += j;
        }
        self.ticks += 1;
        for (under, &above) in self.under.iter_mut().zip(&self.above) {
            *under += u64::from(above > 0);
        }
    }

    /// Robots are at other places now.
    fn go(&mut self, robots: &[RobotFrame]) {
        let place = |robot: &RobotFrame| DVec3::new(robot.x_m.into(), robot.y_m.into(), robot.z_m.into());
        self.movers.clear();
        if self.at.is_empty() {
            self.at.extend(robots.iter().take(self.under.len()).map(place));
            self.movers.extend(0..self.at.len());
            return;
        }
        for (i, (at, robot)) in self.at.iter_mut().zip(robots).enumerate() {
            let way = place(robot) - *at;
            self.reach_m[i] = self.flown_m[i];
            if way == DVec3::ZERO {
                continue;
            }
            *at = place(robot);
            self.movers.push(i);
            self.flown_m[i] += way.truncate().length();
            self.reach_m[i] = if way.z == 0.0 { self.flown_m[i] } else { f64::INFINITY };
        }
    }

    /// The pairs of a robot with those before it, the first of which has this number.
    fn look_at_pairs_of(&mut self, j: usize, first: usize) {
        let own_m = self.reach_m[j];
        for from in (0..j).step_by(AT_ONCE) {
            let upto = (from + AT_ONCE).min(j);
            let pairs = self.reach_m[from..upto].iter().zip(&self.due_m[first + from..first + upto]);
            // Without an early exit, several are compared in one step.
            if !pairs.map(|(m, due_m)| is_due(m + own_m, *due_m)).fold(false, |any, due| any | due) {
                continue;
            }
            for i in from..upto {
                if is_due(self.reach_m[i] + own_m, self.due_m[first + i]) {
                    self.look_at(i, j, first + i);
                }
            }
        }
    }

    fn look_at(&mut self, i: usize, j: usize, index: usize) {
        let (way, pair) = (self.at[j] - self.at[i], &mut self.pairs[index]);
        let (over_m, up_m) = (way.truncate().length(), way.z.abs());
        pair.least_m = pair.least_m.min(way.length());
        let beside = up_m <= self.body_m;
        let mut lower = None;
        if beside {
            pair.beside_m = pair.beside_m.min(over_m);
        } else if over_m <= self.downwash_m {
            pair.below_m = pair.below_m.min(up_m);
            lower = Some(if way.z > 0.0 { i } else { j } as u16);
        }
        if lower != pair.lower {
            if let Some(was) = pair.lower {
                self.above[usize::from(was)] -= 1;
            }
            if let Some(is) = lower {
                self.above[usize::from(is)] += 1;
            }
            pair.ticks = pair.ticks(self.ticks);
            (pair.lower, pair.since) = (lower, self.ticks);
        }
        // While both keep their heights: how far they may fly until they can be nearer to each other than ever. Nothing
        // is nearer than nothing.
        let until = |m: f64| if m == 0.0 { f64::INFINITY } else { over_m - m };
        let nearer_m = ((pair.least_m - up_m).max(0.0) * (pair.least_m + up_m)).sqrt();
        let other_m = if beside { until(pair.beside_m) } else { (over_m - self.downwash_m).abs() };
        let spare_m = until(nearer_m).min(other_m) - ROUNDING_M;
        self.due_m[index] = if spare_m > 0.0 {
            // Short of the infinite reach of one that climbs.
            (self.flown_m[i] + self.flown_m[j] + spare_m).min(f64::MAX)
        } else {
            f64::NEG_INFINITY
        };
    }

    /// All pairs, the nearest first.
    pub(super) fn gaps(&self) -> Vec<Gap> {
        let ends = (0..self.under.len() as u16).flat_map(|j| (0..j).map(move |i| [i, j]));
        let known = |m: f64| m.is_finite().then_some(m);
        let mut gaps: Vec<Gap> = ends
            .zip(&self.pairs)
            .map(|(robots, pair)| Gap {
                robots,
                least_m: pair.least_m,
                beside_m: known(pair.beside_m),
                below_m: known(pair.below_m),
                downwash_s: time_s(pair.ticks(self.ticks)),
            })
            .collect();
        // The sort is stable: of equal ones the lower comes first.
        gaps.sort_by(|a, b| a.least_m.total_cmp(&b.least_m));
        gaps
    }

    /// Per robot, how long it was in the downwash of any other one (s).
    pub(super) fn downwash_s(&self) -> Vec<f64> {
        self.under.iter().map(|&ticks| time_s(ticks)).collect()
    }
}

/// A way that is not a number is beyond all.
fn is_due(way_m: f64, due_m: f64) -> bool {
    way_m.partial_cmp(&due_m).is_none_or(std::cmp::Ordering::is_gt)
}

#[cfg(test)]
mod tests;
