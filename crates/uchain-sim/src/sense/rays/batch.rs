//! Four walls against one line: the one test behind every reading.

use glam::Vec2;
use wide::f32x4;

use crate::map::Segment;

/// Walls in a batch.
pub(super) const LANES: usize = 4;

/// Four walls side by side, one cache line. A lane without a wall holds NaN, which no line meets.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct Batch {
    ax: f32x4,
    ay: f32x4,
    bx: f32x4,
    by: f32x4,
}

impl Batch {
    pub(super) const EMPTY: Self = {
        let nan = f32x4::new([f32::NAN; LANES]);
        Self { ax: nan, ay: nan, bx: nan, by: nan }
    };

    /// Puts a wall into one of the lanes, NaN takes it out again.
    pub(super) fn set(&mut self, lane: usize, wall: &Segment) {
        let lanes = [
            (&mut self.ax, wall.a.x),
            (&mut self.ay, wall.a.y),
            (&mut self.bx, wall.b.x),
            (&mut self.by, wall.b.y),
        ];
        for (lanes, value) in lanes {
            if let Some(lane) = lanes.as_mut_array().get_mut(lane) {
                *lane = value;
            }
        }
    }

    /// The walls as seen from a point.
    #[inline]
    pub(super) fn from(&self, from: Vec2) -> Seen {
        let (x, y) = (f32x4::splat(from.x), f32x4::splat(from.y));
        Seen { px: self.ax - x, py: self.ay - y, qx: self.bx - x, qy: self.by - y }
    }
}

/// Ends `p` and `q` of four walls relative to the point that lines pass through.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    px: f32x4,
    py: f32x4,
    qx: f32x4,
    qy: f32x4,
}

impl Seen {
    /// Where a line meets the walls, in lengths of its direction, negative behind; NaN where it passes a wall by.
    ///
    /// Along and aside of the line, the ends of a wall are `(tp, sp)` and `(tq, sq)`. The line meets it where `sp` and
    /// `sq` differ in sign or are zero: walls that share a corner share those bits, so nothing slips in between. There
    /// `t` is the mean of `tp` and `tq` weighted by `|sq|` and `|sp|`: however flat the angle, it lies between them.
    /// Signs are compared, not multiplied, since a product may underflow. A wall along the line (0/0) is passed by; its
    /// neighbours are not. No sum is fused, so that every processor gives the same bits.
    #[inline]
    fn meet(&self, line: Vec2) -> f32x4 {
        let (x, y) = (f32x4::splat(line.x), f32x4::splat(line.y));
        let (sp, sq) = (x * self.py - y * self.px, x * self.qy - y * self.qx);
        let (tp, tq) = (x * self.px + y * self.py, x * self.qx + y * self.qy);
        let passed = sp.fast_min(sq).simd_gt(f32x4::ZERO) | sp.fast_max(sq).simd_lt(f32x4::ZERO);
        // A mask of ones is a NaN.
        ((tp * sq - tq * sp) / (sq - sp)) | passed
    }

    /// Takes up the distance ahead.
    #[inline]
    pub(super) fn ahead(&self, line: Vec2, nearest: &mut Nearest) {
        let t = self.meet(line);
        nearest.0 = t.simd_ge(f32x4::ZERO).select(t, nearest.0).fast_min(nearest.0);
    }

    /// Takes up the distances ahead and behind. One test serves both: what lies behind has a negative `t`.
    #[inline]
    pub(super) fn both(&self, line: Vec2, [ahead, behind]: &mut [Nearest; 2]) {
        let t = self.meet(line);
        ahead.0 = t.simd_ge(f32x4::ZERO).select(t, ahead.0).fast_min(ahead.0);
        behind.0 = t.simd_le(f32x4::ZERO).select(-t, behind.0).fast_min(behind.0);
    }
}

/// The shortest distances so far, one a lane.
#[derive(Clone, Copy)]
pub(super) struct Nearest(f32x4);

impl Nearest {
    #[inline]
    pub(super) fn within(range: f32) -> Self {
        Self(f32x4::splat(range))
    }

    /// The shortest of all.
    #[inline]
    pub(super) fn least(self) -> f32 {
        let [a, b, c, d] = self.0.to_array();
        // A zero has its sign from the order of the walls.
        let less = |a: f32, b: f32| if a < b { a } else { b };
        less(less(a, b), less(c, d)) + 0.0
    }
}
