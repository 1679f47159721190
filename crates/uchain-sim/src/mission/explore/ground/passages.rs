//! Passages that stars may not look through, and what lies in and behind them.

use std::{cmp::Reverse, collections::BinaryHeap, f32::consts::TAU};

use glam::Vec2;
use uchain_core::explore::ExploreParams;

use crate::analyse::Remedy;
use crate::mission::explore::Ground;

/// Clearances are measured to this (m): a passage counts as narrow that is so by more than a centimetre.
const MEASURED_M: f32 = 0.005;
/// Pieces of less than this share of the ground are corners, not rooms or halls (1).
const LEAST_SHARE: f64 = 0.001;

/// How wide a passage has to be for its far side to be found.
///
/// Let a straight passage be w wide: what is left for a robot's middle is a strip of width c = w − 2 `r_body_m`. From
/// any point of the strip, a distance y from its one side, a ray at an angle φ to the strip stays in it as far as `R_s`
/// if −y ≤ `R_s` sin φ ≤ c − y. These directions span asin(y/`R_s`) + asin((c − y)/`R_s`), which is least in the
/// middle: 2 asin(c / 2 `R_s`). Sectors have fixed directions, δ = 2π/`sectors` wide; a span of 2δ holds a whole one
/// however the map is turned, and less may not. So some sector sees no wall within `R_s`, which makes it a frontier,
/// from wherever in the passage or straight in front of it a node is, if c ≥ 2 `R_s` sin δ; c ≥ 2δ `R_s`, two sector
/// widths, is a little more (1.5 % at 18 sectors). Half of that is not enough: one sector fits only if it happens to
/// point along the passage. Fewer than eight sectors are never sure: 2δ is more than the right angle seen beside a wall.
///
/// That a node comes to be in front of it is another matter. Moves are `alpha` `R_s` = 0.8 `R_s` long, and nodes that
/// see the mouth of a passage from aside do not see through it. However many sectors there are, about one in thirty
/// passages of c = 0.1 to 0.6 `R_s` is overlooked; of those with c ≥ 0.7 `R_s`, two sector widths of 18, none is
/// if there are 36 sectors. With 18, the mid-points of the few sectors that fit through may lie in stars that look in
/// from aside, and a few in a thousand are overlooked: `arc_ends` is against that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Width {
    r_body_m: f32,
    r_s_m: f32,
    sectors: u16,
    arc_ends: bool,
    nodes_max: u32,
    /// From this on it is wide enough (m).
    pub least_m: f32,
}

impl Width {
    /// More sectors do not let narrower passages be found, relative to `r_s_m`.
    const SECTORS: u16 = 18;
    /// Least share of a range that is worth going down to (1), and least range (m).
    const LEAST: [f32; 2] = [0.1, 0.05];
    /// Share of the nodes that there may be (1). About one is made on `r_s_m`².
    const NODES: f32 = 0.5;
    /// Sectors where a smaller range is not worth it.
    const MANY_SECTORS: u16 = 144;

    /// By these parameters.
    pub fn seen(params: &ExploreParams) -> Self {
        let ExploreParams { r_body_m, r_s_m, sectors, arc_ends, nodes_max, .. } = *params;
        let least_m = 2.0 * r_body_m + Self::share(sectors.min(Self::SECTORS)) * r_s_m;
        Self { r_body_m, r_s_m, sectors, arc_ends, nodes_max, least_m }
    }

    /// Two sector widths as a share of `r_s_m` (1).
    fn share(sectors: u16) -> f32 {
        2.0 * TAU / f32::from(sectors)
    }

