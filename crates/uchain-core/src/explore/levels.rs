//! Who would meet, and who flies on which level or holds (MFL; Kim 2021, §6.2).

use alloc::{vec, vec::Vec};

use super::{ExploreParams, Point, Target};
use crate::bounded;

/// What conflicts make of one robot's target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ruling {
    /// Level it is to be on at the end of the round.
    pub level: u16,
    /// It stays this round to let another one pass.
    pub hold: bool,
    /// It flies on another level than the usual one, and not just past a robot that holds or is parked.
    pub mfl: bool,
}

/// The rulings for targets of one instant, given in index order.
///
/// Two robots are in conflict if their moves come nearer to each other than [`ExploreParams::conflict_m`]. A robot
/// without a conflict flies on the usual level. One with a conflict keeps a level it has left that for, unless a robot
/// before it in conflict keeps the same; otherwise it takes the first of lowest, highest, middle and added levels
/// that no robot in conflict with it has. Robots in conflict are thus never given the same level.
///
/// Where robots hold ([`StrategyKind::holds`](super::StrategyKind::holds)), of two moving ones the later stays; what is left
/// of conflicts is flown past on levels.
pub fn rule(targets: &[Target], params: &ExploreParams) -> Vec<Ruling> {
    let near_m = params.conflict_m();
    let mut moves: Vec<Move> = targets.iter().map(Move::of).collect();
    let mut hold = vec![false; moves.len()];
    if params.strategy.holds() {
        for (j, hold) in hold.iter_mut().enumerate() {
            let (before, rest) = moves.split_at_mut(j);
            let Some(own) = rest.first_mut().filter(|own| own.moves()) else { continue };
            if before.iter().any(|other| other.moves() && meet(other, own, near_m)) {
                *own = Move { to: own.from, length_m: 0.0, ..*own };
                *hold = true;
            }
        }
    }
    let conflicts = conflicts(&moves, near_m);
    let levels = levels(targets, &conflicts);
    let mfl = |level| level != ExploreParams::USUAL_LEVEL && !params.strategy.holds();
    levels.into_iter().zip(hold).map(|(level, hold)| Ruling { level, hold, mfl: mfl(level) }).collect()
}

/// Smallest distance between two robots that start their moves together and fly straight at one speed (m); the one
/// that is there first stays there. A stay is a move of no length.
pub fn closest_m(a: &Target, b: &Target) -> f32 {
    closest(&Move::of(a), &Move::of(b))
}

/// A straight flight, or a stay.
#[derive(Debug, Clone, Copy)]
struct Move {
    from: Point,
    to: Point,
    length_m: f32,
}

impl Move {
    fn of(target: &Target) -> Self {
        let Target { from, to, .. } = *target;
        Self { from, to, length_m: from.distance_m(to) }
    }

    fn moves(&self) -> bool {
        self.from != self.to
    }

    /// Where it is after so many metres.
    fn after(&self, flown_m: f32) -> Point {
        if flown_m >= self.length_m {
            return self.to;
        }
        let share = flown_m / self.length_m;
        Point {
            x_m: self.from.x_m + share * (self.to.x_m - self.from.x_m),
            y_m: self.from.y_m + share * (self.to.y_m - self.from.y_m),
        }
    }
}

/// The relative motion is straight until the shorter move ends, and straight from then on.
fn closest(a: &Move, b: &Move) -> f32 {
    let gap = |flown_m: f32| {
        let (p, q) = (a.after(flown_m), b.after(flown_m));
        [q.x_m - p.x_m, q.y_m - p.y_m]
    };
    let (start, turn, end) = (gap(0.0), gap(a.length_m.min(b.length_m)), gap(a.length_m.max(b.length_m)));
    from_origin(start, turn).min(from_origin(turn, end))
}

/// Whether two moves come nearer than so much. Most robots are too far apart for that, whatever they do.
fn meet(a: &Move, b: &Move, near_m: f32) -> bool {
    a.from.distance_m(b.from) < near_m + a.length_m + b.length_m && closest(a, b) < near_m
}

/// Distance of the origin from a segment.
fn from_origin(from: [f32; 2], to: [f32; 2]) -> f32 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length2 = along[0] * along[0] + along[1] * along[1];
    let share = -(from[0] * along[0] + from[1] * along[1]) / length2;
    // NaN for a segment of no length.
    let share = if share.is_finite() { bounded(share, 0.0, 1.0) } else { 0.0 };
    let (x, y) = (from[0] + share * along[0], from[1] + share * along[1]);
    libm::sqrtf(x * x + y * y)
}

/// Per robot, those it is in conflict with.
fn conflicts(moves: &[Move], near_m: f32) -> Vec<Vec<usize>> {
    let mut with = vec![Vec::new(); moves.len()];
    for (j, b) in moves.iter().enumerate() {
        for (i, a) in moves.iter().enumerate().take(j) {
            if meet(a, b, near_m) {
                with[i].push(j);
                with[j].push(i);
            }
        }
    }
    with
}

/// Levels by the rule above, for conflicts that are known.
fn levels(targets: &[Target], conflicts: &[Vec<usize>]) -> Vec<u16> {
    let usual = ExploreParams::USUAL_LEVEL;
    let mut given: Vec<Option<u16>> =
        conflicts.iter().map(|others| others.is_empty().then_some(usual)).collect();
    let is_free = |given: &[Option<u16>], i: usize, level: u16| {
        conflicts[i].iter().all(|&other| given[other] != Some(level))
    };
    for (i, target) in targets.iter().enumerate() {
        if given[i].is_none() && target.level != usual && is_free(&given, i, target.level) {
            given[i] = Some(target.level);
        }
    }
    for i in 0..targets.len() {
        if given[i].is_none() {
            given[i] = (0..=u16::MAX).map(preferred).find(|&level| is_free(&given, i, level));
        }
    }
    given.into_iter().map(|level| level.unwrap_or(usual)).collect()
}

/// Lowest, highest, middle, then added levels.
fn preferred(nth: u16) -> u16 {
    match nth {
        1 => 2,
        2 => 1,
        nth => nth,
    }
}

#[cfg(test)]
mod tests;
