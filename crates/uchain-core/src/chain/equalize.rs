//! The equalization laws: move toward the worse link (Laclau 2021, Eq. 12, Algorithm 1).

use crate::{bounded, smaller};

/// How an imbalance becomes a speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum SpeedLaw {
    /// `s_d / (3 k T_s)` (Eq. 12).
    #[default]
    Lipschitz,
    /// A third of the distance that a path-loss model reads from the two losses, per decision: the
    /// authors' simulator.
    InverseModel,
    /// A fixed speed outside a band: the authors' firmware.
    BangBang,
}

crate::params! {
    /// Gains of [`equalize`].
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct EqualizeParams {
        /// How an imbalance becomes a speed.
        /// - Symbol: `s_d = s_back - s_front`, the imbalance
        /// - Source: Laclau 2021, Eq. 12 and Algorithm 1 ("lipschitz"); the authors' simulator and firmware
        pub law: SpeedLaw = SpeedLaw::Lipschitz;
        /// Lipschitz constant of quality over distance (dB/m). 15 to 40 all do. At a corner the true slope is 65 to
        /// 100 dB/m: the proof of Eq. 12 does not hold there.
        /// - Symbol: `k`
        /// - Equation: `v = s_d / (3 k T_s)`
        /// - Source: Laclau 2021, Eq. 12; the value is ours
        pub k_db_per_m: f32 = 25.0, in 0.1..=10000.0;
        /// Imbalance that counts as level (dB). The paper also flies with 5 dB ("T5").
        /// - Symbol: `T`
        /// - Equation: `v = 0` where `|s_d| <= T`
        /// - Source: Laclau 2021, Algorithm 1 and §6.1.3
        pub tolerance_db: f32 = 0.0, in 0.0..=100.0;
        /// Largest speed of a relay, and of a plan's head (m/s).
        /// - Symbol: `v_max`
        /// - Source: Laclau 2021, §4.2; 0.375 in the authors' simulator
        pub v_max_mps: f32 = 0.3, in 0.0..=1.0;
        /// Time between two decisions (s); a multiple of the tick, 0.05 s.
        /// - Symbol: `T_s`
        /// - Equation: `v = s_d / (3 k T_s)`
        /// - Source: Laclau 2021, §6.1.1 (5 Hz); 10 Hz in the authors' firmware
        pub decision_s: f32 = 0.2, in 0.05..=10.0;
        /// Distance that "inverse-model" reads from a loss of 0 dB (m).
        /// - Symbol: `d0`
        /// - Equation: `D(r) = d0 exp(r / scale)`
        /// - Source: the authors' simulator
        pub model_d0_m: f32 = 0.25, in 0.0001..=100.0;
        /// Loss over which the distance read by "inverse-model" grows e-fold (dB).
        /// - Symbol: `scale`
        /// - Equation: `D(r) = d0 exp(r / scale)`
        /// - Source: the authors' simulator
        pub model_scale_db: f32 = 50.0, in 1.0..=1000.0;
        /// Speed of "bang-bang" (m/s).
        /// - Source: the authors' firmware
        pub bang_mps: f32 = 0.3, in 0.0..=1.0;
        /// Imbalance within which "bang-bang" stays (dB).
        /// - Source: the authors' firmware
        pub bang_band_db: f32 = 1.5, in 0.0..=100.0;
        /// Whether a neighbour nearer than `spacing_db` is backed away from before anything is levelled.
        /// - Source: the authors' firmware, where it is on
        pub spacing: bool = false;
        /// Loss to a neighbour below which it is too near (dB).
        /// - Source: the authors' firmware
        pub spacing_db: f32 = 40.0, in -50.0..=200.0;
        /// Speed of backing away (m/s).
        /// - Source: the authors' firmware
        pub spacing_mps: f32 = 0.2, in 0.0..=1.0;
    }
}