    /// What to set to find the far side of passages of a width (m), on so much ground (m²): a smaller range, and twice the sectors that would
    /// just do, so that no mid-point is covered from aside. If only a range would do that is tiny, or takes
    /// too many nodes, it is many sectors and all points of their arcs: that overlooks some.
    pub fn remedy(&self, width_m: f32, ground_m2: f64) -> Option<Remedy> {
        let share = Self::share(Self::SECTORS);
        // Rounded down to hundredths; the width rounded up.
        let r_s_m = ((width_m - 2.0 * self.r_body_m) / share * 100.0).floor() / 100.0;
        let nodes = ground_m2 as f32 / (r_s_m * r_s_m);
        let is_tiny = r_s_m < (Self::LEAST[0] * self.r_s_m).max(Self::LEAST[1]);
        if is_tiny || nodes > Self::NODES * self.nodes_max as f32 {
            let is_finest = self.sectors >= Self::MANY_SECTORS && self.arc_ends;
            let sectors = self.sectors.max(Self::MANY_SECTORS);
            let sets = format!("--set explore.sectors={sectors} --set explore.arc_ends=true");
            return (!is_finest).then_some(Remedy { sets, width_m: None });
        }
        if r_s_m >= self.r_s_m {
            return self.finer();
        }
        let mut sets = vec![format!("--set explore.r_s_m={r_s_m}")];
        if self.sectors < 2 * Self::SECTORS {
            sets.push(format!("--set explore.sectors={}", 2 * Self::SECTORS));
        }
        let seen_m = ((2.0 * self.r_body_m + share * r_s_m) * 100.0).ceil() / 100.0;
        Some(Remedy { sets: sets.join(" "), width_m: Some(seen_m.into()) })
    }

    /// What to set to see more where no passage is narrow: more sectors, or more points of each.
    pub fn finer(&self) -> Option<Remedy> {
        let sets = if self.sectors < 2 * Self::SECTORS {
            format!("--set explore.sectors={}", 2 * Self::SECTORS)
        } else if !self.arc_ends {
            "--set explore.arc_ends=true".to_owned()
        } else {
            return None;
        };
        Some(Remedy { sets, width_m: None })
    }
}

/// A part of the ground that is connected with the starts through narrow passages only, those passages included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The narrowest place on the widest way into its roomiest place.
    pub at: Vec2,
    /// Width there (m).
    pub width_m: f32,
    /// Area in and behind it (m²).
    pub area_m2: f64,
}

/// All of the ground's narrow passages.
#[derive(Debug, Clone, Default)]
pub struct Passages {
    least_m: f32,
    /// Per cell in or behind a narrow passage, the width of the widest way there (m); infinite for other cells.
    widths_m: Vec<f32>,
    pieces: Vec<Passage>,
}

impl Passages {
    /// Looks for them. Clearances are those of the cells' widest places.
    pub(crate) fn survey(ground: &Ground, clearances_m: &[f32], starts: &[usize], width: &Width) -> Self {
        let least_m = width.least_m;
        let is_wide =
            |index: usize| ground.is_reachable(index) && clearances_m[index] >= least_m / 2.0 - MEASURED_M;
        // From a wide part out to the walls again, into its corners.
        let r_wall_m = (least_m / 2.0 - width.r_body_m).max(0.0);
        let rings = (r_wall_m / ground.cells().cell_m()).ceil() as usize + 1;
        let mut wide = vec![false; clearances_m.len()];
        let mut open: Vec<usize> = widen(ground, starts, rings).into_iter().filter(|&i| is_wide(i)).collect();
        let mut parts = Vec::new();
        while let Some(index) = open.pop() {
            if !std::mem::replace(&mut wide[index], true) {
                parts.push(index);
                open.extend(ground.cells().around(index).filter(|&i| is_wide(i)));
            }
        }
        let seeds = if parts.is_empty() { starts } else { &parts };
        let (ways_m, pinches) = widest_ways(ground, clearances_m, seeds);
        let mut is_behind: Vec<bool> = (0..wide.len()).map(|index| ground.is_reachable(index)).collect();
        for index in widen(ground, &parts, rings) {
            is_behind[index] = false;
        }
        let mut found = Self { least_m, widths_m: vec![f32::INFINITY; is_behind.len()], pieces: Vec::new() };
        let cell_m2 = ground.cells().cell_m2();
        let least = LEAST_SHARE * ground.count() as f64;
        for first in 0..is_behind.len() {
            let piece = ground.cells().take_connected(first, &mut is_behind);
            let roomiest = piece.iter().copied().max_by(|&a, &b| clearances_m[a].total_cmp(&clearances_m[b]));
            let Some(roomiest) = roomiest.filter(|_| piece.len() as f64 >= least) else { continue };
            for &index in &piece {
                found.widths_m[index] = 2.0 * ways_m[index];
            }
            found.pieces.push(Passage {
                at: ground.cells().middle_of(pinches[roomiest]),
                width_m: 2.0 * ways_m[roomiest],
                area_m2: piece.len() as f64 * cell_m2,
            });
        }
        // The sort is stable: of equal ones the lower comes first.
        found.pieces.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        found
    }

