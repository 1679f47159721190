//! Shortest ways between any two places, for those who ask often and from everywhere.
//!
//! A [`Geodesic`](super::Geodesic) knows the ways from one source. Here the ways between all corners are worked out
//! once; a query joins its two ends to the corners they see.

use glam::Vec2;

use super::{Map, MapError, geodesic::Corner};

/// Most corners of rock all ways are worked out for: memory grows with their square.
pub(super) const MOST_CORNERS: usize = 2_500;

/// Lengths of the shortest ways between all corners of a map.
#[derive(Debug, Clone)]
pub struct Ways {
    corners: Vec<Corner>,
    /// Row by row, from each corner to each (m); infinite where there is no way.
    between_m: Vec<f32>,
}

impl Map {
    /// Works out the ways between all corners of rock.
    ///
    /// # Errors
    /// More than 2,500 corners that stick into free space; walls that cross or touch.
    pub fn ways(&self) -> Result<Ways, MapError> {
        let corners = self.corners_in_the_way(MOST_CORNERS)?;
        let steps: Vec<Vec<(usize, f32)>> = corners
            .iter()
            .enumerate()
            .map(|(i, here)| {
                let steps =
                    corners.iter().enumerate().filter(|(j, there)| i != *j && self.joins(here, there));
                steps.map(|(j, there)| (j, here.at.distance(there.at))).collect()
            })
            .collect();
        let between_m = (0..corners.len()).flat_map(|i| distances_m(&steps, i)).collect();
        Ok(Ways { corners, between_m })
    }

    /// Whether a string can run from one corner to the other and bend round both.
    fn joins(&self, here: &Corner, there: &Corner) -> bool {
        here.is_taut(there.at.as_dvec2()) && there.is_taut(here.at.as_dvec2()) && self.sees(here.at, there.at)
    }
}

/// Dijkstra from one corner.
///
/// A search of its own: it runs from every node of one dense graph that never grows. The roadmap's
/// (`uchain_core::explore::Dijkstra`), whose arcs are chains that do, gives the same bits and takes four times as long
/// on 2,300 corners.
fn distances_m(steps: &[Vec<(usize, f32)>], from: usize) -> Vec<f32> {
    let mut distances_m = vec![f32::INFINITY; steps.len()];
    distances_m[from] = 0.0;
    // Distances are positive, so their bits sort as they do.
    let mut open = std::collections::BinaryHeap::from([(std::cmp::Reverse(0_u32), from)]);
    while let Some((std::cmp::Reverse(bits), here)) = open.pop() {
        let distance_m = f32::from_bits(bits);
        if distance_m > distances_m[here] {
            continue;
        }
        for &(there, step_m) in &steps[here] {
            if distance_m + step_m < distances_m[there] {
                distances_m[there] = distance_m + step_m;
                open.push((std::cmp::Reverse(distances_m[there].to_bits()), there));
            }
        }
    }
    distances_m
}

impl Ways {
    /// Length of the shortest way through free space from `a` to `b` (m); `None` if one of them is in rock or no way
    /// joins them. `map` is the map this came from.
    pub fn distance_m(&self, map: &Map, a: Vec2, b: Vec2) -> Option<f32> {
        if map.in_rock(a) || map.in_rock(b) {
            return None;
        }
        if map.sees(a, b) {
            return Some(a.distance(b));
        }
        let (from_a, from_b) = (self.seen_from(map, a), self.seen_from(map, b));
        let n = self.corners.len();
        let mut best_m = f32::INFINITY;
        for &(i, first_m) in &from_a {
            for &(j, last_m) in &from_b {
                best_m = best_m.min(first_m + self.between_m[i * n + j] + last_m);
            }
        }
        best_m.is_finite().then_some(best_m)
    }

    /// Corners a string from `p` can bend round first, with their distances.
    fn seen_from(&self, map: &Map, p: Vec2) -> Vec<(usize, f32)> {
        let to = p.as_dvec2();
        let seen = |corner: &Corner| corner.is_taut(to) && map.sees(p, corner.at);
        let corners = self.corners.iter().enumerate().filter(|(_, corner)| seen(corner));
        corners.map(|(i, corner)| (i, p.distance(corner.at))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        map::{Vertex, corridor},
        seed::{Seed, Source},
    };

    #[test]
    fn ways_between_any_two_places_are_as_long_as_the_geodesic_from_either() {
        let vertex = |x, y, bend_radius_m| Vertex { x, y, bend_radius_m };
        let line =
            [vertex(0.0, 0.0, 0.0), vertex(5.0, 0.0, 1.0), vertex(5.0, 4.0, 0.0), vertex(0.0, 4.0, 0.0)];
        let (map, _) = corridor(&line, 1.0, false).unwrap();
        let ways = map.ways().unwrap();
        let mut random = Seed(1).stream(0, Source::Start);
        let mut point = || Vec2::new(6.0 * random.uniform() - 0.5, 5.0 * random.uniform() - 0.5);
        let mut compared = 0;
        while compared < 300 {
            let (a, b) = (point(), point());
            let Ok(geodesic) = map.geodesic(a) else {
                assert_eq!(ways.distance_m(&map, a, b), None);
                continue;
            };
            match (geodesic.distance_m(&map, b), ways.distance_m(&map, a, b)) {
                (Some(expected), Some(got)) => {
                    assert!((expected - got).abs() < 1e-4, "{a} {b}: {expected} {got}");
                }
                (expected, got) => assert_eq!(expected, got),
            }
            compared += 1;
        }
    }
}
