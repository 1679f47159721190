//! Places on the walls: enough of them that the middle between them is the middle between the walls.

use glam::DVec2;
use uchain_core::bounded;

use super::{MOST_PLACES, delaunay::Delaunay};
use crate::map::{Map, MapError, geometry::distance_squared, skeleton::NARROWEST_M};

/// Longest piece of a wall to begin with, in cells of the map's grid: what is near a piece is found cell by cell.
const LONGEST_CELLS: f64 = 8.0;
/// Most looks at walls: where tens of thousands of them meet at one place, each search looks at all.
const MOST_LOOKS: u64 = 300_000_000;
/// A wall may come nearer to the middle between places than these by this share: 1 would ask for places without end.
const TRUE: f64 = 0.85;
/// The same beside a corner of two walls. The middle runs into a right angle at 1/√2 all the way, and is cut off there.
const TRUE_IN_CORNERS: f64 = 0.7;
/// The same for a middle that is off in rock.
const TRUE_IN_ROCK: f64 = 0.95;

/// Triangles between places on the walls, with the middle of free space in the middles of their circles.
pub(super) fn triangles(map: &Map) -> Result<Delaunay, MapError> {
    let (low, high) = map.bounds();
    let (low, high) = (low.as_dvec2(), high.as_dvec2());
    let margin = DVec2::splat((high - low).max_element().max(1.0));
    let mut triangles = Delaunay::new(low - margin, high + margin);
    let mut changed = Vec::new();
    let mut looks = Looks(MOST_LOOKS);
    for place in in_good_order(first(map, &mut looks)?, low, high) {
        triangles.insert(place, &mut changed);
        changed.clear();
    }
    refine(map, &mut triangles, &mut looks)?;
    Ok(triangles)
}

/// How many walls may still be looked at.
struct Looks(u64);

impl Looks {
    /// After looking at so many.
    fn spend(&mut self, walls: u64) -> Result<(), MapError> {
        self.0 = self.0.saturating_sub(walls);
        if self.0 > 0 { Ok(()) } else { Err(too_many(MOST_PLACES + 1)) }
    }
}

fn too_many(got: usize) -> MapError {
    MapError::Count {
        what: "places on the walls that the tunnel graph needs",
        got,
        least: 3,
        most: MOST_PLACES,
    }
}

/// The corners, and places between them so that no other wall comes into the circle over two neighbours.
fn first(map: &Map, looks: &mut Looks) -> Result<Vec<DVec2>, MapError> {
    let mut places = Vec::with_capacity(map.walls.len());
    let longest_m = LONGEST_CELLS * map.grid.cell_m();
    let mut open = Vec::new();
    for (index, wall) in map.walls.iter().enumerate() {
        let (a, b) = wall.ends();
        let pieces = (a.distance(b) / longest_m).ceil().max(1.0);
        let at = |piece: u32| a.lerp(b, f64::from(piece) / pieces);
        open.extend((0..pieces as u32).map(|piece| (at(piece), at(piece + 1))));
        while let Some((a, b)) = open.pop() {
            let (middle, half_m) = (a.midpoint(b), a.distance(b) / 2.0);
            let least = half_m * half_m * (1.0 - 1e-9);
            if half_m > NARROWEST_M / 2.0 && map.another_wall_within(middle, half_m, index, least, looks)? {
                open.extend([(a, middle), (middle, b)]);
            } else {
                places.push(a);
            }
            if places.len() > MOST_PLACES {
                return Err(too_many(places.len()));
            }
        }
    }
    Ok(places)
}

impl Map {
    /// Whether a wall other than this one comes nearer to a place than so much (m², less than `reach_m` squared).
    fn another_wall_within(
        &self,
        at: DVec2,
        reach_m: f64,
        than: usize,
        distance_m2: f64,
        looks: &mut Looks,
    ) -> Result<bool, MapError> {
        let (mut found, mut walls) = (false, 0);
        self.grid.within(at - reach_m, at + reach_m, |wall| {
            walls += 1;
            if !found && wall as usize != than {
                let (a, b) = self.walls[wall as usize].ends();
                found = distance_squared(a, b, at) < distance_m2;
            }
        });
        looks.spend(walls)?;
        Ok(found)
    }
}

