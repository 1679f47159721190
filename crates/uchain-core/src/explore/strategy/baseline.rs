//! The random choice that STN is compared with (Kim 2021, §7.2).

use super::{Candidate, Goal, Strategy, View, target::here_or_back, target::is_taken};
use crate::explore::{Label, Run, Sector};

/// A random frontier here, else the nearest hub (Kim 2021, §7.2).
#[derive(Debug, Clone, Copy, Default)]
pub struct RandomFrontier;

impl Strategy for RandomFrontier {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        here_or_back(view, random)
    }
}

/// A uniformly random frontier sector here, of those that are not left to others if they are; `None` without one.
fn random(view: &mut View<'_>, leave: bool) -> Option<Candidate> {
    let frontiers = open(view, leave).count();
    if frontiers == 0 {
        return None;
    }
    // The high word of a product: uniform to one part in 2³² / 360.
    let nth = ((u64::from((view.draw)()) * frontiers as u64) >> 32) as usize;
    open(view, leave).nth(nth)
}

/// The frontier sectors here, each as a place for a new node.
fn open<'v>(view: &'v View<'_>, leave: bool) -> impl Iterator<Item = Candidate> + 'v {
    let frontier = |(k, s): (usize, &Sector)| (s.label == Label::Frontier).then_some(k);
    let sectors = view.sectors().iter().enumerate().filter_map(frontier);
    let places = sectors.filter_map(move |first| view.candidate(Run { first, count: 1 }));
    places.filter(move |candidate| !leave || !is_taken(view, candidate.at))
}
