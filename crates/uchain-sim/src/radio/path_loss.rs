//! Path loss with shadowing by rock (Laclau 2021, Eq. 22, after Vinogradov 2018).

use std::sync::Arc;

use glam::Vec2;

use super::{Antenna, RadioError, RadioKind, RadioModel, RadioParams, Shadowing};
use crate::map::{Map, MapError, Ways};

/// The model "path-loss".
#[derive(Debug, Clone)]
pub struct PathLoss {
    params: RadioParams,
    /// Tunnel distances, where loss depends on them.
    ways: Option<Ways>,
}

impl PathLoss {
    /// Its word in a scenario.
    pub const WORD: &'static str = "path-loss";

    pub(super) const KIND: RadioKind =
        RadioKind::new(Self::WORD, "By distance and the rock in the way (Laclau 2021, Eq. 22).", Self::make);

    /// A model with these parameters, for one map.
    ///
    /// # Errors
    /// With a detour, the map's tunnel distances must be had: [`Map::ways`].
    pub fn new(params: RadioParams, map: &Map) -> Result<Self, MapError> {
        let ways = if params.detour_db_per_m > 0.0 { Some(map.ways()?) } else { None };
        Ok(Self { params, ways })
    }

    /// Loss over a distance (m) by an exponent.
    fn by_distance_db(&self, straight_m: f32, alpha: f32) -> f32 {
        let p = &self.params;
        let ratio = straight_m.max(p.reference_m) / p.reference_m;
        p.reference_loss_db + 10.0 * alpha * libm::log10f(ratio)
    }

    /// As a scenario asks for it.
    fn make(params: &RadioParams, map: &Map) -> Result<Arc<dyn RadioModel>, RadioError> {
        let made = Self::new(params.clone(), map);
        let made = made.map_err(|cause| RadioError::Map { key: "detour_db_per_m", cause })?;
        Ok(Arc::new(made))
    }
}

impl RadioModel for PathLoss {
    /// Where no way through the tunnel joins two antennas, there is no detour to count. The map is the model's own.
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
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
        let mut loss_db = self.by_distance_db(straight_m, alpha);
        if let Some(way_m) = self.ways.as_ref().and_then(|ways| ways.distance_m(map, from.at, to.at)) {
            loss_db += p.detour_db_per_m * (way_m - straight_m).abs();
        }
        if p.antenna_db > 0.0 {
            loss_db += p.antenna_db * (aim(from, to.at) + aim(to, from.at));
        }
        loss_db
    }

    /// That of a clear line, or of one through rock where rock dampens less. A share of rock between none and all lies
    /// between the two, rounding included.
    fn least_loss_db(&self, apart_m: f32) -> f32 {
        let p = &self.params;
        let rock = match p.shadowing {
            Shadowing::MeanExponent => p.alpha_free + (p.alpha_wall - p.alpha_free),
            Shadowing::WallCount => p.alpha_wall,
        };
        self.by_distance_db(apart_m, p.alpha_free.min(rock))
    }

    fn key(&self) -> Option<String> {
        // Neither noise nor what other models go by, nor what is around this one.
        let p = &self.params;
        let numbers = [
            p.reference_loss_db,
            p.reference_m,
            p.alpha_free,
            p.alpha_wall,
            p.alpha_step,
            p.detour_db_per_m,
            p.antenna_db,
        ];
        Some(format!("{} {:?} {numbers:?}", Self::WORD, p.shadowing))
    }

    fn is_costly(&self) -> bool {
        self.ways.is_some()
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
