//! Whose values a node flies by: the presets of the simulator, for a node that has no scenario to read them from.

use super::{
    super::{
        CenterLaw, CenterParams, EqualizeParams, Gap, KalmanParams, LinkParams, SpeedLaw, TakeoffParams,
    },
    NodeParams,
};

impl NodeParams {
    /// The authors' simulator: what the figures of Laclau 2021 were computed with. The scenario files' preset
    /// `frontiers2021`, as far as it is about a node.
    ///
    /// ```
    /// use uchain_core::chain::{NodeParams, SpeedLaw};
    /// assert_eq!(NodeParams::frontiers2021().equalize.law, SpeedLaw::InverseModel);
    /// ```
    pub fn frontiers2021() -> Self {
        let plain = Self::default();
        Self {
            equalize: EqualizeParams { law: SpeedLaw::InverseModel, v_max_mps: 0.375, ..plain.equalize },
            center: CenterParams { law: CenterLaw::Paper, slow_over_m: 0.25, ..plain.center },
            takeoff: TakeoffParams {
                launch_hold_s: 0.0,
                after_previous_s: 0.0,
                rise_s: 0.0,
                hover_s: 0.0,
                ..plain.takeoff
            },
            link: LinkParams {
                gap: Gap::Hold,
                base_flow: false,
                head_stop_db: 90.0,
                head_back_db: 100.0,
                relay_back_db: 90.0,
                ..plain.link
            },
            ..plain
        }
    }

    /// The authors' flight firmware, branch "cavemod": what flew in the experiment of Laclau 2021, Fig. 6. The scenario
    /// files' preset `cavemod`, as far as it is about a node.
    ///
    /// ```
    /// use uchain_core::chain::NodeParams;
    /// assert_eq!(NodeParams::cavemod().equalize.decision_s, 0.1);
    /// ```
    pub fn cavemod() -> Self {
        let plain = Self::default();
        Self {
            kalman: KalmanParams {
                measurement_variance_db2: 5.0,
                process_variance_db2_per_s: 5.0,
                flow_gain_db_per_m: 0.0,
            },
            equalize: EqualizeParams {
                law: SpeedLaw::BangBang,
                decision_s: 0.1,
                spacing: true,
                v_max_mps: 0.3,
                ..plain.equalize
            },
            center: CenterParams { law: CenterLaw::Firmware, ..plain.center },
            takeoff: TakeoffParams { launch_hold_s: 0.0, ..plain.takeoff },
            link: LinkParams {
                head_stop_db: 65.0,
                head_back_db: 65.0,
                relay_back_db: 65.0,
                hysteresis_db: 0.0,
                lost_s: 1.0,
                retreat_mps: 0.2,
                ..plain.link
            },
            ..plain
        }
    }
}
