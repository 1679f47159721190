//! The random choice that STN is compared with (Kim 2021, §7.2).

use super::{Candidate, Goal, Strategy, View};
use crate::explore::{Label, Run, Sector};

/// A random frontier here, else the nearest hub (Kim 2021, §7.2).
#[derive(Debug, Clone, Copy, Default)]
pub struct RandomFrontier;

impl Strategy for RandomFrontier {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        random(view).map_or_else(|| view.backtrack(), Goal::Frontier)
    }
}

/// A uniformly random frontier sector here; `None` without one.
fn random(view: &mut View<'_>) -> Option<Candidate> {
    let frontier = |(k, s): (usize, &Sector)| (s.label == Label::Frontier).then_some(k);
    let frontiers = view.sectors().iter().enumerate().filter_map(frontier).count();
    if frontiers == 0 {
        return None;
    }
    // The high word of a product: uniform to one part in 2³² / 360.
    let nth = ((u64::from((view.draw)()) * frontiers as u64) >> 32) as usize;
    let first = view.sectors().iter().enumerate().filter_map(frontier).nth(nth)?;
    view.candidate(Run { first, count: 1 })
}
