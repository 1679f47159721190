//! Antennas that differ: each with a gain of its own, and with a pattern about the body that carries it.

use std::sync::Arc;

use glam::Vec2;

use crate::{
    map::Map,
    radio::{Antenna, NO_LINK_DB, RadioModel, RadioParams, finite_db},
    seed::{Seed, Source},
};

/// Antennas drawn at once; any more are drawn when they are asked for.
const KNOWN: u16 = 1_000;
/// As far from 0 as an offset gets, in its standard deviations.
const MOST: f32 = 3.0;
/// Waves of a pattern around the body: lobes of 60° and wider.
const WAVES: usize = 3;
/// √(2 WAVES), as far from 0 as a pattern gets, in its own standard deviation, by Cauchy and Schwarz.
const MOST_OF_A_PATTERN: f32 = 2.45;

/// A model with what the antennas of both ends add to a loss. Antennas are drawn by the seed of a run and the number of who
/// carries them; the base's and planned ones add nothing.
#[derive(Debug, Clone)]
pub(super) struct Antennas {
    inner: Arc<dyn RadioModel>,
    offset_db: f32,
    yaw_db: f32,
    seed: Option<Seed>,
    drawn: Vec<Drawn>,
}

/// One antenna.
#[derive(Debug, Clone, Copy)]
struct Drawn {
    /// What it loses everywhere (dB).
    offset_db: f32,
    /// Coefficients of cos and sin of one, two and three times the angle from the body's x axis (dB).
    waves_db: [[f32; 2]; WAVES],
}

impl Antennas {
    pub(super) fn new(inner: Arc<dyn RadioModel>, params: &RadioParams) -> Self {
        let (offset_db, yaw_db) = (params.antenna_offset_db, params.yaw_db);
        Self { inner, offset_db, yaw_db, seed: None, drawn: Vec::new() }
    }

    fn draw(&self, seed: Seed, carrier: u16) -> Drawn {
        let mut stream = seed.stream(carrier.into(), Source::Antenna);
        let offset_db = self.offset_db * stream.normal().clamp(-MOST, MOST);
        let waves = [(); WAVES].map(|()| [stream.normal(), stream.normal()]);
        // Turned once around, every pattern has the deviation asked for, and mean 0.
        let power: f32 = waves.iter().map(|[a, b]| 0.5 * (a * a + b * b)).sum();
        let scale = if power > 0.0 { self.yaw_db / power.sqrt() } else { 0.0 };
        Drawn { offset_db, waves_db: waves.map(|wave| wave.map(|x| scale * x)) }
    }

    /// What an antenna adds to the loss of a link toward a place (dB).
    fn db(&self, antenna: &Antenna, toward: Vec2) -> f32 {
        let Some((seed, carrier)) = self.seed.zip(antenna.carrier) else { return 0.0 };
        let drawn = self.drawn.get(usize::from(carrier)).copied();
        let drawn = drawn.unwrap_or_else(|| self.draw(seed, carrier));
        let way = toward - antenna.at;
        match antenna.heading_rad {
            Some(heading_rad) if self.yaw_db > 0.0 && way != Vec2::ZERO => {
                let angle_rad = libm::atan2f(way.y, way.x) - heading_rad;
                let waves = drawn.waves_db.iter().zip(1_u8..).map(|([a, b], times)| {
                    let (sin, cos) = libm::sincosf(f32::from(times) * angle_rad);
                    a * cos + b * sin
                });
                drawn.offset_db + waves.sum::<f32>()
            }
            _ => drawn.offset_db,
        }
    }
}

impl RadioModel for Antennas {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let loss_db = finite_db(self.inner.loss_db(map, from, to));
        if self.seed.is_none() || loss_db >= NO_LINK_DB {
            return loss_db;
        }
        loss_db + (self.db(from, to.at) + self.db(to, from.at))
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        let least_db = self.inner.least_loss_db(apart_m);
        if self.seed.is_none() || least_db >= NO_LINK_DB {
            return least_db;
        }
        // A hundredth more than they come to: sums are rounded.
        least_db - 2.02 * (MOST * self.offset_db + MOST_OF_A_PATTERN * self.yaw_db)
    }

    fn key(&self) -> Option<String> {
        let inner = self.inner.key()?;
        let Some(Seed(seed)) = self.seed else { return Some(inner) };
        let Self { offset_db, yaw_db, .. } = self;
        Some(format!("{inner}, antennas of {offset_db:?} and {yaw_db:?} of seed {seed}"))
    }

    fn is_costly(&self) -> bool {
        self.inner.is_costly()
    }

    fn seeded(&self, seed: Seed) -> Option<Arc<dyn RadioModel>> {
        let inner = self.inner.seeded(seed).unwrap_or_else(|| self.inner.clone());
        let mut seeded = Self { inner, seed: Some(seed), drawn: Vec::new(), ..*self };
        seeded.drawn = (0..KNOWN).map(|carrier| seeded.draw(seed, carrier)).collect();
        Some(Arc::new(seeded))
    }
}

