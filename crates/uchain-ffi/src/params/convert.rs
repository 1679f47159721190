//! From the core's Params and back. Both ways name every field: one that is new in the core does not compile until it is here.

use core::ffi::CStr;

use uchain_core::chain::{CenterParams, EqualizeParams, KalmanParams, LinkParams, NodeParams, TakeoffParams};

use super::{Params, keys};
use crate::{
    Status,
    choice::{CenterLaw, Gap, Launch, Signal, SpeedLaw, switch},
};

/// What is wrong with Params.
#[derive(Debug)]
pub(crate) struct Refused {
    pub(crate) status: Status,
    /// The key, with its table before it.
    pub(crate) key: &'static CStr,
}

/// A choice that there is none of.
fn chosen<T>(choice: Option<T>, key: &'static CStr) -> Result<T, Refused> {
    choice.ok_or(Refused { status: Status::BadChoice, key })
}

/// What is left of a table's first wrong key.
fn ranged(wrong: Option<&str>, table: &str) -> Result<(), Refused> {
    wrong.map_or(Ok(()), |key| Err(Refused { status: Status::OutOfRange, key: keys::find(table, key) }))
}

impl Params {
    pub(crate) fn of(params: &NodeParams) -> Self {
        let NodeParams { kalman: k, equalize: e, center: c, takeoff: t, link: l, tof_range_m } = params;
        Self {
            kalman_measurement_variance_db2: k.measurement_variance_db2,
            kalman_process_variance_db2_per_s: k.process_variance_db2_per_s,
            kalman_flow_gain_db_per_m: k.flow_gain_db_per_m,
            equalize_law: SpeedLaw::of(e.law),
            equalize_k_db_per_m: e.k_db_per_m,
            equalize_tolerance_db: e.tolerance_db,
            equalize_v_max_mps: e.v_max_mps,
            equalize_decision_s: e.decision_s,
            equalize_model_d0_m: e.model_d0_m,
            equalize_model_scale_db: e.model_scale_db,
            equalize_bang_mps: e.bang_mps,
            equalize_bang_band_db: e.bang_band_db,
            equalize_spacing: e.spacing.into(),
            equalize_spacing_db: e.spacing_db,
            equalize_spacing_mps: e.spacing_mps,
            center_law: CenterLaw::of(c.law),
            center_c_t_per_s: c.c_t_per_s,
            center_c_r_rad_per_s_m: c.c_r_rad_per_s_m,
            center_lateral_max_mps: c.lateral_max_mps,
            center_yaw_rate_max_radps: c.yaw_rate_max_radps,
            center_wall_distance_m: c.wall_distance_m,
            center_invalid_ratio: c.invalid_ratio,
            center_slow_from_m: c.slow_from_m,
            center_slow_over_m: c.slow_over_m,
            center_slow_floor: c.slow_floor,
            center_push_below_m: c.push_below_m,
            center_push_mps: c.push_mps,
            center_closed_share: c.closed_share,
            center_follow_distance_m: c.follow_distance_m,
            center_follow_lateral_per_s: c.follow_lateral_per_s,
            center_follow_lateral_max_mps: c.follow_lateral_max_mps,
            center_firmware_lateral_per_s: c.firmware_lateral_per_s,
            center_firmware_yaw_radps: c.firmware_yaw_radps,
            center_firmware_wide_m: c.firmware_wide_m,
            center_firmware_goal_m: c.firmware_goal_m,
            takeoff_s_min_db: t.s_min_db,
            takeoff_launch: Launch::of(t.launch),
            takeoff_converged_db: t.converged_db,
            takeoff_launch_signal: Signal::of(t.launch_signal),
            takeoff_launch_hold_s: t.launch_hold_s,
            takeoff_after_previous_s: t.after_previous_s,
            takeoff_rise_s: t.rise_s,
            takeoff_hover_s: t.hover_s,
            link_signal: Signal::of(l.signal),
            link_gap: Gap::of(l.gap),
            link_predict_s: l.predict_s,
            link_base_flow: l.base_flow.into(),
            link_lost_s: l.lost_s,
            link_head_stop_db: l.head_stop_db,
            link_head_back_db: l.head_back_db,
            link_relay_back_db: l.relay_back_db,
            link_hysteresis_db: l.hysteresis_db,
            link_retreat_mps: l.retreat_mps,
            tof_range_m: *tof_range_m,
        }
    }

