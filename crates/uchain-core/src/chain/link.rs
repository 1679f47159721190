//! One end of a link: what it has heard, and what it makes of it (Laclau 2021, Algorithm 1 and §4.3).

use super::{Heard, KalmanParams, Packet, ScalarKalman};

/// Which loss a decision is made on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Signal {
    /// The Kalman filter's estimate.
    #[default]
    Filtered,
    /// The last sample.
    Raw,
}

/// What a filter does in a decision period without a packet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Gap {
    /// Nothing.
    #[default]
    Hold,
    /// Eq. 18 with the neighbour's last speed, for `predict_s` at most.
    Predict,
}

crate::params! {
    /// Thresholds of lost and bad links.
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct LinkParams {
        /// Loss that relays level and thresholds look at.
        /// - Source: Laclau 2021, §4.2 and §6.1.3 (raw in "T0" and "T5")
        pub signal: Signal = Signal::Filtered;
        /// What a filter does in a decision period without a packet.
        /// - Source: the authors' simulator ("hold"); Laclau 2021, Eq. 18 ("predict")
        pub gap: Gap = Gap::Hold;
        /// How long "predict" predicts before it holds (s).
        /// - Source: ours
        pub predict_s: f32 = 1.0, in 0.0..=600.0;
        /// Whether optic flow drives the filter of the link to the base as well, and that of the next UAV in line, which
        /// stands at the base and measures what will be its link.
        /// - Equation: `r = r + A u`, u = 0 on that link if not
        /// - Source: Laclau 2021, Eq. 16; not in the authors' simulator
        pub base_flow: bool = true;
        /// Silence after which a link is lost (s).
        /// - Source: the authors' firmware
        pub lost_s: f32 = 1.0, in 0.0..=600.0;
        /// Loss of the head's back link, by `signal`, above which its forward command is zeroed (dB).
        /// - Source: Laclau 2021, §4.3; the value is ours
        pub head_stop_db: f32 = 70.0, in -50.0..=300.0;
        /// Loss of the head's back link, by `signal`, above which it is forced backward (dB).
        /// - Source: Laclau 2021, §4.3; the value is ours
        pub head_back_db: f32 = 75.0, in -50.0..=300.0;
        /// Loss of a relay's back link, by `signal`, above which it flies backward (dB).
        /// - Source: Laclau 2021, §4.3; the value is ours
        pub relay_back_db: f32 = 80.0, in -50.0..=300.0;
        /// How far a loss must fall below its threshold before the override ends (dB).
        /// - Source: ours
        pub hysteresis_db: f32 = 3.0, in 0.0..=100.0;
        /// Speed of a forced retreat (m/s).
        /// - Source: the authors' firmware
        pub retreat_mps: f32 = 0.2, in 0.0..=1.0;
    }
}

/// Which end of a link this is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The end toward the head: the link leads back to the base.
    Front,
    /// The end toward the base: the link leads on to the head.
    Rear,
}

/// One end of a link: its filter, the neighbour's last words, and how long it has been silent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkEnd {
    end: End,
    filter: Option<ScalarKalman>,
    raw_db: Option<f32>,
    neighbour: Packet,
    /// Decisions since the last packet: counted, for sums of periods would drift.
    silent: u32,
    silent_s: f32,
}

impl LinkEnd {
    /// An end that has heard nothing yet.
    pub fn new(end: End) -> Self {
        Self { end, filter: None, raw_db: None, neighbour: Packet::default(), silent: 0, silent_s: 0.0 }
    }

