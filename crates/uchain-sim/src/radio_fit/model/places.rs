//! Samples brought together by place: what is measured twice at one place shares all of the shadowing there.

use std::collections::BTreeMap;

use crate::radio_fit::{Log, Sample};

/// Most places; more samples than that share cells of a grid.
pub(super) const PLACES_MAX: usize = 3_000;
/// Most places of a link, so that blocks of them are long against what hangs together.
const OF_A_LINK: usize = 480;
/// First side of such a cell (m), and by what it grows.
const CELL_M: f64 = 0.01;
const GROWS: f64 = 1.3;

/// All packets of a link whose two ends are in one place each.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) link: usize,
    /// The middle of its packets (m).
    pub(super) ends_m: [f64; 6],
    /// Mean distance (m).
    pub(super) distance_m: f64,
    /// Mean of `log10(max(d, d0) / d0)`.
    pub(super) decades: f64,
    /// Packets that were heard.
    pub(super) heard: f64,
    /// Their mean loss (dB), and the sum of squares about it (dB²).
    pub(super) loss_db: f64,
    pub(super) squares: f64,
    /// Sum of squares of its packets' ends about their middle (m²), of each end.
    pub(super) spread_m2: [f64; 2],
    /// Packets that were not.
    pub(super) lost: f64,
    /// As how many heard packets it counts, and their loss (dB): those that were not heard taken in.
    pub(super) weight: f64,
    pub(super) level_db: f64,
    /// How many of those that were not heard count for the noise, and their squares (dB²).
    pub(super) imputed: f64,
    pub(super) imputed_squares: f64,
}

impl Place {
    /// Only what was heard counts.
    pub(super) fn forget_lost(&mut self) {
        (self.weight, self.level_db) = (self.heard, self.loss_db);
        (self.imputed, self.imputed_squares) = (0.0, 0.0);
    }

    /// How far a link's ends lie from those of another (m), both together.
    pub(super) fn apart_m(&self, other: &Self) -> f64 {
        apart_m(&self.ends_m, &other.ends_m)
    }
}

fn apart_m(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let square = |i: usize| (a[i] - b[i]) * (a[i] - b[i]);
    (square(0) + square(1) + square(2)).sqrt() + (square(3) + square(4) + square(5)).sqrt()
}

/// The places of a log, and the side of the cells that stand for a place (m), 0 where none are needed.
pub(super) fn places(log: &Log, reference_m: f64) -> (Vec<Place>, Index, f64) {
    let mut cell_m = 0.0;
    loop {
        if let Some((places, index)) = places_in(log, reference_m, cell_m) {
            return (places, index, cell_m);
        }
        cell_m = if cell_m > 0.0 { cell_m * GROWS } else { CELL_M };
    }
}

/// The number of a place's coordinate: the coordinate itself, or its cell.
fn key(m: f64, cell_m: f64) -> u64 {
    if cell_m > 0.0 { (m / cell_m).floor().to_bits() } else { (m + 0.0).to_bits() }
}

/// Finds the place of a sample.
pub(super) struct Index {
    known: BTreeMap<(usize, [u64; 6]), usize>,
    cell_m: f64,
}

impl Index {
    pub(super) fn find(&self, sample: &Sample) -> Option<usize> {
        self.known.get(&(sample.link, sample.ends_m.map(|m| key(m, self.cell_m)))).copied()
    }
}

/// `None` where they are too many. Cells of any size hold a sample each at most, so that a large one ends it: links and cells
/// that hold the whole map are few.
fn places_in(log: &Log, reference_m: f64, cell_m: f64) -> Option<(Vec<Place>, Index)> {
    let mut known: BTreeMap<(usize, [u64; 6]), usize> = BTreeMap::new();
    let mut places: Vec<Place> = Vec::new();
    for sample in &log.samples {
        let at = *known.entry((sample.link, sample.ends_m.map(|m| key(m, cell_m)))).or_insert(places.len());
        if at == places.len() {
            if at == PLACES_MAX.min(OF_A_LINK * log.links.len().max(1)) {
                return None;
            }
            places.push(Place {
                link: sample.link,
                ends_m: [0.0; 6],
                distance_m: 0.0,
                decades: 0.0,
                heard: 0.0,
                loss_db: 0.0,
                squares: 0.0,
                spread_m2: [0.0; 2],
                lost: 0.0,
                weight: 0.0,
                level_db: 0.0,
                imputed: 0.0,
                imputed_squares: 0.0,
            });
        }
        let Some(place) = places.get_mut(at) else { continue };
        let count = place.heard + place.lost + 1.0;
        let decades = libm::log10(sample.distance_m.max(reference_m) / reference_m);
        for (axis, (mean_m, m)) in place.ends_m.iter_mut().zip(sample.ends_m).enumerate() {
            let off_m = m - *mean_m;
            *mean_m += off_m / count;
            place.spread_m2[axis / 3] += off_m * (m - *mean_m);
        }
        place.distance_m += (sample.distance_m - place.distance_m) / count;
        place.decades += (decades - place.decades) / count;
        if let Some(loss_db) = sample.loss_db {
            place.heard += 1.0;
            let off_db = loss_db - place.loss_db;
            place.loss_db += off_db / place.heard;
            place.squares += off_db * (loss_db - place.loss_db);
        } else {
            place.lost += 1.0;
        }
    }
    for place in &mut places {
        place.forget_lost();
    }
    Some((places, Index { known, cell_m }))
}

/// How far apart two packets of one place lie on average (m), both ends together: 2/√3 of the standard deviation, as on a line
/// along which they lie evenly.
pub(super) fn spread_m(places: &[Place]) -> f64 {
    let count: f64 = places.iter().map(|place| place.heard + place.lost).sum();
    let of = |end: usize| places.iter().map(|place| place.spread_m2[end]).sum::<f64>() / count.max(1.0);
    1.1547 * (of(0).max(0.0).sqrt() + of(1).max(0.0).sqrt())
}

/// Indices of places in blocks of one link each, no larger than so many, near ones together.
pub(super) fn blocks(places: &[Place], most: usize) -> Vec<Vec<usize>> {
    let mut by_link: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, place) in places.iter().enumerate() {
        by_link.entry(place.link).or_default().push(index);
    }
    let mut blocks = Vec::new();
    let mut open: Vec<Vec<usize>> = by_link.into_values().collect();
    while let Some(mut block) = open.pop() {
        if block.len() <= most {
            blocks.push(block);
            continue;
        }
        let at = |index: &usize, axis: usize| places.get(*index).map_or(0.0, |place| place.ends_m[axis]);
        let width = |axis: usize| {
            let (low, high) = block
                .iter()
                .map(|index| at(index, axis))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), m| (l.min(m), h.max(m)));
            high - low
        };
        let widest = (0..6).max_by(|a, b| width(*a).total_cmp(&width(*b))).unwrap_or(0);
        block.sort_by(|a, b| at(a, widest).total_cmp(&at(b, widest)).then(a.cmp(b)));
        let rest = block.split_off(block.len() / 2);
        open.extend([rest, block]);
    }
    blocks
}