    pub(crate) fn read(&self) -> Result<NodeParams, Refused> {
        let params = NodeParams {
            kalman: KalmanParams {
                measurement_variance_db2: self.kalman_measurement_variance_db2,
                process_variance_db2_per_s: self.kalman_process_variance_db2_per_s,
                flow_gain_db_per_m: self.kalman_flow_gain_db_per_m,
            },
            equalize: EqualizeParams {
                law: chosen(SpeedLaw::read(self.equalize_law), c"equalize.law")?,
                k_db_per_m: self.equalize_k_db_per_m,
                tolerance_db: self.equalize_tolerance_db,
                v_max_mps: self.equalize_v_max_mps,
                decision_s: self.equalize_decision_s,
                model_d0_m: self.equalize_model_d0_m,
                model_scale_db: self.equalize_model_scale_db,
                bang_mps: self.equalize_bang_mps,
                bang_band_db: self.equalize_bang_band_db,
                spacing: chosen(switch(self.equalize_spacing), c"equalize.spacing")?,
                spacing_db: self.equalize_spacing_db,
                spacing_mps: self.equalize_spacing_mps,
            },
            center: CenterParams {
                law: chosen(CenterLaw::read(self.center_law), c"center.law")?,
                c_t_per_s: self.center_c_t_per_s,
                c_r_rad_per_s_m: self.center_c_r_rad_per_s_m,
                lateral_max_mps: self.center_lateral_max_mps,
                yaw_rate_max_radps: self.center_yaw_rate_max_radps,
                wall_distance_m: self.center_wall_distance_m,
                invalid_ratio: self.center_invalid_ratio,
                slow_from_m: self.center_slow_from_m,
                slow_over_m: self.center_slow_over_m,
                slow_floor: self.center_slow_floor,
                push_below_m: self.center_push_below_m,
                push_mps: self.center_push_mps,
                closed_share: self.center_closed_share,
                follow_distance_m: self.center_follow_distance_m,
                follow_lateral_per_s: self.center_follow_lateral_per_s,
                follow_lateral_max_mps: self.center_follow_lateral_max_mps,
                firmware_lateral_per_s: self.center_firmware_lateral_per_s,
                firmware_yaw_radps: self.center_firmware_yaw_radps,
                firmware_wide_m: self.center_firmware_wide_m,
                firmware_goal_m: self.center_firmware_goal_m,
            },
            takeoff: TakeoffParams {
                s_min_db: self.takeoff_s_min_db,
                launch: chosen(Launch::read(self.takeoff_launch), c"takeoff.launch")?,
                converged_db: self.takeoff_converged_db,
                launch_signal: chosen(Signal::read(self.takeoff_launch_signal), c"takeoff.launch_signal")?,
                launch_hold_s: self.takeoff_launch_hold_s,
                after_previous_s: self.takeoff_after_previous_s,
                rise_s: self.takeoff_rise_s,
                hover_s: self.takeoff_hover_s,
            },
            link: LinkParams {
                signal: chosen(Signal::read(self.link_signal), c"link.signal")?,
                gap: chosen(Gap::read(self.link_gap), c"link.gap")?,
                predict_s: self.link_predict_s,
                base_flow: chosen(switch(self.link_base_flow), c"link.base_flow")?,
                lost_s: self.link_lost_s,
                head_stop_db: self.link_head_stop_db,
                head_back_db: self.link_head_back_db,
                relay_back_db: self.link_relay_back_db,
                hysteresis_db: self.link_hysteresis_db,
                retreat_mps: self.link_retreat_mps,
            },
            tof_range_m: self.tof_range_m,
        };
        ranged(params.kalman.first_wrong(), "kalman")?;
        ranged(params.equalize.first_wrong(), "equalize")?;
        ranged(params.center.first_wrong(), "center")?;
        ranged(params.takeoff.first_wrong(), "takeoff")?;
        ranged(params.link.first_wrong(), "link")?;
        let (low_m, high_m) = NodeParams::TOF_RANGE_LIMITS_M;
        if !(low_m..=high_m).contains(&params.tof_range_m) {
            return Err(Refused { status: Status::OutOfRange, key: c"tof.range_m" });
        }
        Ok(params)
    }
}