/// Forward speed (m/s) that levels the two links of a relay.
///
/// With quality `s = −loss` and `s_d = s_back − s_front`, the relay moves by `s_d / (3 k)` per decision,
/// forward if positive (Eq. 12), at most at `v_max_mps`; within the tolerance it stays. The other laws take
/// the same imbalance in their own way; see [`SpeedLaw`]. A loss that is not finite gives 0.
///
/// ```
/// use uchain_core::chain::{EqualizeParams, equalize};
/// let params = EqualizeParams::default();
/// assert!(equalize(50.0, 53.0, &params) > 0.0); // the front link is worse: forward
/// assert_eq!(equalize(90.0, 40.0, &params), -0.3); // limited
/// ```
pub fn equalize(back_loss_db: f32, front_loss_db: f32, params: &EqualizeParams) -> f32 {
    let s_d = front_loss_db - back_loss_db;
    if !s_d.is_finite() {
        return 0.0;
    }
    if let Some(speed_mps) = spacing(back_loss_db, front_loss_db, params) {
        return speed_mps;
    }
    if s_d.abs() <= params.tolerance_db {
        return 0.0;
    }
    let speed_mps = match params.law {
        SpeedLaw::Lipschitz => s_d / (3.0 * params.k_db_per_m) / params.decision_s,
        SpeedLaw::InverseModel => {
            let gap_m = modelled_m(front_loss_db, params) - modelled_m(back_loss_db, params);
            gap_m / (3.0 * params.decision_s)
        }
        SpeedLaw::BangBang if s_d.abs() <= params.bang_band_db => 0.0,
        SpeedLaw::BangBang => params.bang_mps.copysign(s_d),
    };
    bounded(speed_mps, -params.v_max_mps, params.v_max_mps)
}

/// The speed of backing away from a neighbour that is too near (m/s), the one toward the head first.
pub(super) fn spacing(back_loss_db: f32, front_loss_db: f32, params: &EqualizeParams) -> Option<f32> {
    if !params.spacing {
        return None;
    }
    let speed_mps = smaller(params.spacing_mps, params.v_max_mps);
    if front_loss_db < params.spacing_db {
        Some(-speed_mps)
    } else if back_loss_db < params.spacing_db {
        Some(speed_mps)
    } else {
        None
    }
}

/// Distance at which the model of "inverse-model" has this loss (m); finite for every loss.
// Once in a program: the exponential is half a kilobyte of flash.
#[inline(never)]
fn modelled_m(loss_db: f32, params: &EqualizeParams) -> f32 {
    params.model_d0_m * libm::expf(smaller(loss_db / params.model_scale_db, 50.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_decision_moves_by_a_third_of_the_imbalance_over_k() {
        let params = EqualizeParams::default();
        let v = equalize(50.0, 53.0, &params);
        assert!((v * params.decision_s - 3.0 / (3.0 * 25.0)).abs() < 1e-6);
    }

    #[test]
    fn an_imbalance_within_the_tolerance_is_level() {
        let params = EqualizeParams { tolerance_db: 5.0, ..EqualizeParams::default() };
        assert_eq!(equalize(50.0, 55.0, &params), 0.0);
        assert!(equalize(50.0, 55.1, &params) > 0.0);
        assert!(equalize(55.1, 50.0, &params) < 0.0);
    }

    #[test]
    fn the_inverse_model_moves_by_a_third_of_the_modelled_distance() {
        let params = EqualizeParams { law: SpeedLaw::InverseModel, ..EqualizeParams::default() };
        // D(55) − D(52) = 0.25 (e^1.10 − e^1.04) m.
        let v = equalize(52.0, 55.0, &params);
        assert!((v * params.decision_s - 0.043_737 / 3.0).abs() < 1e-5, "{}", v * params.decision_s);
        assert_eq!(equalize(0.0, 1.0e30, &params), params.v_max_mps);
    }

    #[test]
    fn bang_bang_knows_one_speed_outside_its_band_and_none_inside() {
        let params = EqualizeParams { law: SpeedLaw::BangBang, ..EqualizeParams::default() };
        let speeds = [51.4, 51.6, 90.0].map(|front_db| equalize(50.0, front_db, &params));
        assert_eq!(speeds, [0.0, 0.3, 0.3]);
        assert_eq!(equalize(51.6, 50.0, &params), -0.3);
    }

    #[test]
    fn with_the_spacing_rule_a_near_neighbour_is_backed_away_from_first() {
        let params = EqualizeParams { spacing: true, ..EqualizeParams::default() };
        assert_eq!(equalize(60.0, 39.0, &params), -0.2);
        assert_eq!(equalize(39.0, 60.0, &params), 0.2);
        assert_eq!(equalize(39.0, 38.0, &params), -0.2);
        assert!(equalize(50.0, 60.0, &params) > 0.0);
    }

    #[test]
    fn a_loss_that_is_not_finite_moves_nobody() {
        let params = EqualizeParams::default();
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(equalize(bad, 50.0, &params), 0.0);
            assert_eq!(equalize(50.0, bad, &params), 0.0);
            assert_eq!(equalize(bad, bad, &params), 0.0);
        }
    }
}
