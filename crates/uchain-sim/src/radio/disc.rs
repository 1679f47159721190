//! A disc: all is heard within a range, and nothing beyond (Kim 2021). Rock does not matter to it.

use std::sync::Arc;

use super::{Antenna, NO_LINK_DB, RadioError, RadioKind, RadioModel, RadioParams};
use crate::map::Map;

/// The model "disc". It says nothing of how good a link is, so that no relay of a chain knows when to take off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// How far a link reaches (m).
    pub range_m: f32,
    /// What a link loses that reaches (dB).
    pub loss_db: f32,
}

impl Disc {
    /// Its word in a scenario.
    pub const WORD: &'static str = "disc";

    pub(super) const KIND: RadioKind = RadioKind::new(
        Self::WORD,
        "reference_loss_db within range_m, whatever is in the way, and no link beyond (Kim 2021).",
        Self::make,
    );

    /// As a scenario asks for it: `radio.range_m`, within which a link loses `radio.reference_loss_db`.
    fn make(params: &RadioParams, _: &Map) -> Result<Arc<dyn RadioModel>, RadioError> {
        let [low, high] = RadioParams::RANGE_M;
        let refused = |got: String| RadioError::Value {
            key: "range_m",
            got,
            expected: format!("the model \"{}\" needs a range; it must lie in {low}..={high}", Self::WORD),
        };
        let range_m = params.range_m.ok_or_else(|| refused("nothing".to_owned()))?;
        if !(low as f32..=high as f32).contains(&range_m) {
            return Err(refused(range_m.to_string()));
        }
        Ok(Arc::new(Self { range_m, loss_db: params.reference_loss_db }))
    }
}

impl RadioModel for Disc {
    fn loss_db(&self, _: &Map, from: &Antenna, to: &Antenna) -> f32 {
        self.least_loss_db(from.at.distance(to.at))
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        if apart_m <= self.range_m { self.loss_db } else { NO_LINK_DB }
    }

    fn key(&self) -> Option<String> {
        Some(format!("{} {:?} {:?}", Self::WORD, self.range_m, self.loss_db))
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::map::drawn;

    fn map() -> Map {
        drawn(&[vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]]).unwrap()
    }

    #[test]
    fn a_disc_reaches_as_far_as_its_range_and_not_a_hair_farther() {
        let map = map();
        let params = RadioParams { range_m: Some(2.5), ..RadioParams::default() };
        let disc = Disc::make(&params, &map).unwrap();
        let loss_db = |x_m: f32| disc.loss_db(&map, &Vec2::new(1.0, 1.0).into(), &Vec2::new(x_m, 1.0).into());
        assert_eq!(
            [1.0, 3.5, 3.500_000_2, 1e9, f32::NAN].map(loss_db),
            [35.0, 35.0, NO_LINK_DB, NO_LINK_DB, NO_LINK_DB]
        );
    }

    #[test]
    fn a_disc_without_a_range_is_refused() {
        for range_m in [None, Some(f32::NAN), Some(0.0), Some(f32::INFINITY), Some(-1.0)] {
            let error = Disc::make(&RadioParams { range_m, ..RadioParams::default() }, &map()).unwrap_err();
            assert!(error.to_string().ends_with("it must lie in 0.1..=1000000"), "{error}");
        }
    }
}