#[cfg(test)]
mod tests {
    use core::f32::consts::TAU;

    use super::*;
    use crate::{map::drawn, radio::Disc};

    fn antennas(params: &RadioParams) -> Antennas {
        Antennas::new(Arc::new(Disc { range_m: 9.0, loss_db: 50.0 }), params)
    }

    fn map() -> Map {
        drawn(&[vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]]).unwrap()
    }

    fn moments(losses_db: &[f32]) -> [f64; 2] {
        let n = losses_db.len() as f64;
        let mean = losses_db.iter().map(|&db| f64::from(db)).sum::<f64>() / n;
        let variance =
            losses_db.iter().map(|&db| (f64::from(db) - mean) * (f64::from(db) - mean)).sum::<f64>() / n;
        [mean, variance.sqrt()]
    }

    #[test]
    fn who_turns_in_place_sees_the_deviation_asked_for_and_a_planned_antenna_none() {
        let model = antennas(&RadioParams { yaw_db: 7.0, ..RadioParams::default() });
        let (map, base) = (map(), Antenna::from(Vec2::new(1.0, 1.0)));
        for carrier in [0, 3, 2_000] {
            let seeded = model.seeded(Seed(1)).unwrap();
            let turned = |carrier: Option<u16>| -> Vec<f32> {
                let uav = |i: u16| Antenna {
                    carrier,
                    ..Antenna::flying(Vec2::new(4.0, 2.0), TAU * f32::from(i) / 360.0)
                };
                (0..360).map(|i| seeded.loss_db(&map, &uav(i), &base)).collect()
            };
            let [mean_db, deviation_db] = moments(&turned(Some(carrier)));
            assert!(
                (mean_db - 50.0).abs() < 1e-3 && (deviation_db - 7.0).abs() < 1e-3,
                "{mean_db} {deviation_db}"
            );
            assert!(turned(Some(carrier)).iter().all(|&db| db >= seeded.least_loss_db(3.0)));
            assert_eq!(turned(None), [50.0; 360]);
            // A degree is little: the pattern is smooth.
            let turned = turned(Some(carrier));
            assert!(turned.windows(2).all(|two| (two[0] - two[1]).abs() < 1.0));
        }
        let uav = Antenna::flying(Vec2::new(4.0, 2.0), 0.3).carried_by(1);
        assert_eq!(model.loss_db(&map, &uav, &base), 50.0, "without a seed");
    }

    #[test]
    fn an_offset_is_an_antennas_own_for_the_run_the_same_both_ways_and_of_the_deviation_asked_for() {
        let model = antennas(&RadioParams { antenna_offset_db: 2.0, ..RadioParams::default() });
        let (map, base) = (map(), Antenna::from(Vec2::new(1.0, 1.0)));
        let uav = |carrier: u16, x_m: f32| Antenna::flying(Vec2::new(x_m, 2.0), 0.3).carried_by(carrier);
        let seeded = model.seeded(Seed(1)).unwrap();
        let one_db = seeded.loss_db(&map, &uav(0, 4.0), &base);
        assert!(one_db != 50.0 && one_db == seeded.loss_db(&map, &base, &uav(0, 7.0)));
        let two_db = seeded.loss_db(&map, &uav(0, 4.0), &uav(1, 5.0));
        assert!((two_db - one_db - (seeded.loss_db(&map, &uav(1, 4.0), &base) - 50.0)).abs() < 1e-5);
        let drawn: Vec<f32> =
            (0..2_000).map(|carrier| seeded.loss_db(&map, &uav(carrier, 4.0), &base)).collect();
        let [mean_db, deviation_db] = moments(&drawn);
        assert!(
            (mean_db - 50.0).abs() < 0.2 && (deviation_db - 2.0).abs() < 0.15,
            "{mean_db} {deviation_db}"
        );
        assert_ne!(one_db, model.seeded(Seed(2)).unwrap().loss_db(&map, &uav(0, 4.0), &base));
    }
}
