//! What stands in for a tunnel and a radio: a straight line, losses that grow with distance, and noise. Basic arithmetic
//! only: the same bits everywhere.

use uchain_core::{bounded, chain::Tof};

/// Numbers that look like chance, the same ones every time.
#[derive(Debug)]
pub(crate) struct Chance(u32);

impl Chance {
    pub(crate) fn new(seed: u32) -> Self {
        Self(seed)
    }

    /// A number from 0 up to 1.
    pub(crate) fn share(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / 16_777_216.0
    }

    /// A number as far from 0 as this, at most.
    pub(crate) fn within(&mut self, most: f32) -> f32 {
        most * (2.0 * self.share() - 1.0)
    }

    pub(crate) fn happens(&mut self, rate: f32) -> bool {
        self.share() < rate
    }
}

/// Where a UAV is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Body {
    /// How deep in the tunnel (m).
    pub(crate) at_m: f32,
    /// How far to the left of its middle (m).
    pub(crate) left_m: f32,
    pub(crate) speed_mps: f32,
}

/// Half the width of the tunnel (m).
const HALF_M: f32 = 0.5;
/// How long a diagonal is whose sides are 1.
const DIAGONAL: f32 = core::f32::consts::SQRT_2;

impl Body {
    /// Loss to somebody else (dB).
    pub(crate) fn loss_db(&self, other_m: f32, chance: &mut Chance) -> f32 {
        35.0 + 5.0 * (self.at_m - other_m).abs() + chance.within(1.5)
    }

    /// Its four beams, one of which sees nothing now and then, or says rubbish (m).
    pub(crate) fn tof(&self, chance: &mut Chance) -> Tof {
        let mut beam = |clear_m: f32| {
            let read_m = DIAGONAL * clear_m + chance.within(0.02);
            match chance.share() {
                share if share < 0.01 => f32::NAN,
                share if share < 0.02 => -1.0,
                share if share < 0.04 => 2.0,
                _ => read_m,
            }
        };
        let (left_m, right_m) = (HALF_M - self.left_m, HALF_M + self.left_m);
        Tof { nw_m: beam(left_m), ne_m: beam(right_m), sw_m: beam(left_m), se_m: beam(right_m) }
    }

    /// Flies for one tick of 0.05 s.
    pub(crate) fn fly(&mut self, forward_mps: f32, lateral_mps: f32) {
        self.speed_mps += 0.2 * (forward_mps - self.speed_mps);
        self.at_m += 0.05 * self.speed_mps;
        self.left_m = bounded(self.left_m + 0.05 * lateral_mps, -0.4, 0.4);
    }
}
