//! Selective target nodes: fly where the others are not (STN; Kim 2021, §6.1.2, Eq. 7).

use alloc::vec::Vec;
use core::f32::consts::{PI, TAU};

use super::{Candidate, Goal, Mate, Strategy, View};
use crate::explore::{Point, Purpose};

/// What targets that others have announced this round are to a choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Taken {
    /// Nothing: in Eq. 7 the others count where they are, as it is printed. Two robots that have come to one node
    /// then choose alike, and go on together.
    #[default]
    Ignored,
    /// In Eq. 7 their robots count where they will be. The other strategies look at no robots.
    Counted,
    /// That, and no strategy flies where another robot has said it will make a node, as long as there is anything else
    /// to do. What Kim 2021, §6.2 says of robots at one node, that they are given different targets, holds only then;
    /// how, is ours.
    Left,
}

/// Selective target nodes (Kim 2021, §6.1.2): the best frontier here, else the nearest hub.
#[derive(Debug, Clone, Copy, Default)]
pub struct Cssg;

impl Strategy for Cssg {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        here_or_back(view, |view, leave| selective(view, leave))
    }
}

/// A frontier here, of those that are not left to others if frontiers are; else the nearest hub (Kim 2021, Algorithm 2).
pub(super) fn here_or_back(
    view: &mut View<'_>,
    mut choose: impl FnMut(&mut View<'_>, bool) -> Option<Candidate>,
) -> Goal {
    let leave = view.params().taken == Taken::Left;
    if let Some(candidate) = choose(view, leave) {
        return Goal::Frontier(candidate);
    }
    match view.backtrack() {
        // Rather together than not at all.
        Goal::Home if leave => choose(view, false).map_or(Goal::Home, Goal::Frontier),
        hub_or_home => hub_or_home,
    }
}

/// The merged frontier here whose place has the largest objective; `None` without a frontier. Ties go to the wider
/// one, then to the least turn, then to the lowest first sector.
fn selective(view: &View<'_>, leave: bool) -> Option<Candidate> {
    let (tie_m, tie_turn_rad) = (view.params().tie_m, view.params().tie_turn_rad);
    let open = view.merged().filter(|candidate| !leave || !is_taken(view, candidate.at));
    let rated: Vec<(f32, Candidate)> = open.map(|c| (objective_m(view, c.at), c)).collect();
    let most_m = rated.iter().map(|(j_m, _)| *j_m).reduce(f32::max)?;
    let level = || rated.iter().filter(|(j_m, _)| most_m - j_m <= tie_m).map(|(_, c)| c);
    let widest = level().map(|c| c.run.count).max()?;
    let wide = || level().filter(|c| c.run.count == widest);
    let turn = |c: &Candidate| turn_rad(view.pose.heading_rad, c.direction_rad);
    let least_rad = wide().map(turn).reduce(f32::min)?;
    wide().filter(|c| turn(c) - least_rad <= tie_turn_rad).min_by_key(|c| c.run.first).copied()
}

/// Whether another robot has said it will make a node nearer than `d_min` to this place.
pub(super) fn is_taken(view: &View<'_>, place: Point) -> bool {
    let d_min_m = view.params().d_min_share * view.params().r_s_m;
    let new = view.taken().filter(|target| target.purpose == Purpose::Explore);
    new.map(|target| target.to.distance_m(place)).any(|d_m| d_m < d_min_m)
}

/// J of Eq. 7 (m), with weights c of 1. The robot's own distance is the same to all its candidates and left out;
/// heights are left out too, for which level a robot flies on is decided afterwards.
pub(super) fn objective_m(view: &View<'_>, candidate: Point) -> f32 {
    let counts_at = |mate: &Mate| match view.params().taken {
        Taken::Ignored => mate.at,
        Taken::Counted | Taken::Left => mate.target.map(|target| target.to).or(mate.at),
    };
    view.others().filter_map(counts_at).map(|at| at.distance_m(candidate)).sum()
}

/// Size of the turn between two headings (rad), 0 to π; 0 if either is not finite.
pub(super) fn turn_rad(from_rad: f32, to_rad: f32) -> f32 {
    let turned = libm::fmodf(to_rad - from_rad, TAU).abs();
    if !turned.is_finite() {
        return 0.0;
    }
    if turned > PI { TAU - turned } else { turned }
}
