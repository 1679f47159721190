//! Names of keys for C, with the table before them as in a scenario file.

use core::ffi::CStr;

/// Every key that has a range, but `tof.range_m`.
pub(super) const KEYS: &[&CStr] = &[
    c"kalman.measurement_variance_db2",
    c"kalman.process_variance_db2_per_s",
    c"kalman.flow_gain_db_per_m",
    c"equalize.k_db_per_m",
    c"equalize.tolerance_db",
    c"equalize.v_max_mps",
    c"equalize.decision_s",
    c"equalize.model_d0_m",
    c"equalize.model_scale_db",
    c"equalize.bang_mps",
    c"equalize.bang_band_db",
    c"equalize.spacing_db",
    c"equalize.spacing_mps",
    c"center.c_t_per_s",
    c"center.c_r_rad_per_s_m",
    c"center.lateral_max_mps",
    c"center.yaw_rate_max_radps",
    c"center.wall_distance_m",
    c"center.invalid_ratio",
    c"center.slow_from_m",
    c"center.slow_over_m",
    c"center.slow_floor",
    c"center.push_below_m",
    c"center.push_mps",
    c"center.closed_share",
    c"center.follow_distance_m",
    c"center.follow_lateral_per_s",
    c"center.follow_lateral_max_mps",
    c"center.firmware_lateral_per_s",
    c"center.firmware_yaw_radps",
    c"center.firmware_wide_m",
    c"center.firmware_goal_m",
    c"takeoff.s_min_db",
    c"takeoff.converged_db",
    c"takeoff.launch_hold_s",
    c"takeoff.after_previous_s",
    c"takeoff.rise_s",
    c"takeoff.hover_s",
    c"link.predict_s",
    c"link.lost_s",
    c"link.head_stop_db",
    c"link.head_back_db",
    c"link.relay_back_db",
    c"link.hysteresis_db",
    c"link.retreat_mps",
];

/// The name of a key of a table.
pub(super) fn find(table: &str, key: &str) -> &'static CStr {
    let is_it = |name: &&&CStr| {
        let rest = name.to_bytes().strip_prefix(table.as_bytes());
        rest.and_then(|rest| rest.strip_prefix(b".")) == Some(key.as_bytes())
    };
    KEYS.iter().find(is_it).copied().unwrap_or(c"?")
}
