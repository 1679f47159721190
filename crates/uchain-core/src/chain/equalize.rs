//! The equalization law: move toward the worse link (Laclau 2021, Eq. 12, Algorithm 1).

crate::params! {
    /// Gains of [`equalize`].
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct EqualizeParams {
        /// Lipschitz constant of quality over distance, k in Laclau 2021, Eq. 12 (dB/m). 15 to 40 all
        /// do. At a corner the true slope is 65 to 100 dB/m: the proof of Eq. 12 does not hold there.
        pub k_db_per_m: f32 = 25.0, in 0.1..=10000.0;
        /// Imbalance that counts as level, T in Algorithm 1 (dB).
        pub tolerance_db: f32 = 0.0, in 0.0..=100.0;
        /// Largest speed (m/s).
        pub v_max_mps: f32 = 0.3, in 0.0..=1.0;
        /// Time between two decisions, T_s (s); a multiple of the simulator's tick.
        pub decision_s: f32 = 0.2, in 0.05..=10.0;
    }
}

/// Forward speed (m/s) that levels the two links of a relay.
///
/// With quality `s = −loss` and `s_d = s_back − s_front`, the relay moves by `s_d / (3 k)` per decision,
/// forward if positive (Eq. 12), at most at `v_max_mps`; within the tolerance it stays. A loss that is
/// not finite gives 0.
///
/// ```
/// use uchain_core::chain::{EqualizeParams, equalize};
/// let params = EqualizeParams::default();
/// assert!(equalize(50.0, 53.0, &params) > 0.0); // the front link is worse: forward
/// assert_eq!(equalize(90.0, 40.0, &params), -0.3); // limited
/// ```
pub fn equalize(back_loss_db: f32, front_loss_db: f32, params: &EqualizeParams) -> f32 {
    let s_d = front_loss_db - back_loss_db;
    if !s_d.is_finite() || s_d.abs() <= params.tolerance_db {
        return 0.0;
    }
    let step_m = s_d / (3.0 * params.k_db_per_m);
    (step_m / params.decision_s).clamp(-params.v_max_mps, params.v_max_mps)
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
    fn a_loss_that_is_not_finite_moves_nobody() {
        let params = EqualizeParams::default();
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(equalize(bad, 50.0, &params), 0.0);
            assert_eq!(equalize(50.0, bad, &params), 0.0);
            assert_eq!(equalize(bad, bad, &params), 0.0);
        }
    }
}
