//! What people compare with: the nearest frontier, and information against distance. Both look at all frontiers that
//! are known, whoever found them, and robots in conflict fly on levels as those of CSSG do, so that only choices differ.

#[cfg(test)]
mod tests;

use core::f32::consts::TAU;

use super::{Candidate, Goal, Point, Run, Ssg, Strategy, Taken, View, target::is_taken, target::turn_rad};
use crate::explore::runs;

/// The frontier with the shortest way (Yamauchi 1997): one of the node the robot is at, that of the least turn, else
/// the nearest node with one.
#[derive(Debug, Clone, Copy, Default)]
pub struct NearestFrontier;

impl Strategy for NearestFrontier {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        let leave = view.params().taken == Taken::Left;
        if let Some(candidate) = least_turn(view, leave) {
            return Goal::Frontier(candidate);
        }
        let (ssg, here) = (view.ssg, view.here);
        match view.nearest(|slot| slot != here && ssg.is_hub(slot)) {
            Some(hub) => Goal::Node(hub),
            // Rather together than not at all.
            None => least_turn(view, false).map_or(Goal::Home, Goal::Frontier),
        }
    }
}

/// The frontier here that takes the least turn; of equal ones the first.
fn least_turn(view: &View<'_>, leave: bool) -> Option<Candidate> {
    let heading_rad = view.pose.heading_rad;
    let open = view.merged().filter(|candidate| !leave || !is_taken(view, candidate.at));
    open.min_by(|a, b| {
        let turn = |candidate: &Candidate| turn_rad(heading_rad, candidate.direction_rad);
        turn(a).total_cmp(&turn(b))
    })
}

/// The frontier of the largest utility (after Burgard 2005): the length of its arc, less what others who have said they
/// fly near it will see of it, minus `utility_beta` times the way there. A robot on its way to a node goes on to it as
/// long as that has a frontier, and takes one of its frontiers then: what others announce meanwhile turns nobody round.
#[derive(Debug, Clone, Copy, Default)]
pub struct Utility;

impl Strategy for Utility {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        let (ssg, here) = (view.ssg, view.here);
        let committed = view.previous.and_then(|id| ssg.slot(id)).filter(|&slot| ssg.is_hub(slot));
        match committed {
            // A way that led there still does: edges are only added.
            Some(hub) if hub != here => return Goal::Node(hub),
            _ => {}
        }
        let own = best(view, here, view.params().taken == Taken::Left);
        if let (Some((_, candidate)), true) = (own, committed.is_some()) {
            return Goal::Frontier(candidate);
        }
        if let Some(hub) = elsewhere(view, own.map(|(utility_m, _)| utility_m)) {
            return Goal::Node(hub);
        }
        // Rather together than not at all.
        own.or_else(|| best(view, here, false)).map_or(Goal::Home, |(_, candidate)| Goal::Frontier(candidate))
    }
}

/// The best frontier of a node and its utility without the way to the node (m).
fn best(view: &View<'_>, slot: usize, leave: bool) -> Option<(f32, Candidate)> {
    let rated = rated(view, view.ssg, slot, leave);
    rated.reduce(|best, next| if next.0 > best.0 { next } else { best })
}

fn rated<'v>(
    view: &'v View<'_>,
    ssg: &'v Ssg,
    slot: usize,
    leave: bool,
) -> impl Iterator<Item = (f32, Candidate)> + 'v {
    let candidate = move |run: Run| Candidate::of(ssg, slot, view.pose.heading_rad, run);
    let open = runs(ssg.sectors(slot)).filter_map(candidate);
    open.filter(move |candidate| !leave || !is_taken(view, candidate.at)).map(move |candidate| {
        let leg_m = ssg.at(slot).unwrap_or(view.pose.at).distance_m(candidate.at);
        (information_m(view, &candidate) - view.params().utility_beta * leg_m, candidate)
    })
}

/// Length of a frontier's arcs, less the share that others leave of it (m).
fn information_m(view: &View<'_>, candidate: &Candidate) -> f32 {
    let r_s_m = view.params().r_s_m;
    let all_m = TAU * r_s_m * candidate.run.count as f32 / f32::from(view.params().sectors);
    // A star reaches R_s, and so does another one.
    let seen = |to: Point| (1.0 - to.distance_m(candidate.at) / (2.0 * r_s_m)).max(0.0);
    let left = 1.0 - view.taken().map(|target| seen(target.to)).sum::<f32>();
    all_m * left.max(0.0)
}

/// The other node with the largest utility, if that is larger than `least_m`; of equal ones the nearest.
fn elsewhere(view: &mut View<'_>, least_m: Option<f32>) -> Option<usize> {
    let (ssg, here, beta) = (view.ssg, view.here, view.params().utility_beta);
    let leave = view.params().taken == Taken::Left;
    let most_m = TAU * view.params().r_s_m;
    let mut best_m = least_m.unwrap_or(f32::NEG_INFINITY);
    let mut found = None;
    let mut routes = core::mem::take(view.routes);
    routes.search(ssg.graph(), here, |slot, distance_m| {
        if most_m - beta * distance_m < best_m {
            // Farther on not even all of a star would be worth the way.
            return true;
        }
        if slot != here
            && ssg.is_hub(slot)
            && let Some((here_m, _)) = best(view, slot, leave)
            && here_m - beta * distance_m > best_m
        {
            best_m = here_m - beta * distance_m;
            found = Some(slot);
        }
        false
    });
    *view.routes = routes;
    found
}
