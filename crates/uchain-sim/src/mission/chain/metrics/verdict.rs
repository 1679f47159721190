//! How a chain's mission went: what was asked, what came.

use super::head::Head;
use crate::mission::chain::LinkSummary;
use crate::{
    analyse::{Break, Outcome, Over, Verdict},
    clock::TICKS_PER_S,
    mission::chain::{Course, LinkFrame},
};

/// As much the estimate on which a relay takes off may lie off the true loss (dB): its standard deviation is 0.8 dB at
/// the default noise. What is over the threshold by less has not waited in vain.
const FILTER_DB: f32 = 1.0;

/// What there is to judge by.
pub(super) struct Evidence<'a> {
    pub(super) course: &'a Course,
    pub(super) time_s: f64,
    /// Who is in the air at the end, head first.
    pub(super) airborne: &'a [bool],
    /// Whether anybody ever was.
    pub(super) has_launched: bool,
    /// Who came down, and when (s).
    pub(super) down: &'a [(usize, f64)],
    pub(super) head: &'a Head,
    /// The links at the end.
    pub(super) links: &'a [LinkSummary],
    /// The same at each of the last decisions.
    pub(super) last: &'a [&'a [LinkFrame]],
    pub(super) relays_needed: Option<usize>,
}

impl Evidence<'_> {
    /// The gravest finding, and all others.
    pub(super) fn verdict(&self) -> Verdict {
        let mut found = Vec::new();
        let mut remarks = Vec::new();
        for &(uav, at_s) in self.down {
            match uav {
                0 => found.push(Outcome::HeadFailed { at_s }),
                _ => remarks.push(format!("UAV {uav} failed at {at_s:.2} s")),
            }
        }
        let of_s = self.course.scenario.duration_s;
        // Both are whole ticks.
        if self.time_s + 0.5 / TICKS_PER_S < of_s {
            found.push(Outcome::Interrupted { at_s: self.time_s, of_s: Some(of_s) });
        }
        let head_flies = self.airborne.first().is_some_and(|airborne| *airborne);
        if !self.has_launched && self.time_s > 0.0 {
            found.push(Outcome::NeverFlew);
        }
        if head_flies {
            let finding = self.head.finding(self.course);
            let is_told = matches!(finding, Some(Outcome::HeadHeld { .. }));
            remarks.extend(self.head.remark().filter(|_| !is_told));
            found.extend(finding);
            found.extend(self.broken());
            found.extend(self.over());
        }
        let way = self.head.way();
        if self.last.last().is_some_and(|links| links.iter().any(|link| link.silence.is_none())) {
            remarks
                .push("the recording does not say who heard whom, and what the pilot asked for".to_owned());
        }
        let (worst_db, s_min_db) = (self.worst_db(), self.course.scenario.takeoff.s_min_db);
        Verdict::new(Outcome::Completed { way, links: self.links.len(), worst_db, s_min_db }, found, remarks)
    }

    fn worst_db(&self) -> Option<f32> {
        self.links.iter().map(|link| link.true_db).max_by(f32::total_cmp)
    }

    /// Links over which nothing went at the end: by their median loss, or silent at most of the last decisions.
    fn broken(&self) -> Option<Outcome> {
        let scenario = &self.course.scenario;
        let (limit_db, lost_s) = (scenario.packets.limit_db, scenario.link.lost_s);
        let causes: Vec<(usize, Break)> = self
            .links
            .iter()
            .enumerate()
            .filter_map(|(place, link)| {
                let loss_db = link.true_db;
                if loss_db >= limit_db {
                    return Some((link.uav, Break::Loss { loss_db, limit_db }));
                }
                let link_at = |links: &&[LinkFrame]| links.get(place).copied();
                let unheard = |link: &LinkFrame| link.is_heard(lost_s) == Some(false);
                let silent = self.last.iter().filter_map(link_at).filter(unheard).count();
                // The last time that it was silent says who did not hear.
                let last = self.last.iter().rev().filter_map(link_at).find(unheard)?;
                let silence = last.silence.filter(|_| 2 * silent > self.last.len())?;
                let is_lost = |silent_s: Option<f32>| silent_s.is_none_or(|silent_s| silent_s > lost_s);
                let is_front = is_lost(silence.front_s);
                let silent_s = if is_front { silence.front_s } else { silence.rear_s };
                Some((link.uav, Break::Silent { is_front, silent_s }))
            })
            .collect();
        let (broken, links) = (causes.len(), self.links.len());
        let &(uav, cause) = causes.first()?;
        Some(Outcome::ChainBroken { broken, links, uav, cause })
    }

    /// Links over the loss from which on the chain needs one more UAV.
    fn over(&self) -> Option<Outcome> {
        let s_min_db = self.course.scenario.takeoff.s_min_db;
        let over = self.links.iter().filter(|link| link.true_db > s_min_db).count();
        let worst_db = self.worst_db().filter(|_| over > 0)?;
        let over = Over { over, links: self.links.len(), worst_db, s_min_db };
        let used = self.airborne.iter().skip(1).filter(|airborne| **airborne).count();
        let waiting = self.waiting();
        let base_db = self.links.last().map_or(0.0, |link| link.true_db);
        Some(match (waiting, self.relays_needed) {
            (0, None) => Outcome::RelaysShort { short: None, used, over },
            (0, Some(needed)) if needed > used => {
                Outcome::RelaysShort { short: Some(needed - used), used, over }
            }
            (1.., _) if base_db > s_min_db + FILTER_DB => Outcome::NotLaunched { waiting, used, over },
            _ => Outcome::LinksOver(over),
        })
    }

    /// Relays on the ground that could still fly.
    fn waiting(&self) -> usize {
        let dead = &self.course.scenario.faults.dead;
        let is_dead = |uav: usize| dead.iter().any(|dead| dead.uav == uav && dead.start_s <= self.time_s);
        let has_flown = |uav: usize| self.airborne[uav] || self.down.iter().any(|(down, _)| *down == uav);
        (1..self.airborne.len()).filter(|&uav| !has_flown(uav) && !is_dead(uav)).count()
    }
}
