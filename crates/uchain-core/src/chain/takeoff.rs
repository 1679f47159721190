//! When the next UAV takes off (Laclau 2021, §4.3).

use super::{LaunchHold, Packet, Signal};

/// What a take-off waits for besides the threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Launch {
    /// Nothing.
    #[default]
    Threshold,
    /// The flying chain has levelled (the paper's preprint).
    Converged,
}

crate::params! {
    /// Conditions of [`Takeoff`].
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct TakeoffParams {
        /// Loss of the base link above which the chain needs one more UAV (dB).
        /// - Symbol: `s_min`, read as a loss
        /// - Source: Laclau 2021, §4.3 and §6.1
        pub s_min_db: f32 = 60.0, in -50.0..=200.0;
        /// What a take-off waits for besides the threshold.
        /// - Source: Laclau 2021, §4.3 ("threshold"); the paper's preprint ("converged")
        pub launch: Launch = Launch::Threshold;
        /// Imbalance of every relay, by its own estimates, that counts as levelled for "converged" (dB).
        /// - Source: ours
        pub converged_db: f32 = 4.0, in 0.0..=100.0;
        /// Which loss of the base link is compared with `s_min_db`.
        /// - Source: Laclau 2021, §4.2 and §4.3
        pub launch_signal: Signal = Signal::Filtered;
        /// How long the loss must stay above `s_min_db` (s). 1 s avoids needless late launches.
        /// - Source: ours; 0 in Laclau 2021, §4.3
        pub launch_hold_s: f32 = 1.0, in 0.0..=600.0;
        /// How long the UAV ahead must have flown (s).
        /// - Source: the authors' simulator
        pub after_previous_s: f32 = 3.0, in 0.0..=600.0;
        /// Time from the ground to flight height (s).
        /// - Source: the authors' simulator (0.2 m at 0.2 m/s)
        pub rise_s: f32 = 1.0, in 0.0..=60.0;
        /// Time of hovering before the UAV follows its laws (s).
        /// - Source: the authors' simulator
        pub hover_s: f32 = 1.0, in 0.0..=60.0;
    }
}

/// Watches the base link from the ground, for the next UAV in line.
///
/// ```
/// use uchain_core::chain::{Packet, Takeoff, TakeoffParams};
/// let params = TakeoffParams { launch_hold_s: 0.4, ..TakeoffParams::default() };
/// let mut takeoff = Takeoff::default();
/// let front = Packet { flown_s: 10.0, ..Packet::default() };
/// assert!(!takeoff.due(61.0, &front, 0.2, &params)); // above s_min for the first time
/// assert!(!takeoff.due(61.0, &front, 0.2, &params));
/// assert!(takeoff.due(61.0, &front, 0.2, &params));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Takeoff {
    /// Decisions with the loss above the threshold: counted, for sums of periods would drift.
    over: u32,
}

impl Takeoff {
    /// Whether to take off now. `loss_db`: loss to the last UAV of the chain (dB, bigger is worse; one that is
    /// not a number launches nobody); `front`: what that UAV said last; `period_s`: the decision period (s). The hold starts with the first decision above the
    /// threshold, so that 0 launches at once.
    pub fn due(&mut self, loss_db: f32, front: &Packet, period_s: f32, params: &TakeoffParams) -> bool {
        let over = loss_db > params.s_min_db && held(front, params).is_none();
        if !over {
            self.over = 0;
            return false;
        }
        let due = self.over as f32 * period_s >= params.launch_hold_s;
        self.over = self.over.saturating_add(1);
        due
    }
}

/// What a launch waits for besides the threshold, by what the UAV ahead said last.
pub(super) fn held(front: &Packet, params: &TakeoffParams) -> Option<LaunchHold> {
    let has_flown = front.flown_s >= params.after_previous_s;
    let is_level = params.launch == Launch::Threshold || front.imbalance_db <= params.converged_db;
    match (has_flown, is_level) {
        (false, _) => Some(LaunchHold::Ahead),
        (true, false) => Some(LaunchHold::Unlevelled),
        (true, true) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flown(flown_s: f32) -> Packet {
        Packet { flown_s, ..Packet::default() }
    }

    #[test]
    fn without_a_hold_the_first_sample_above_the_threshold_launches() {
        let params = TakeoffParams { launch_hold_s: 0.0, ..TakeoffParams::default() };
        let mut takeoff = Takeoff::default();
        assert!(!takeoff.due(60.0, &flown(10.0), 0.2, &params));
        assert!(takeoff.due(60.1, &flown(10.0), 0.2, &params));
    }

    #[test]
    fn one_sample_below_the_threshold_starts_the_hold_anew() {
        let params = TakeoffParams::default();
        let mut takeoff = Takeoff::default();
        for _ in 0..5 {
            assert!(!takeoff.due(61.0, &flown(10.0), 0.2, &params));
        }
        assert!(!takeoff.due(59.0, &flown(10.0), 0.2, &params));
        let waited = (0..20).take_while(|_| !takeoff.due(61.0, &flown(10.0), 0.2, &params)).count();
        assert_eq!(waited, 5);
    }

    #[test]
    fn nobody_takes_off_before_the_uav_ahead_has_flown_for_a_while_or_on_a_reading_that_is_none() {
        let params = TakeoffParams { launch_hold_s: 0.0, ..TakeoffParams::default() };
        assert!(!Takeoff::default().due(70.0, &flown(2.9), 0.2, &params));
        assert!(!Takeoff::default().due(f32::NAN, &flown(10.0), 0.2, &params));
        assert!(Takeoff::default().due(70.0, &flown(3.0), 0.2, &params));
    }

    #[test]
    fn waiting_for_convergence_an_imbalance_anywhere_ahead_delays_the_launch() {
        let params =
            TakeoffParams { launch: Launch::Converged, launch_hold_s: 0.0, ..TakeoffParams::default() };
        let front = |imbalance_db| Packet { imbalance_db, ..flown(10.0) };
        assert!(!Takeoff::default().due(70.0, &front(4.1), 0.2, &params));
        assert!(Takeoff::default().due(70.0, &front(4.0), 0.2, &params));
    }
}
