//! The length of the shortest way through free space.
//!
//! A shortest way is straight but for corners of rock that stick into free space, where it bends round them. So the
//! corners, each with its distance from the source (Dijkstra over taut edges, found as they are needed), answer
//! every query: the last corner before a point is the one with the least total that sees it.
//!
//! The search is not that of the roadmap (`uchain_core::explore::Dijkstra`), which wants all edges beforehand: whether
//! two corners see each other costs more than all the rest, and is only asked where it would shorten a way.

use glam::{DVec2, Vec2};

use super::{Map, MapError, geometry::orient};

/// Most corners of rock a tunnel distance is worked out for: time grows with their square.
pub const MOST_CORNERS: usize = 12_000;

/// What rounding can add to a distance (m), and per metre of it.
const ROUNDING_M: f64 = 1e-4;
const ROUNDING: f64 = 1e-6;

/// Distances through free space from one source.
#[derive(Debug, Clone)]
pub struct Geodesic {
    source: Vec2,
    /// The corners that can be reached, the nearest first.
    corners: Vec<Corner>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) at: Vec2,
    /// The ends of the two walls that meet here.
    before: DVec2,
    after: DVec2,
    distance_m: f64,
}

impl Corner {
    /// Whether a string from here to `p` can bend round the corner: both walls lie on one side of it.
    pub(super) fn is_taut(&self, p: DVec2) -> bool {
        let at = self.at.as_dvec2();
        let (before, after) = (orient(p, at, self.before), orient(p, at, self.after));
        !super::geometry::opposite(before, after)
    }
}

impl Map {
    /// Distances through free space from `source`.
    ///
    /// # Errors
    /// A `source` in rock; more than [`MOST_CORNERS`] corners that stick into free space; walls that cross or touch
    /// (their crossings would be corners nobody listed).
    pub fn geodesic(&self, source: Vec2) -> Result<Geodesic, MapError> {
        let mut open = self.corners_from(source)?;
        let from = source.as_dvec2();
        for corner in &mut open {
            if corner.is_taut(from) && self.sees(source, corner.at) {
                corner.distance_m = from.distance(corner.at.as_dvec2());
            }
        }
        let mut corners = Vec::with_capacity(open.len());
        while let Some(nearest) = nearest_of(&open) {
            let here = open.swap_remove(nearest);
            let at = here.at.as_dvec2();
            for corner in &mut open {
                let there = corner.at.as_dvec2();
                let distance_m = here.distance_m + at.distance(there);
                if distance_m < corner.distance_m
                    && here.is_taut(there)
                    && corner.is_taut(at)
                    && self.sees(here.at, corner.at)
                {
                    corner.distance_m = distance_m;
                }
            }
            corners.push(here);
        }
        Ok(Geodesic { source, corners })
    }

    /// Whether [`Self::geodesic`] has an answer, without the search that takes long.
    ///
    /// # Errors
    /// Those of [`Self::geodesic`].
    pub(crate) fn check_geodesic(&self, source: Vec2) -> Result<(), MapError> {
        self.corners_from(source).map(drop)
    }

    fn corners_from(&self, source: Vec2) -> Result<Vec<Corner>, MapError> {
        if self.in_rock(source) {
            return Err(MapError::InRock { x: f64::from(source.x), y: f64::from(source.y) });
        }
        self.corners_in_the_way(MOST_CORNERS)
    }

    /// All corners a shortest way may bend round, none of them reached yet.
    pub(super) fn corners_in_the_way(&self, most: usize) -> Result<Vec<Corner>, MapError> {
        if let Some(at) = self.first_crossing() {
            return Err(MapError::WallsCross { x: f64::from(at.x), y: f64::from(at.y) });
        }
        let corners: Vec<Corner> = self.loops().flat_map(|walls| self.corners_of_rock(walls)).collect();
        if corners.len() > most {
            let what = "corners of rock in the map";
            return Err(MapError::Count { what, got: corners.len(), least: 0, most });
        }
        Ok(corners)
    }

