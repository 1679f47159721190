//! Loss by the distance alone, along one straight line over its logarithm or two.

use std::sync::Arc;

use crate::{
    map::Map,
    radio::{Antenna, NO_LINK_DB, RadioError, RadioKind, RadioModel, RadioParams},
};

/// The models "log-distance", "p1238" and "two-slope".
#[derive(Debug, Clone, PartialEq)]
pub struct Slopes {
    word: &'static str,
    /// Where a loss is known (m), and which (dB).
    known: (f32, f32),
    /// Nearer antennas lose no less (m).
    nearest_m: f32,
    /// Exponent from there on (1).
    exponent: f32,
    /// From where on there is another (m), and which.
    then: Option<(f32, f32)>,
    /// How far a link reaches (m).
    range_m: f32,
}

impl Slopes {
    /// Their words in a scenario.
    pub const LOG_DISTANCE: &'static str = "log-distance";
    /// ITU-R P.1238.
    pub const P1238: &'static str = "p1238";
    /// Near and far in a tunnel.
    pub const TWO_SLOPE: &'static str = "two-slope";

    pub(in crate::radio) const KINDS: [RadioKind; 3] = [
        RadioKind::new(
            Self::LOG_DISTANCE,
            "By distance and radio.exponent, walls left out; the defaults are those of Gazebo's RFComms.",
            |params, _| Ok(Arc::new(Self::log_distance(params, Self::LOG_DISTANCE))),
        ),
        RadioKind::new(
            Self::P1238,
            "By distance and radio.p1238_n, for one floor of a building (ITU-R P.1238-7).",
            |params, _| Ok(Arc::new(Self::p1238(params))),
        ),
        RadioKind::new(
            Self::TWO_SLOPE,
            "By radio.exponent up to radio.break_m and by radio.exponent_far beyond, as in tunnels (Zhang 2003).",
            |params, _| Self::two_slope(params),
        ),
    ];

    /// Gazebo's loss at a metre (dB): `l0` of RFComms.
    const GAZEBO_DB: f32 = 40.0;

    /// As a scenario asks for it.
    pub(super) fn log_distance(params: &RadioParams, word: &'static str) -> Self {
        Self {
            word,
            known: params.known(Self::GAZEBO_DB),
            nearest_m: params.reference_m,
            exponent: params.exponent,
            then: None,
            range_m: params.range_m.unwrap_or(f32::INFINITY),
        }
    }

    /// `L = 20 log10 f + N log10 d + Lf(n) - 28`, no floor between.
    fn p1238(params: &RadioParams) -> Self {
        let at_a_metre_db = 20.0 * libm::log10f(params.frequency_mhz) - 28.0;
        Self {
            known: params.known(at_a_metre_db),
            exponent: 0.1 * params.p1238_n,
            ..Self::log_distance(params, Self::P1238)
        }
    }

    fn two_slope(params: &RadioParams) -> Result<Arc<dyn RadioModel>, RadioError> {
        let (break_m, least_m) = (params.break_m, params.reference_m);
        if break_m < least_m {
            return Err(RadioError::Value {
                key: "break_m",
                got: break_m.to_string(),
                expected: format!("at least radio.reference_m = {least_m}"),
            });
        }
        let known = params.known(params.free_space_at_a_metre_db());
        let then = Some((break_m, params.exponent_far));
        Ok(Arc::new(Self { known, then, ..Self::log_distance(params, Self::TWO_SLOPE) }))
    }

    /// A free line, which every model with walls begins with.
    pub(super) fn free_space(params: &RadioParams, word: &'static str) -> Self {
        let known = params.known(params.free_space_at_a_metre_db());
        Self { known, exponent: 2.0, ..Self::log_distance(params, word) }
    }

    /// Loss over a distance (dB).
    pub(super) fn db(&self, apart_m: f32) -> f32 {
        // What is no distance is none that reaches.
        if !(apart_m <= self.range_m) {
            return NO_LINK_DB;
        }
        let (at_m, at_db) = self.known;
        let apart_m = apart_m.max(self.nearest_m);
        match self.then {
            Some((break_m, far)) if apart_m > break_m => {
                let near_db = at_db + 10.0 * self.exponent * libm::log10f(break_m / at_m);
                near_db + 10.0 * far * libm::log10f(apart_m / break_m)
            }
            _ => at_db + 10.0 * self.exponent * libm::log10f(apart_m / at_m),
        }
    }

    /// What more exponent adds to a loss (dB): nothing where a loss is known.
    pub(super) fn more_db(&self, apart_m: f32, exponent: f32) -> f32 {
        (10.0 * exponent * libm::log10f(apart_m.max(self.nearest_m) / self.known.0)).max(0.0)
    }
}

impl RadioModel for Slopes {
    fn loss_db(&self, _: &Map, from: &Antenna, to: &Antenna) -> f32 {
        self.db(from.at.distance(to.at))
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        self.db(apart_m)
    }

    fn key(&self) -> Option<String> {
        let Self { word, known, nearest_m, exponent, then, range_m } = self;
        Some(format!("{word} {known:?} {nearest_m:?} {exponent:?} {then:?} {range_m:?}"))
    }
}