    /// Passages narrower than this are narrow (m).
    pub fn least_m(&self) -> f32 {
        self.least_m
    }

    /// Parts in and behind narrow passages, the largest first; corners are left out.
    pub fn pieces(&self) -> &[Passage] {
        &self.pieces
    }

    /// Ground in and behind narrow passages (m²).
    pub fn area_m2(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.area_m2).sum()
    }

    /// Of a cell in or behind a narrow passage, the width of the widest way there (m).
    pub fn width_m(&self, index: usize) -> Option<f32> {
        self.widths_m.get(index).copied().filter(|width_m| width_m.is_finite())
    }
}

/// Of parts behind passages, widths (m) and areas (m²): the width to see through so that at most so much (m²) is left
/// behind narrower ones. `None` if there is no more than that.
pub(crate) fn width_but_for_m(mut parts: Vec<(f32, f64)>, left_m2: f64) -> Option<f32> {
    parts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut behind_m2 = 0.0;
    let needed = parts.into_iter().find(|(_, area_m2)| {
        behind_m2 += area_m2;
        behind_m2 > left_m2
    });
    needed.map(|(width_m, _)| width_m)
}

/// These cells and the reachable ones so many rings of cells around them.
fn widen(ground: &Ground, from: &[usize], rings: usize) -> Vec<usize> {
    let mut found = vec![false; ground.cells().count()];
    for &index in from {
        found[index] = true;
    }
    let (mut all, mut first) = (from.to_vec(), 0);
    for _ in 0..rings {
        let end = all.len();
        for k in first..end {
            let middle = all[k];
            for beside in ground.cells().around(middle) {
                if ground.is_reachable(beside) && !std::mem::replace(&mut found[beside], true) {
                    all.push(beside);
                }
            }
        }
        first = end;
    }
    all
}

/// Per cell, the least clearance on the way there whose least clearance is greatest (m), and the cell where it is that.
///
/// Dijkstra's algorithm with the least clearance in place of the sum of lengths (widest path, maximin): no shortest way
/// is asked for.
fn widest_ways(ground: &Ground, clearances_m: &[f32], seeds: &[usize]) -> (Vec<f32>, Vec<usize>) {
    let mut ways_m = vec![0.0; clearances_m.len()];
    let mut pinches = vec![0; clearances_m.len()];
    let mut open = BinaryHeap::new();
    // Clearances are not negative, and such floats are ordered as their bits are.
    let key = |m: f32| m.max(0.0).to_bits();
    for &index in seeds {
        (ways_m[index], pinches[index]) = (clearances_m[index], index);
        open.push((key(clearances_m[index]), Reverse(index)));
    }
    while let Some((bits, Reverse(index))) = open.pop() {
        if bits < key(ways_m[index]) {
            continue;
        }
        for beside in ground.cells().around(index) {
            let way_m = ways_m[index].min(clearances_m[beside]);
            if ground.is_reachable(beside) && way_m > ways_m[beside] {
                let is_pinch = clearances_m[beside] <= ways_m[index];
                (ways_m[beside], pinches[beside]) = (way_m, if is_pinch { beside } else { pinches[index] });
                open.push((key(way_m), Reverse(beside)));
            }
        }
    }
    (ways_m, pinches)
}
