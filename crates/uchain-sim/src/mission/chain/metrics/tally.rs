//! The summary of a run, from its frames.

use std::collections::{BTreeMap, VecDeque};

use std::sync::Arc;

use glam::Vec2;

use super::{head::Head, verdict::Evidence};
use crate::mission::chain::{LinkSummary, Summary};
use crate::{
    clock::TICKS_PER_S,
    mission::{
        self,
        chain::{Chain, Course, CourseOptimum, Frame, LinkFrame, spread_db},
    },
    record::{RecordError, Recorder},
};

/// Losses within this of each other count as converged in an exploration (dB).
const CONVERGED_DB: f32 = 7.0;
/// "At the end" is this long (ticks): 10 s.
const END_TICKS: u64 = (10.0 * TICKS_PER_S) as u64;
/// Heads within this of one another share one optimum (m).
const SAME_DEPTH_M: f64 = 0.05;

/// Watches a run and sums it up. Memory: one entry per decision of the last 10 s, one per launch and per UAV.
#[derive(Debug)]
pub struct Metrics {
    course: Arc<Course>,
    duration_s: f64,
    limit_db: f32,
    time_s: f64,
    decided_s: f64,
    launches_s: Vec<f64>,
    airborne: Vec<bool>,
    down: Vec<(usize, f64)>,
    /// The decisions of the last 10 s.
    at_the_end: VecDeque<Instant>,
    head: Head,
    converged_s: Option<f64>,
    wall_contacts: u32,
    uav_contacts: u32,
    /// Decisions since the head took off.
    flown: u64,
    connected: u64,
    below_limit: u64,
    /// Whether every one of them says who heard whom.
    is_heard_known: bool,
    worst_link_db: Option<f32>,
    head_reach_m: f32,
    /// Way that the head has flown forward, now and at most (m).
    head_forward_m: f64,
    head_flown_m: f64,
}

/// A decision that may be one of the last.
#[derive(Debug, Default)]
struct Instant {
    tick: u64,
    head: Vec2,
    links: Vec<LinkFrame>,
}

impl Metrics {
    /// For a run of this course.
    pub fn new(course: Arc<Course>) -> Self {
        let scenario = &course.scenario;
        Self {
            duration_s: scenario.duration_s,
            limit_db: scenario.packets.limit_db,
            time_s: 0.0,
            decided_s: 0.0,
            launches_s: Vec::new(),
            airborne: Vec::new(),
            down: Vec::new(),
            at_the_end: VecDeque::new(),
            head: Head::default(),
            converged_s: None,
            wall_contacts: 0,
            uav_contacts: 0,
            flown: 0,
            connected: 0,
            below_limit: 0,
            is_heard_known: true,
            worst_link_db: None,
            head_reach_m: 0.0,
            head_forward_m: 0.0,
            head_flown_m: 0.0,
            course,
        }
    }

    /// What the run came to.
    pub fn summary(&self, seed: u64, digest: String) -> Summary {
        // Only decisions with the final links: a launch or a failure within the last seconds counts from there.
        let uavs = |links: &[LinkFrame]| links.iter().map(|link| link.uav).collect::<Vec<_>>();
        let in_the_end = self.at_the_end.back().map(|last| uavs(&last.links)).unwrap_or_default();
        let last: Vec<&[LinkFrame]> = self
            .at_the_end
            .iter()
            .map(|instant| instant.links.as_slice())
            .filter(|links| uavs(links) == in_the_end)
            .collect();
        let links: Vec<LinkSummary> = in_the_end
            .iter()
            .enumerate()
            .filter_map(|(i, &uav)| {
                let true_db = median(last.iter().map(|links| links[i].true_db))?;
                let filtered_db = median(last.iter().filter_map(|links| links[i].filtered_db));
                Some(LinkSummary { uav, true_db, filtered_db })
            })
            .collect();
        let relays_needed = self.relays_needed();
        let share = |count: u64| (self.flown > 0).then(|| count as f64 / self.flown as f64);
        let evidence = Evidence {
            course: &self.course,
            time_s: self.time_s,
            airborne: &self.airborne,
            has_launched: !self.launches_s.is_empty(),
            down: &self.down,
            head: &self.head,
            links: &links,
            last: &last,
            relays_needed,
        };
        Summary {
            scenario: self.course.scenario.name.clone(),
            seed,
            sim_s: self.time_s,
            verdict: evidence.verdict(),
            launches_s: self.launches_s.clone(),
            uavs: self.uavs(),
            relays_used: self.airborne.iter().skip(1).filter(|airborne| **airborne).count(),
            relays_needed,
            bottleneck_gap_db: self.bottleneck_gap_db(),
            spread_db: median(last.iter().filter_map(|links| spread_db(links))),
            links,
            worst_link_db: self.worst_link_db,
            converged_s: self.converged_s,
            wall_contacts: self.wall_contacts,
            uav_contacts: self.uav_contacts,
            connected_fraction: share(self.connected).filter(|_| self.is_heard_known),
            below_limit_fraction: share(self.below_limit),
            head_reach_m: self.head_reach_m,
            head_flown_m: self.head_flown_m as f32,
            digest,
        }
    }

    /// UAVs in the air.
    fn uavs(&self) -> usize {
        self.airborne.iter().filter(|airborne| **airborne).count()
    }

    /// Whether the head is in the air.
    fn head_flies(&self) -> bool {
        self.airborne.first().is_some_and(|airborne| *airborne)
    }

