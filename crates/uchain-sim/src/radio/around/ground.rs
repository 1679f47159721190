//! What an antenna on the floor loses.

use std::sync::Arc;

use crate::{
    map::Map,
    radio::{Antenna, RadioModel},
    seed::Seed,
};

/// A model with a penalty for each end that stands on the floor.
#[derive(Debug)]
pub(super) struct Ground {
    pub(super) inner: Arc<dyn RadioModel>,
    /// Loss of one end (dB).
    pub(super) ground_db: f32,
}

impl RadioModel for Ground {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let ends = u8::from(from.on_ground) + u8::from(to.on_ground);
        self.inner.loss_db(map, from, to) + self.ground_db * f32::from(ends)
    }

    /// That of two in the air.
    fn least_loss_db(&self, apart_m: f32) -> f32 {
        self.inner.least_loss_db(apart_m)
    }

    fn key(&self) -> Option<String> {
        Some(format!("{}, {:?} on the ground", self.inner.key()?, self.ground_db))
    }

    fn is_costly(&self) -> bool {
        self.inner.is_costly()
    }

    fn seeded(&self, seed: Seed) -> Option<Arc<dyn RadioModel>> {
        Some(Arc::new(Self { inner: self.inner.seeded(seed)?, ground_db: self.ground_db }))
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::{
        map::drawn,
        radio::{Disc, NO_LINK_DB},
    };

    #[test]
    fn each_end_on_the_floor_costs_the_penalty_once_and_none_in_the_air() {
        let map = drawn(&[vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]]).unwrap();
        let ground = Ground { inner: Arc::new(Disc { range_m: 5.0, loss_db: 50.0 }), ground_db: 10.0 };
        let antenna = |x_m, on_ground| Antenna { on_ground, ..Vec2::new(x_m, 1.0).into() };
        let loss_db = |a, b| ground.loss_db(&map, &antenna(1.0, a), &antenna(4.0, b));
        assert_eq!(
            [loss_db(false, false), loss_db(true, false), loss_db(false, true), loss_db(true, true)],
            [50.0, 60.0, 60.0, 70.0]
        );
        // What reaches nobody reaches nobody from the floor.
        let far_db = ground.loss_db(&map, &antenna(1.0, true), &antenna(7.0, true));
        assert!(far_db >= NO_LINK_DB, "{far_db}");
        assert_eq!([4.0, 6.0].map(|apart_m| ground.least_loss_db(apart_m)), [50.0, NO_LINK_DB]);
    }
}