    /// The corners of one loop whose rock spans less than half a turn.
    fn corners_of_rock(&self, walls: &[super::Segment]) -> impl Iterator<Item = Corner> {
        let arriving = walls.iter().skip(walls.len() - 1).chain(walls);
        arriving.zip(walls).filter_map(|(arriving, leaving)| {
            let (before, at, after) = (arriving.a.as_dvec2(), leaving.a.as_dvec2(), leaving.b.as_dvec2());
            // A straight corner, or one that folds back, has no side to bend round, or two walls in one.
            let between = (before - at).normalize_or_zero() + (after - at).normalize_or_zero();
            if orient(before, at, after) == 0.0 {
                return None;
            }
            let near_m = 1e-3 * (before - at).length().min((after - at).length()).min(1e-3);
            let rock = self.in_rock_f64(at + between.normalize_or_zero() * near_m);
            rock.then_some(Corner { at: leaving.a, before, after, distance_m: f64::INFINITY })
        })
    }
}

/// The corner with the least finite distance.
fn nearest_of(open: &[Corner]) -> Option<usize> {
    let nearest = open.iter().enumerate().min_by(|(_, p), (_, q)| p.distance_m.total_cmp(&q.distance_m))?;
    (nearest.1.distance_m < f64::INFINITY).then_some(nearest.0)
}

impl Geodesic {
    /// Where distances are measured from (m).
    pub fn source(&self) -> Vec2 {
        self.source
    }

    /// Length of the shortest way through free space from the source to `p` (m); `None` if `p` is in rock or out of
    /// reach. `map` is the map this came from.
    pub fn distance_m(&self, map: &Map, p: Vec2) -> Option<f32> {
        if map.in_rock(p) {
            return None;
        }
        self.between_m(map, p, 0.0, f64::INFINITY).map(|distance_m| distance_m as f32)
    }

    /// The same as [`Geodesic::distance_m`] for somebody who travels: where `p` is in sight of the place asked for
    /// last, the answer differs from the last one by no more than the step between them, and hardly any corner
    /// needs to be looked at.
    pub fn follow_m(&self, map: &Map, trail: &mut Trail, p: Vec2) -> Option<f32> {
        if map.in_rock(p) {
            return None;
        }
        let near_last = trail.0.filter(|&(last, _)| map.sees(last, p)).and_then(|(last, distance_m)| {
            let step_m = last.as_dvec2().distance(p.as_dvec2()) + ROUNDING_M + ROUNDING * distance_m;
            self.between_m(map, p, distance_m - step_m, distance_m + step_m)
        });
        let distance_m = near_last.or_else(|| self.between_m(map, p, 0.0, f64::INFINITY));
        trail.0 = distance_m.map(|distance_m| (p, distance_m));
        distance_m.map(|distance_m| distance_m as f32)
    }

    /// The length of the shortest way if it lies between `least_m` and `most_m`.
    fn between_m(&self, map: &Map, p: Vec2, least_m: f64, most_m: f64) -> Option<f64> {
        let straight_m = f64::from(self.source.distance(p));
        if straight_m >= least_m && map.sees(self.source, p) {
            return Some(straight_m);
        }
        let to = p.as_dvec2();
        let mut best_m = None;
        let mut most_m = most_m;
        for corner in &self.corners {
            // They come in the order of their distance: after the first that is too far, all are.
            if corner.distance_m > most_m {
                break;
            }
            let total_m = corner.distance_m + corner.at.as_dvec2().distance(to);
            let better = total_m >= least_m && total_m <= most_m && best_m != Some(total_m);
            if better && corner.is_taut(to) && map.sees(corner.at, p) {
                best_m = Some(total_m);
                most_m = total_m;
            }
        }
        best_m
    }
}

/// Where somebody was last, and how far from the source (m).
#[derive(Debug, Clone, Copy, Default)]
pub struct Trail(Option<(Vec2, f64)>);