    /// The head's way of one tick, by its own odometer.
    fn roll(&mut self, frame: &Frame) {
        if let Some(head) = frame.uavs.get(frame.leader).filter(|head| head.airborne) {
            self.head_forward_m += f64::from(head.forward_mps) / TICKS_PER_S;
            self.head_flown_m = self.head_flown_m.max(self.head_forward_m);
        }
    }

    /// Who has left the ground and who has come down since the last frame.
    fn take_offs(&mut self, frame: &Frame) {
        self.airborne.resize(frame.uavs.len(), false);
        for (uav, (was, is)) in self.airborne.iter_mut().zip(&frame.uavs).enumerate() {
            match (*was, is.airborne) {
                (false, true) => {
                    self.launches_s.push(self.decided_s);
                    self.converged_s = None;
                }
                (true, false) => self.down.push((uav, self.decided_s)),
                _ => {}
            }
            *was = is.airborne;
        }
    }

    fn decision(&mut self, frame: &Frame) {
        let true_db = frame.links.iter().map(|link| link.true_db);
        self.worst_link_db = self.worst_link_db.into_iter().chain(true_db).max_by(f32::total_cmp);
        // Packets were exchanged before anybody took off or failed at this decision. Without its head the chain connects
        // nobody to the operator.
        let has_head = frame.links.first().is_some_and(|link| link.uav == frame.leader);
        if has_head || self.flown > 0 {
            let connected = frame.is_connected(self.course.scenario.link.lost_s);
            let is_below = has_head && frame.links.iter().all(|link| link.true_db < self.limit_db);
            self.flown += 1;
            self.connected += u64::from(connected == Some(true));
            self.is_heard_known &= connected.is_some();
            self.below_limit += u64::from(is_below);
        }
        self.head_reach_m = self.head_reach_m.max(frame.head_reach_m);
        // In the tick of a launch the links are still those without the new UAV.
        let whole = frame.links.len() == self.uavs();
        if self.converged_s.is_none() && whole && self.decided_s >= 0.1 * self.duration_s {
            let level = spread_db(&frame.links).is_some_and(|spread| spread < CONVERGED_DB);
            self.converged_s = level.then_some(self.decided_s);
        }
        self.keep(frame);
    }

    /// Forgets what is no longer one of the last decisions; its memory is used again.
    fn keep(&mut self, frame: &Frame) {
        let is_old = |first: &Instant| first.tick + END_TICKS <= frame.tick;
        let old =
            if self.at_the_end.front().is_some_and(is_old) { self.at_the_end.pop_front() } else { None };
        let mut kept = old.unwrap_or_default();
        kept.tick = frame.tick;
        kept.head = frame.uavs.get(frame.leader).map_or(Vec2::NAN, |head| Vec2::new(head.x_m, head.y_m));
        kept.links.clone_from(&frame.links);
        self.at_the_end.push_back(kept);
    }

    /// The optimum, for a head that flies: drawing its table takes longer than many a run.
    fn optimum(&self) -> Option<CourseOptimum<'_>> {
        if self.head_flies() { self.course.optimum() } else { None }
    }

    fn relays_needed(&self) -> Option<usize> {
        let optimum = self.optimum()?;
        let depth_m = optimum.tunnel().depth_m(self.at_the_end.back()?.head);
        optimum.links_needed(depth_m).map(|links| links - 1)
    }

    fn bottleneck_gap_db(&self) -> Option<f32> {
        let optimum = self.optimum()?;
        let mut best_db = BTreeMap::new();
        let gaps = self.at_the_end.iter().filter_map(|Instant { links, head, .. }| {
            let worst_db = links.iter().map(|link| link.true_db).max_by(f32::total_cmp)?;
            let depth = (optimum.tunnel().depth_m(*head) / SAME_DEPTH_M).round();
            let best_db = *best_db
                .entry((depth as i64, links.len()))
                .or_insert_with(|| optimum.optimum(depth * SAME_DEPTH_M, links.len()).bottleneck_db);
            Some(worst_db - best_db as f32)
        });
        median(gaps)
    }
}

impl Recorder<Frame> for Metrics {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.time_s = frame.time_s();
        self.decided_s = frame.decided_s();
        self.take_offs(frame);
        self.roll(frame);
        self.head.look(frame, &self.course);
        self.wall_contacts = frame.uavs.iter().map(|uav| uav.wall_contacts).sum();
        self.uav_contacts = frame.uavs.iter().map(|uav| uav.uav_contacts).sum::<u32>() / 2;
        if frame.decision {
            self.decision(frame);
        }
        Ok(())
    }
}

/// Median; the mean of the two middle values of an even number.
fn median(values: impl Iterator<Item = f32>) -> Option<f32> {
    let mut sorted: Vec<f32> = values.collect();
    sorted.sort_by(f32::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 1 => Some(sorted[middle]),
        _ => Some(0.5 * (sorted[middle - 1] + sorted[middle])),
    }
}

impl mission::Metrics for Metrics {
    type Mission = Chain;

    fn of(course: Arc<Course>) -> Self {
        Self::new(course)
    }

    fn sum_up(&self, seed: u64, digest: String) -> Summary {
        self.summary(seed, digest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_an_even_number_lies_between_the_middle_two() {
        assert_eq!(median([3.0, 1.0, 2.0, 10.0].into_iter()), Some(2.5));
        assert_eq!(median([3.0, 1.0, 2.0].into_iter()), Some(2.0));
        assert_eq!(median(std::iter::empty()), None);
    }
}