    /// One decision period: a packet steps the filter (Algorithm 1), silence holds it or lets it predict. A
    /// packet whose loss is not finite counts as silence. `own_speed_mps` is the own ground speed; `None` on the ground
    /// at the base.
    // Once in a program: a node calls it three times, and a copy of the filter for each is flash that nobody gains from.
    #[inline(never)]
    pub fn hear(
        &mut self,
        heard: Option<&Heard>,
        own_speed_mps: Option<f32>,
        period_s: f32,
        kalman: &KalmanParams,
        params: &LinkParams,
    ) {
        let heard = heard.filter(|h| h.loss_db.is_finite());
        match heard {
            Some(heard) => {
                self.silent = 0;
                self.raw_db = Some(heard.loss_db);
                self.neighbour = heard.packet;
            }
            None => self.silent = self.silent.saturating_add(1),
        }
        self.silent_s = self.silent as f32 * period_s;
        let predicts = params.gap == Gap::Predict && self.silent_s <= params.predict_s;
        let separating_mps = self.separating_mps(own_speed_mps, params);
        match (&mut self.filter, heard) {
            (None, Some(heard)) => self.filter = ScalarKalman::start(heard.loss_db, kalman),
            (Some(filter), Some(heard)) => {
                filter.predict(separating_mps, period_s, kalman);
                filter.update(heard.loss_db, kalman);
            }
            (Some(filter), None) if predicts => filter.predict(separating_mps, period_s, kalman),
            _ => {}
        }
    }

    /// Speed of the front end minus that of the rear end, u in Eq. 16 (m/s).
    fn separating_mps(&self, own_mps: Option<f32>, params: &LinkParams) -> f32 {
        let is_base_link = self.neighbour.is_base || own_mps.is_none();
        if is_base_link && !params.base_flow {
            return 0.0;
        }
        let own_mps = own_mps.unwrap_or(0.0);
        match self.end {
            End::Front => own_mps - self.neighbour.ground_speed_mps,
            End::Rear => self.neighbour.ground_speed_mps - own_mps,
        }
    }

    /// Variance of the filtered loss (dB²); `None` before the first packet.
    pub fn variance_db2(&self) -> Option<f32> {
        self.filter.map(|filter| filter.variance_db2())
    }

    /// Filtered loss (dB); `None` before the first packet.
    pub fn loss_db(&self) -> Option<f32> {
        self.filter.map(|f| f.loss_db())
    }

    /// Loss by the signal of choice (dB); `None` before the first packet.
    pub fn signal_db(&self, signal: Signal) -> Option<f32> {
        match signal {
            Signal::Filtered => self.loss_db(),
            Signal::Raw => self.raw_db,
        }
    }

    /// How long it has heard nothing (s); `None` before its first packet.
    pub fn silent_s(&self) -> Option<f32> {
        self.filter.map(|_| self.silent_s)
    }

    /// The neighbour's last words.
    pub fn neighbour(&self) -> Packet {
        self.neighbour
    }

    /// Heard once, and silent since for longer than `lost_s`; only a packet ends that.
    pub fn is_lost(&self, params: &LinkParams) -> bool {
        self.filter.is_some() && self.silent_s > params.lost_s
    }
}

