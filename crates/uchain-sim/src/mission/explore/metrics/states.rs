//! Where robots were over time.

use crate::mission::explore::ExploreFrame;

/// Most instants that are kept.
const MOMENTS_MAX: usize = 4096;

/// All robots at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// When (s).
    pub time_s: f64,
    /// Per robot, its place (m), in the map's frame.
    pub at_m: Vec<[f32; 3]>,
    /// Per robot, its heading (rad).
    pub heading_rad: Vec<f32>,
    /// Whether any of them was on another level to keep clear of others.
    pub mfl: bool,
}

/// Evenly spaced instants, in bounded memory: of long explorations fewer.
#[derive(Debug, Clone, Default)]
pub struct States {
    /// The instants, in order.
    pub moments: Vec<Moment>,
    /// Ticks between two of them, as a power of two.
    spacing: u32,
}

impl States {
    /// One tick has passed.
    pub(super) fn look(&mut self, frame: &ExploreFrame) {
        if !frame.tick.is_multiple_of(1 << self.spacing) {
            return;
        }
        self.moments.push(Moment {
            time_s: frame.time_s(),
            at_m: frame.robots.iter().map(|robot| [robot.x_m, robot.y_m, robot.z_m]).collect(),
            heading_rad: frame.robots.iter().map(|robot| robot.heading_rad).collect(),
            mfl: frame.robots.iter().any(|robot| robot.mfl),
        });
        if self.moments.len() > MOMENTS_MAX {
            // The kept ones are those of even multiples; the first is an odd one.
            let mut index = 0_u32;
            self.moments.retain(|_| {
                index += 1;
                index.is_multiple_of(2)
            });
            self.spacing += 1;
        }
    }
}
