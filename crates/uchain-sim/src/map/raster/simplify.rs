//! Fewer corners for the same walls: Douglas–Peucker on closed loops, undone where walls would meet.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use glam::{DVec2, Vec2};

use crate::map::{Map, MapError, Segment, geometry::distance_squared};

/// Loops are cut into pieces of this many corners first, which bounds the work.
const PIECE: usize = 1024;
/// Rounds of local repair, each to half the tolerance of the one before, until loops that are still at fault get all
/// their corners back; as many rounds later all loops do.
const MOST_ROUNDS: u32 = 12;

/// The map of `loops`, each wall within `tolerance` of the chain it stands for. `loops` and `tolerance` are in
/// cells of `cell_m`, free space on the left; no two loops touch; `place` takes cells to the map frame.
pub(super) fn simplify(
    loops: &[Vec<DVec2>],
    tolerance: f64,
    cell_m: f64,
    place: impl Fn(DVec2) -> Vec2,
) -> Result<Map, MapError> {
    let mut chains: Vec<Chain<'_>> = loops.iter().map(|corners| Chain::new(corners, tolerance)).collect();
    let (mut round, mut repair_to) = (0, tolerance);
    loop {
        let placed = chains.iter().map(|chain| chain.kept().map(&place).collect()).collect();
        let map = Map::from_loops(placed)?;
        let faults = faults(&map, &chains, (tolerance + 1.0) * cell_m);
        let mut repaired = false;
        for &(chain, (from, to)) in &faults {
            let chain = &mut chains[chain];
            repaired |= if round < MOST_ROUNDS { chain.refine(from, to, repair_to) } else { chain.restore() };
        }
        if round == 2 * MOST_ROUNDS {
            for chain in &mut chains {
                repaired |= chain.restore();
            }
        }
        round += 1;
        repair_to /= 2.0;
        if !repaired {
            return match map.first_crossing() {
                Some(at) => Err(MapError::WallsCross { x: f64::from(at.x), y: f64::from(at.y) }),
                None => Ok(map),
            };
        }
    }
}

/// One loop and which of its corners are kept.
struct Chain<'a> {
    corners: &'a [DVec2],
    /// Indices into `corners`.
    kept: BTreeSet<usize>,
}

impl<'a> Chain<'a> {
    fn new(corners: &'a [DVec2], tolerance: f64) -> Self {
        let first = least_by(corners.iter(), |p| (p.x, p.y));
        let farthest = least_by(corners.iter(), |p| (-p.distance_squared(corners[first]), 0.0));
        let pieces = (0..corners.len()).skip(PIECE).step_by(PIECE);
        let mut chain = Self { corners, kept: pieces.chain([first, farthest]).collect() };
        for (from, to) in chain.spans() {
            chain.split(from, to, tolerance);
        }
        if chain.kept.len() < 3 {
            for (from, to) in chain.spans() {
                chain.refine(from, to, tolerance);
            }
        }
        chain
    }

    fn kept(&self) -> impl Iterator<Item = DVec2> + Clone {
        self.kept.iter().map(|&index| self.corners[index])
    }

    /// The corners at the ends of each wall; the last wall's second is less than its first, past the end of the loop.
    fn spans(&self) -> Vec<(usize, usize)> {
        self.kept.iter().copied().zip(self.kept.iter().skip(1).chain(&self.kept).copied()).collect()
    }

    /// Keeps corners between two kept ones until all others are within the tolerance.
    fn split(&mut self, from: usize, to: usize, tolerance: f64) {
        let mut open = vec![(from, to)];
        while let Some((from, to)) = open.pop() {
            if let Some((index, off)) = self.farthest_between(from, to)
                && off > tolerance * tolerance
            {
                self.kept.insert(index);
                open.extend([(from, index), (index, to)]);
            }
        }
    }

    /// Gives a wall its farthest corner back, if there is one, and others that are off by more than the tolerance.
    fn refine(&mut self, from: usize, to: usize, tolerance: f64) -> bool {
        let Some((index, _)) = self.farthest_between(from, to) else { return false };
        self.kept.insert(index);
        self.split(from, index, tolerance);
        self.split(index, to, tolerance);
        true
    }

    /// The corner farthest from the straight line between two, and its squared distance.
    fn farthest_between(&self, from: usize, to: usize) -> Option<(usize, f64)> {
        let count = self.corners.len();
        let steps = if to > from { to - from } else { to + count - from };
        let (a, b) = (self.corners[from], self.corners[to]);
        (1..steps)
            .map(|step| (from + step) % count)
            .map(|index| (index, distance_squared(a, b, self.corners[index])))
            .max_by(|p, q| p.1.total_cmp(&q.1))
    }

    /// Gives the loop all its corners back.
    fn restore(&mut self) -> bool {
        let had = self.kept.len();
        self.kept = (0..self.corners.len()).collect();
        self.kept.len() > had
    }
}

/// A wall by its chain and its span there.
type Wall = (usize, (usize, usize));

/// The walls that cross or touch others, or that lie within `reach_m` of a loop
/// which is not on the side of them where it belongs.
fn faults(map: &Map, chains: &[Chain<'_>], reach_m: f64) -> BTreeSet<Wall> {
    let spans =
        |(index, chain): (usize, &Chain<'_>)| chain.spans().into_iter().map(move |span| (index, span));
    let owners: Vec<Wall> = chains.iter().enumerate().flat_map(spans).collect();
    let mut faults = BTreeSet::new();
    let _ = map.each_crossing(|wall, other| {
        faults.extend([owners[wall], owners[other]]);
        ControlFlow::Continue(())
    });
    if !faults.is_empty() {
        return faults;
    }
    for (index, (walls, chain)) in map.loops().zip(chains).enumerate() {
        let (corner, inward) = leftmost(walls);
        let around_free = doubled_area(chain.corners.iter().copied()) > 0.0;
        let inside_free = !map.in_rock_f64(corner + inward);
        if around_free != inside_free || around_free != (doubled_area(chain.kept()) > 0.0) {
            faults.extend(spans((index, chain)));
            // Whatever passed over the loop stands for corners no farther off than the tolerance.
            map.grid.within(corner - reach_m, corner + reach_m, |wall| {
                faults.insert(owners[wall as usize]);
            });
        }
    }
    faults
}

/// Twice the area of a loop (square cells), positive if it runs counter-clockwise.
fn doubled_area(corners: impl Iterator<Item = DVec2> + Clone) -> f64 {
    corners.clone().zip(corners.clone().skip(1).chain(corners)).map(|(p, q)| p.perp_dot(q)).sum()
}

/// The index of the first item with the least key.
fn least_by<T>(items: impl Iterator<Item = T>, key: impl Fn(T) -> (f64, f64)) -> usize {
    let keys = items.map(key).enumerate();
    let least = keys.min_by(|(_, p), (_, q)| p.0.total_cmp(&q.0).then(p.1.total_cmp(&q.1)));
    least.map_or(0, |(index, _)| index)
}

/// The leftmost corner of a loop and a tiny way from there into the loop.
fn leftmost(walls: &[Segment]) -> (DVec2, DVec2) {
    let leaving = least_by(walls.iter(), |wall| (wall.a.x.into(), wall.a.y.into()));
    let arriving = (leaving + walls.len() - 1) % walls.len();
    let ((before, _), (at, after)) = (walls[arriving].ends(), walls[leaving].ends());
    let inward = (before - at).normalize_or_zero() + (after - at).normalize_or_zero();
    let least_m = before.distance(at).min(after.distance(at));
    (at, inward.normalize_or_zero() * least_m * 1e-6)
}