/// A front end that has heard one packet at this loss, for the tests of this room.
#[cfg(test)]
pub(super) fn at(loss_db: f32) -> LinkEnd {
    let mut link = LinkEnd::new(End::Front);
    let heard = Heard { from: 0, loss_db, packet: Packet::default() };
    link.hear(Some(&heard), Some(0.0), 0.2, &KalmanParams::default(), &LinkParams::default());
    link
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_is_lost_after_more_than_a_second_of_silence_and_found_with_one_packet() {
        let (kalman, params) = (KalmanParams::default(), LinkParams::default());
        let mut link = at(50.0);
        for _ in 0..5 {
            link.hear(None, Some(0.0), 0.2, &kalman, &params);
        }
        assert!(!link.is_lost(&params));
        let rubbish = Heard { from: 0, loss_db: f32::NAN, packet: Packet::default() };
        link.hear(Some(&rubbish), Some(0.0), 0.2, &kalman, &params);
        assert!(link.is_lost(&params), "a reading that is not finite counts as none");
        assert_eq!(link.loss_db(), Some(50.0), "silence holds the estimate");
        link.hear(
            Some(&Heard { from: 0, loss_db: 50.0, packet: Packet::default() }),
            Some(0.0),
            0.2,
            &kalman,
            &params,
        );
        assert!(!link.is_lost(&params));
    }

    #[test]
    fn both_ends_of_a_stretching_link_lead_upward() {
        let (kalman, params) = (KalmanParams::default(), LinkParams::default());
        let heard = |speed| Heard {
            from: 0,
            loss_db: 50.0,
            packet: Packet { ground_speed_mps: speed, ..Packet::default() },
        };
        let (mut front, mut rear) = (LinkEnd::new(End::Front), LinkEnd::new(End::Rear));
        for _ in 0..2 {
            front.hear(Some(&heard(0.0)), Some(0.2), 0.2, &kalman, &params); // I fly ahead, the neighbour stands
            rear.hear(Some(&heard(0.2)), Some(0.0), 0.2, &kalman, &params); // I stand, the neighbour flies ahead
        }
        assert!(front.loss_db() > Some(50.1));
        assert_eq!(front.loss_db(), rear.loss_db());
    }

    #[test]
    fn in_a_gap_a_predicting_filter_goes_on_for_a_second_with_the_last_speed_heard() {
        let kalman = KalmanParams::default();
        let params = LinkParams { gap: Gap::Predict, ..LinkParams::default() };
        let mut link = LinkEnd::new(End::Front);
        let neighbour = Packet { ground_speed_mps: -0.1, ..Packet::default() };
        link.hear(
            Some(&Heard { from: 0, loss_db: 50.0, packet: neighbour }),
            Some(0.1),
            0.2,
            &kalman,
            &params,
        );
        for _ in 0..20 {
            link.hear(None, Some(0.1), 0.2, &kalman, &params);
        }
        // Five periods of 0.2 s apart at 0.2 m/s, 10.7 dB/m.
        assert!((link.loss_db().unwrap() - 52.14).abs() < 1e-3, "{:?}", link.loss_db());
    }

    #[test]
    fn without_base_flow_the_link_to_the_base_ignores_optic_flow() {
        let kalman = KalmanParams::default();
        let params = LinkParams { base_flow: false, ..LinkParams::default() };
        let mut link = LinkEnd::new(End::Front);
        for _ in 0..5 {
            let heard = Heard { from: 0, loss_db: 50.0, packet: Packet::BASE };
            link.hear(Some(&heard), Some(0.3), 0.2, &kalman, &params);
        }
        assert_eq!(link.loss_db(), Some(50.0));
    }

    /// What a constant 57 dB reads at the rear end while the neighbour ahead flies on at 0.2 m/s, for a minute.
    fn read_db(own_mps: Option<f32>, base_flow: bool) -> f32 {
        let (kalman, params) = (KalmanParams::default(), LinkParams { base_flow, ..LinkParams::default() });
        let mut link = LinkEnd::new(End::Rear);
        let packet = Packet { ground_speed_mps: 0.2, ..Packet::default() };
        for _ in 0..300 {
            link.hear(Some(&Heard { from: 0, loss_db: 57.0, packet }), own_mps, 0.2, &kalman, &params);
        }
        link.loss_db().unwrap()
    }

    #[test]
    fn without_base_flow_a_uav_at_the_base_reads_the_loss_as_it_is_and_with_it_what_is_to_come() {
        assert_eq!(read_db(None, false), 57.0);
        assert!((read_db(None, true) - 59.82).abs() < 0.005, "{}", read_db(None, true));
        // In the air it is a link between UAVs, which optic flow drives either way.
        assert_eq!(read_db(Some(0.0), false), read_db(None, true));
    }

    #[test]
    fn the_raw_signal_is_the_last_sample() {
        let mut link = at(50.0);
        let heard = Heard { from: 0, loss_db: 58.0, packet: Packet::default() };
        link.hear(Some(&heard), Some(0.0), 0.2, &KalmanParams::default(), &LinkParams::default());
        assert_eq!(link.signal_db(Signal::Raw), Some(58.0));
        assert!(link.signal_db(Signal::Filtered) < Some(58.0));
    }

    #[test]
    fn at_every_decision_rate_a_link_is_lost_after_a_second_not_at_it() {
        let (kalman, params) = (KalmanParams::default(), LinkParams::default());
        for (period_s, decisions) in [(0.05, 20), (0.1, 10), (0.2, 5)] {
            let mut link = at(50.0);
            for _ in 0..decisions {
                link.hear(None, Some(0.0), period_s, &kalman, &params);
            }
            assert!(!link.is_lost(&params), "{period_s}");
            link.hear(None, Some(0.0), period_s, &kalman, &params);
            assert!(link.is_lost(&params), "{period_s}");
        }
    }
}