/// Few first, more and more afterwards, and neighbours after neighbours each time (Amenta et al. 2003): searches stay short
/// however the walls run.
fn in_good_order(places: Vec<DVec2>, low: DVec2, high: DVec2) -> impl Iterator<Item = DVec2> {
    let scale = f64::from(u16::MAX) / (high - low).max_element().max(1e-6);
    let mut keyed: Vec<(u32, u32, DVec2)> = places
        .into_iter()
        .enumerate()
        .map(|(index, place)| {
            let cell = ((place - low) * scale).max(DVec2::ZERO);
            // Any number that looks random and is always the same: the index, scattered by the golden ratio.
            let scattered = (index as u64).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32;
            (scattered.trailing_zeros().min(32), hilbert(cell.x as u32, cell.y as u32), place)
        })
        .collect();
    keyed.sort_by(|p, q| q.0.cmp(&p.0).then(p.1.cmp(&q.1)));
    keyed.into_iter().map(|(_, _, place)| place)
}

/// How far along Hilbert's curve through 65,536 × 65,536 cells a cell lies.
fn hilbert(mut x: u32, mut y: u32) -> u32 {
    const SIDE: u32 = 1 << 16;
    let mut along: u32 = 0;
    let mut half = SIDE / 2;
    while half > 0 {
        let (right, up) = (u32::from(x & half > 0), u32::from(y & half > 0));
        along = along.wrapping_add(half.wrapping_mul(half).wrapping_mul((3 * right) ^ up));
        if up == 0 {
            if right == 1 {
                (x, y) = ((SIDE - 1).wrapping_sub(x), (SIDE - 1).wrapping_sub(y));
            }
            (x, y) = (y, x);
        }
        half /= 2;
    }
    along
}

/// Adds the place on a wall nearest to the middle of a circle wherever that wall cuts deep into the circle.
fn refine(map: &Map, triangles: &mut Delaunay, looks: &mut Looks) -> Result<(), MapError> {
    let mut open: Vec<u32> = (0..triangles.count() as u32).rev().collect();
    let mut changed = Vec::new();
    while let Some(triangle) = open.pop() {
        let (middle, radius_m) = triangles.circle(triangle as usize);
        if !(middle.is_finite() && radius_m > NARROWEST_M / 2.0) {
            continue;
        }
        let corners = triangles.corners(triangle as usize).map(|corner| triangles.places()[corner as usize]);
        let rock = map.in_rock_f64(middle);
        if rock && map.in_rock_f64((corners[0] + corners[1] + corners[2]) / 3.0) {
            continue;
        }
        let Some((wall, nearest)) = map.nearest_on_walls(middle, looks)? else { continue };
        let (a, b) = map.walls[wall].ends();
        let share = if rock {
            TRUE_IN_ROCK
        } else if corners.contains(&a) || corners.contains(&b) {
            TRUE_IN_CORNERS
        } else {
            TRUE
        };
        if nearest.distance(middle) < share * radius_m && triangles.insert(nearest, &mut changed) {
            open.append(&mut changed);
            if triangles.places().len() > MOST_PLACES {
                return Err(too_many(triangles.places().len()));
            }
        }
    }
    Ok(())
}

impl Map {
    /// The wall nearest to a place, and its nearest point (m).
    fn nearest_on_walls(&self, p: DVec2, looks: &mut Looks) -> Result<Option<(usize, DVec2)>, MapError> {
        let (mut best_m2, mut nearest, mut walls) = (f64::INFINITY, None, 0);
        let mut look = |wall: usize| {
            let (a, b) = self.walls[wall].ends();
            let squared = distance_squared(a, b, p);
            walls += 1;
            if squared < best_m2 {
                (best_m2, nearest) = (squared, Some(wall));
            }
            best_m2
        };
        if self.grid.cell_at(p).is_none() {
            for wall in 0..self.walls.len() {
                look(wall);
            }
        } else {
            let mut found_m2 = f64::INFINITY;
            for ring in 0.. {
                let sure_m = self.grid.ring(p, ring, |cell| {
                    for &wall in self.grid.walls_of(cell) {
                        found_m2 = look(wall as usize);
                    }
                });
                if sure_m.is_none_or(|sure_m| found_m2 <= sure_m * sure_m) {
                    break;
                }
            }
        }
        looks.spend(walls)?;
        Ok(nearest.map(|wall| {
            let (a, b) = self.walls[wall].ends();
            let along = b - a;
            let share = bounded((p - a).dot(along) / along.length_squared(), 0.0, 1.0);
            (wall, a + along * share)
        }))
    }
}
