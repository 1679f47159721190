//! Scalar Kalman filter of a link's loss, driven by optic flow (Laclau 2021, Eq. 16–19).

use crate::{bounded, smaller};

crate::params! {
    /// Noise and model of [`ScalarKalman`].
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct KalmanParams {
        /// Variance of a measured loss (dB²).
        /// - Symbol: `R`
        /// - Equation: `K = P / (P + R)`
        /// - Source: Laclau 2021, Eq. 17 and 19; the value is of the authors' simulator
        pub measurement_variance_db2: f32 = 5.0, in 0.001..=10000.0;
        /// Growth of the estimate's variance, per second (dB²/s); the default is 0.1 dB² at 5 Hz.
        /// - Symbol: `Q / T_s`
        /// - Equation: `P = P + Q`
        /// - Source: Laclau 2021, Eq. 16 and 18; the value is of the authors' simulator
        pub process_variance_db2_per_s: f32 = 0.5, in 0.0..=10000.0;
        /// Loss gained per metre by which the ends of a link separate, read from optic flow (dB/m). Positive for a
        /// loss; four to five times the physical slope, so that it leads by about 2 dB at 0.2 m/s.
        /// - Symbol: `A / T_s`
        /// - Equation: `r = r + A u`, u the speed at which the ends separate
        /// - Source: Laclau 2021, Eq. 16 and 18; the value is of the authors' simulator
        pub flow_gain_db_per_m: f32 = 10.7, in -1000.0..=1000.0;
    }
}

/// Estimate of one link's loss at one of its ends.
///
/// ```
/// use uchain_core::chain::{KalmanParams, ScalarKalman};
/// let params = KalmanParams::default();
/// let mut filter = ScalarKalman::start(50.0, &params).unwrap();
/// filter.predict(0.2, 0.2, &params); // the ends separate at 0.2 m/s for 0.2 s
/// filter.update(52.0, &params);
/// assert!(filter.loss_db() > 50.4 && filter.loss_db() < 52.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScalarKalman {
    loss_db: f32,
    variance_db2: f32,
}

/// Estimates stay within these bounds, so that no input can drive them out of `f32`.
const LOSS_LIMIT_DB: f32 = 1.0e4;
const VARIANCE_LIMIT_DB2: f32 = 1.0e6;

impl ScalarKalman {
    /// A filter that starts at its first sample, `r = z`, `P = R`; `None` if the sample is not finite.
    pub fn start(loss_db: f32, params: &KalmanParams) -> Option<Self> {
        loss_db.is_finite().then(|| Self {
            loss_db: bounded(loss_db, -LOSS_LIMIT_DB, LOSS_LIMIT_DB),
            variance_db2: params.measurement_variance_db2,
        })
    }

    /// A filter that goes on from an estimate and its variance, as [`loss_db`](Self::loss_db) and
    /// [`variance_db2`](Self::variance_db2) gave them; `None` if one of them is none.
    pub fn resume(loss_db: f32, variance_db2: f32) -> Option<Self> {
        let is_sound = loss_db.abs() <= LOSS_LIMIT_DB && (0.0..=VARIANCE_LIMIT_DB2).contains(&variance_db2);
        is_sound.then_some(Self { loss_db, variance_db2 })
    }

    /// Moves the estimate with the ends (Eq. 18): `separating_mps` is the speed of the front end minus
    /// that of the rear end, `period_s` the time since the last step. A non-finite speed counts as 0.
    pub fn predict(&mut self, separating_mps: f32, period_s: f32, params: &KalmanParams) {
        let u = if separating_mps.is_finite() { separating_mps } else { 0.0 };
        let lead_db = params.flow_gain_db_per_m * period_s * u;
        self.loss_db = bounded(self.loss_db + lead_db, -LOSS_LIMIT_DB, LOSS_LIMIT_DB);
        let grown_db2 = self.variance_db2 + params.process_variance_db2_per_s * period_s;
        self.variance_db2 = smaller(grown_db2, VARIANCE_LIMIT_DB2);
    }

    /// Corrects the estimate with a sample (Eq. 19). A non-finite sample counts as none.
    pub fn update(&mut self, loss_db: f32, params: &KalmanParams) {
        if !loss_db.is_finite() {
            return;
        }
        let z = bounded(loss_db, -LOSS_LIMIT_DB, LOSS_LIMIT_DB);
        let gain = self.variance_db2 / (self.variance_db2 + params.measurement_variance_db2);
        self.loss_db += gain * (z - self.loss_db);
        self.variance_db2 *= 1.0 - gain;
    }

    /// The estimate (dB).
    pub fn loss_db(&self) -> f32 {
        self.loss_db
    }

    /// Its variance (dB²).
    pub fn variance_db2(&self) -> f32 {
        self.variance_db2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_link_is_learned_and_its_variance_settles_where_the_riccati_equation_says() {
        let params = KalmanParams::default();
        let mut filter = ScalarKalman::start(70.0, &params).unwrap();
        for _ in 0..500 {
            filter.predict(0.0, 0.2, &params);
            filter.update(55.0, &params);
        }
        assert!((filter.loss_db() - 55.0).abs() < 1e-3);
        // Fixed point of P⁺ = (P + Q) R / (P + Q + R): P = (√(Q² + 4 Q R) − Q) / 2.
        let (q, r) = (0.1_f32, 5.0_f32);
        let settled = 0.5 * ((q * q + 4.0 * q * r).sqrt() - q);
        assert!((filter.variance_db2() - settled).abs() < 1e-4);
    }

    #[test]
    fn separating_ends_raise_the_estimate_before_any_sample_shows_it() {
        let params = KalmanParams::default();
        let mut filter = ScalarKalman::start(50.0, &params).unwrap();
        filter.predict(0.2, 0.2, &params);
        // A at 5 Hz is 2.14 dB per (m/s).
        assert!((filter.loss_db() - 50.428).abs() < 1e-3);
    }

    #[test]
    fn a_filter_goes_on_from_what_it_said_and_from_nothing_else() {
        let params = KalmanParams::default();
        let mut filter = ScalarKalman::start(50.0, &params).unwrap();
        filter.predict(0.1, 0.2, &params);
        assert_eq!(ScalarKalman::resume(filter.loss_db(), filter.variance_db2()), Some(filter));
        for (loss_db, variance_db2) in [(f32::NAN, 1.0), (50.0, -1.0), (50.0, f32::NAN), (2.0e4, 1.0)] {
            assert_eq!(ScalarKalman::resume(loss_db, variance_db2), None);
        }
    }

    #[test]
    fn a_reading_that_is_not_finite_counts_as_no_reading() {
        let params = KalmanParams::default();
        assert!(ScalarKalman::start(f32::NAN, &params).is_none());
        let mut filter = ScalarKalman::start(50.0, &params).unwrap();
        let before = filter;
        for z in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            filter.update(z, &params);
            assert_eq!(filter, before);
        }
        filter.predict(f32::NAN, 0.2, &params);
        assert_eq!(filter.loss_db(), 50.0);
    }
}
