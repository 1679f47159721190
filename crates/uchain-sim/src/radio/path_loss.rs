//! Path loss with shadowing by rock (Laclau 2021, Eq. 22, after Vinogradov 2018).

use glam::Vec2;

use crate::map::Map;

uchain_core::params! {
    /// Path loss between two antennas: `loss = L0 + 10 α log10(max(d, d0) / d0)` (Laclau 2021, Eq. 22).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct PathLossParams {
        /// Loss at the reference distance, L0 (dB). The paper omits it; from the authors' simulator.
        pub reference_loss_db: f32 = 35.0, in -50.0..=150.0;
        /// Reference distance, d0 (m).
        pub reference_m: f32 = 0.25, in 0.001..=100.0;
        /// Exponent α where nothing stands in the way.
        pub alpha_free: f32 = 2.0, in 0.0..=20.0;
        /// Exponent α where the whole segment runs through rock; in between, α grows with the fraction.
        pub alpha_wall: f32 = 6.0, in 0.0..=20.0;
        /// Standard deviation of a measured loss (dB).
        pub sigma_db: f32 = 3.0, in 0.0..=50.0;
    }
}

/// Loss without noise.
#[derive(Debug, Clone)]
pub struct PathLoss {
    params: PathLossParams,
}

impl PathLoss {
    /// A model with these parameters.
    pub fn new(params: PathLossParams) -> Self {
        Self { params }
    }

    /// Loss between two points of a map, noise off (dB).
    pub fn loss_db(&self, map: &Map, from: Vec2, to: Vec2) -> f32 {
        let p = &self.params;
        let rock = map.rock_fraction(from, to);
        let alpha = p.alpha_free + (p.alpha_wall - p.alpha_free) * rock;
        let distance_m = from.distance(to).max(p.reference_m);
        p.reference_loss_db + 10.0 * alpha * libm::log10f(distance_m / p.reference_m)
    }
}
