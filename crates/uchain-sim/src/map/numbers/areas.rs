//! The area of free space, exact, piece by piece.

use glam::DVec2;

use crate::map::{Map, Segment, geometry::orient};

/// One loop of walls: its leftmost corner, the area within (m²), and whether free space is within.
struct Loop {
    leftmost: DVec2,
    area_m2: f64,
    around_free: bool,
}

impl Loop {
    fn of(map: &Map, walls: &[Segment]) -> Option<Self> {
        let origin = walls.first()?.a.as_dvec2();
        let cross = |wall: &Segment| (wall.a.as_dvec2() - origin).perp_dot(wall.b.as_dvec2() - origin);
        let area_m2 = walls.iter().map(cross).sum::<f64>().abs() / 2.0;
        let key = |wall: &Segment| (wall.a.x, wall.a.y);
        let least = |p: (f32, f32), q: (f32, f32)| p.0.total_cmp(&q.0).then(p.1.total_cmp(&q.1));
        let (leaving, wall) = walls.iter().enumerate().min_by(|(_, p), (_, q)| least(key(p), key(q)))?;
        let before = walls[(leaving + walls.len() - 1) % walls.len()].a.as_dvec2();
        let (at, after) = wall.ends();
        // A hair into the loop: between the two walls at its leftmost corner.
        let inward = (before - at).normalize_or_zero() + (after - at).normalize_or_zero();
        let least_m = before.distance(at).min(after.distance(at));
        let inside = at + inward.normalize_or_zero() * (1e-6 * least_m);
        let flat = orient(before, at, after) == 0.0;
        Some(Self { leftmost: at, area_m2, around_free: !flat && !map.in_rock_f64(inside) })
    }
}

impl Map {
    /// The area of every separate piece of free space (m²), the largest first. Exact where no two loops cross.
    pub fn free_areas_m2(&self) -> Vec<f64> {
        let loops: Vec<Loop> = self.loops().filter_map(|walls| Loop::of(self, walls)).collect();
        let mut area_m2: Vec<f64> =
            loops.iter().map(|of| if of.around_free { of.area_m2 } else { 0.0 }).collect();
        // From left to right, so that what stands to the left of a piece of rock has been found already.
        let mut rocks: Vec<usize> = (0..loops.len()).filter(|&index| !loops[index].around_free).collect();
        rocks.sort_by(|&p, &q| loops[p].leftmost.x.total_cmp(&loops[q].leftmost.x));
        let mut piece_of: Vec<Option<usize>> =
            loops.iter().enumerate().map(|(index, of)| of.around_free.then_some(index)).collect();
        for rock in rocks {
            let left = self.loop_left_of(loops[rock].leftmost);
            piece_of[rock] = left.and_then(|left| piece_of.get(left).copied().flatten());
            if let Some(piece) = piece_of[rock] {
                area_m2[piece] -= loops[rock].area_m2;
            }
        }
        let mut pieces: Vec<f64> = loops
            .iter()
            .zip(area_m2)
            .filter(|(of, _)| of.around_free)
            .map(|(_, area)| area.max(0.0))
            .collect();
        pieces.sort_by(|p, q| q.total_cmp(p));
        pieces
    }

    /// The loop whose wall is the first to the left of a place.
    fn loop_left_of(&self, at: DVec2) -> Option<usize> {
        let cell = self.grid.cell_at(at)?;
        let mut best: Option<(f64, u32)> = None;
        for cell in self.grid.cells_of_row(cell).start..=cell {
            for &wall in self.grid.walls_of(cell) {
                let (u, v) = self.walls[wall as usize].ends();
                if (u.y > at.y) == (v.y > at.y) {
                    continue;
                }
                let x = u.x + (v.x - u.x) * ((at.y - u.y) / (v.y - u.y));
                if x < at.x && best.is_none_or(|(farthest, _)| x > farthest) {
                    best = Some((x, wall));
                }
            }
        }
        best.map(|(_, wall)| self.loops.partition_point(|&start| start <= wall as usize).saturating_sub(1))
    }
}
