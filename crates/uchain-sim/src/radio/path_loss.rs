//! Path loss with shadowing by rock (Laclau 2021, Eq. 22, after Vinogradov 2018).

use glam::Vec2;

use crate::map::{Map, MapError, Ways};

/// How rock in the way raises the exponent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Shadowing {
    /// By the fraction of the segment inside rock.
    #[default]
    MeanExponent,
    /// By a step for every separate stretch of rock.
    WallCount,
}

uchain_core::params! {
    /// Path loss between two antennas: `loss = L0 + 10 α log10(max(d, d0) / d0)` (Laclau 2021, Eq. 22).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct PathLossParams {
        /// Loss at the reference distance (dB).
        /// - Symbol: `L0`
        /// - Equation: `loss = L0 + 10 α log10(max(d, d0) / d0)`
        /// - Source: the authors' simulator; Laclau 2021, Eq. 22 omits it
        pub reference_loss_db: f32 = 35.0, in -50.0..=150.0;
        /// Reference distance (m); nearer antennas lose no less.
        /// - Symbol: `d0`
        /// - Equation: `loss = L0 + 10 α log10(max(d, d0) / d0)`
        /// - Source: the authors' simulator; Laclau 2021, Eq. 22 omits it
        pub reference_m: f32 = 0.25, in 0.001..=100.0;
        /// How rock in the way raises the exponent.
        /// - Source: Laclau 2021, §6.1.2
        pub shadowing: Shadowing = Shadowing::MeanExponent;
        /// Exponent where nothing stands in the way (1).
        /// - Symbol: `α`
        /// - Equation: `loss = L0 + 10 α log10(max(d, d0) / d0)`
        /// - Source: Laclau 2021, §6.1.2 (2 to 6); 2.5 in its Fig. 4A-C, 1.5 in Fig. 4D-F
        pub alpha_free: f32 = 2.0, in 0.0..=20.0;
        /// Exponent where the whole segment runs through rock; the largest exponent of "wall-count" (1).
        /// - Symbol: `α_wall`
        /// - Equation: `α = α_free + (α_wall - α_free) f`, f the fraction of the segment inside rock
        /// - Source: Laclau 2021, §6.1.2 (2 to 6); 4.0 in its Fig. 4
        pub alpha_wall: f32 = 6.0, in 0.0..=20.0;
        /// Step of the exponent for each stretch of rock, with "wall-count" (1).
        /// - Equation: `α = min(α_wall, α_free + step n)`, n the stretches of rock
        /// - Source: ours
        pub alpha_step: f32 = 2.0, in 0.0..=20.0;
        /// Loss per metre by which the way through the tunnel differs from the straight one (dB/m).
        /// - Equation: `loss = … + detour |tunnel distance - d|`
        /// - Source: the authors' simulator: 40 in Laclau 2021, Fig. 4D-F
        pub detour_db_per_m: f32 = 0.0, in 0.0..=1000.0;
        /// Loss of an antenna that sees its partner dead ahead, behind or abeam; none at ±45° and ±135° (dB).
        /// - Source: Laclau 2021, §6.1.2; the paper gives no number
        pub antenna_db: f32 = 0.0, in 0.0..=100.0;
        /// Standard deviation of a measured loss (dB).
        /// - Symbol: `σ`
        /// - Equation: `measured loss = loss + N(0, σ²)`
        /// - Source: the authors' simulator; Laclau 2021, §6.1.2 prints a variance of 3
        pub sigma_db: f32 = 3.0, in 0.0..=50.0;
    }
}

/// One end of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Antenna {
    /// Place (m).
    pub at: Vec2,
    /// Direction of the body that carries it (rad); `None` for the base station, which has no rotors.
    pub heading_rad: Option<f32>,
}

impl From<Vec2> for Antenna {
    /// An antenna without direction.
    fn from(at: Vec2) -> Self {
        Self { at, heading_rad: None }
    }
}

/// Loss without noise.
#[derive(Debug, Clone)]
pub struct PathLoss {
    params: PathLossParams,
    /// Tunnel distances, where loss depends on them.
    ways: Option<Ways>,
}

impl PathLoss {
    /// A model with these parameters, for one map.
    ///
    /// # Errors
    /// With a detour, the map's tunnel distances must be had: [`Map::ways`].
    pub fn new(params: PathLossParams, map: &Map) -> Result<Self, MapError> {
        let ways = if params.detour_db_per_m > 0.0 { Some(map.ways()?) } else { None };
        Ok(Self { params, ways })
    }

    /// Loss between two antennas in the model's map, noise off (dB). Where no way through the tunnel joins
    /// them, there is no detour to count.
    pub fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let p = &self.params;
        let alpha = match p.shadowing {
            Shadowing::MeanExponent => {
                p.alpha_free + (p.alpha_wall - p.alpha_free) * map.rock_fraction(from.at, to.at)
            }
            Shadowing::WallCount => {
                let raised = p.alpha_free + p.alpha_step * map.rock_stretches(from.at, to.at) as f32;
                raised.min(p.alpha_wall)
            }
        };
        let straight_m = from.at.distance(to.at);
        let ratio = straight_m.max(p.reference_m) / p.reference_m;
        let mut loss_db = p.reference_loss_db + 10.0 * alpha * libm::log10f(ratio);
        if let Some(way_m) = self.ways.as_ref().and_then(|ways| ways.distance_m(map, from.at, to.at)) {
            loss_db += p.detour_db_per_m * (way_m - straight_m).abs();
        }
        if p.antenna_db > 0.0 {
            loss_db += p.antenna_db * (aim(from, to.at) + aim(to, from.at));
        }
        loss_db
    }
}

/// Share of its loss an antenna has toward a place: 0 at ±45° and ±135°, 1 along the body's axes.
fn aim(antenna: &Antenna, toward: Vec2) -> f32 {
    let way = toward - antenna.at;
    antenna.heading_rad.filter(|_| way != Vec2::ZERO).map_or(0.0, |heading_rad| {
        let cos = libm::cosf(2.0 * (libm::atan2f(way.y, way.x) - heading_rad));
        cos * cos
    })
}

#[cfg(test)]
mod tests;
