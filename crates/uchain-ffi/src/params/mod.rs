//! The Params of every law a node flies by, as flat as C likes them.

mod convert;
mod functions;
mod keys;

pub use functions::{
    uchain_params_cavemod, uchain_params_check, uchain_params_default, uchain_params_frontiers2021,
};

/// The tunables of every law a node flies by. Fill it with one of the presets first, then set single fields: a new field
/// has its default then. A field is named as its key in a scenario file, with the table before it: `equalize.k_db_per_m` is
/// `equalize_k_db_per_m`.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Params {
    /// Variance of a measured loss (dB²).
    /// Range: 0.001 to 10000; default 5.
    pub kalman_measurement_variance_db2: f32,
    /// Growth of the estimate's variance, per second (dB²/s); the default is 0.1 dB² at 5 Hz.
    /// Range: 0 to 10000; default 0.5.
    pub kalman_process_variance_db2_per_s: f32,
    /// Loss gained per metre by which the ends of a link separate, read from optic flow (dB/m). Positive for a
    /// loss; four to five times the physical slope, so that it leads by about 2 dB at 0.2 m/s.
    /// Range: -1000 to 1000; default 10.7.
    pub kalman_flow_gain_db_per_m: f32,
    /// How an imbalance becomes a speed.
    /// One of `UCHAIN_SPEED_LAW_…`; default `UCHAIN_SPEED_LAW_LIPSCHITZ`.
    pub equalize_law: u8,
    /// Lipschitz constant of quality over distance (dB/m). 15 to 40 all do. At a corner the true slope is 65 to
    /// 100 dB/m: the proof of Eq. 12 does not hold there.
    /// Range: 0.1 to 10000; default 25.
    pub equalize_k_db_per_m: f32,
    /// Imbalance that counts as level (dB). The paper also flies with 5 dB ("T5").
    /// Range: 0 to 100; default 0.
    pub equalize_tolerance_db: f32,
    /// Largest speed of a relay, and of a plan's head (m/s).
    /// Range: 0 to 1; default 0.3.
    pub equalize_v_max_mps: f32,
    /// Time between two decisions (s); a multiple of the tick, 0.05 s.
    /// Range: 0.05 to 10; default 0.2.
    pub equalize_decision_s: f32,
    /// Distance that "inverse-model" reads from a loss of 0 dB (m).
    /// Range: 0.0001 to 100; default 0.25.
    pub equalize_model_d0_m: f32,
    /// Loss over which the distance read by "inverse-model" grows e-fold (dB).
    /// Range: 1 to 1000; default 50.
    pub equalize_model_scale_db: f32,
    /// Speed of "bang-bang" (m/s).
    /// Range: 0 to 1; default 0.3.
    pub equalize_bang_mps: f32,
    /// Imbalance within which "bang-bang" stays (dB).
    /// Range: 0 to 100; default 1.5.
    pub equalize_bang_band_db: f32,
    /// Whether a neighbour nearer than `spacing_db` is backed away from before anything is levelled.
    /// 0 or 1; default 0.
    pub equalize_spacing: u8,
    /// Loss to a neighbour below which it is too near (dB).
    /// Range: -50 to 200; default 40.
    pub equalize_spacing_db: f32,
    /// Speed of backing away (m/s).
    /// Range: 0 to 1; default 0.2.
    pub equalize_spacing_mps: f32,
    /// Whose centering.
    /// One of `UCHAIN_CENTER_LAW_…`; default `UCHAIN_CENTER_LAW_WALL`.
    pub center_law: u8,
    /// Lateral gain (1/s).
    /// Range: 0 to 20; default 0.5.
    pub center_c_t_per_s: f32,
    /// Yaw gain (rad/(s·m)).
    /// Range: 0 to 50; default 3.5.
    pub center_c_r_rad_per_s_m: f32,
    /// Largest lateral speed (m/s).
    /// Range: 0 to 1; default 0.4.
    pub center_lateral_max_mps: f32,
    /// Largest yaw rate (rad/s); the default is 60°/s.
    /// Range: 0 to 20; default 1.0471976.
    pub center_yaw_rate_max_radps: f32,
    /// "paper": distance kept from a followed wall, along the beam (m).
    /// Range: 0 to 2; default 0.28.
    pub center_wall_distance_m: f32,
    /// "wall" and "paper": difference of the two sides' front-to-rear ratios from which one wall is ignored (1).
    /// Range: 0 to 10; default 0.4.
    pub center_invalid_ratio: f32,
    /// Leading beam at which forward speed is cut to its floor (m).
    /// Range: 0 to 2; default 0.2.
    pub center_slow_from_m: f32,
    /// Length of leading beam over which forward speed recovers (m).
    /// Range: 0.001 to 2; default 0.3.
    pub center_slow_over_m: f32,
    /// Smallest share of the forward speed that is left (1).
    /// Range: 0 to 1; default 0.2.
    pub center_slow_floor: f32,
    /// Beam below which the UAV is pushed to the other side, whatever the law says (m).
    /// Range: 0 to 2; default 0.2.
    pub center_push_below_m: f32,
    /// Speed of that push (m/s).
    /// Range: 0 to 1; default 0.2.
    pub center_push_mps: f32,
    /// "wall": share of the trailing beam below which a side's leading beam counts as closed; with both
    /// sides closed there is a wall ahead, and the UAV turns away from the nearer side (1).
    /// Range: 0 to 1; default 0.7.
    pub center_closed_share: f32,
    /// "wall": largest distance kept from a followed wall, by the nearer of its two beams (m).
    /// Range: 0 to 2; default 0.45.
    pub center_follow_distance_m: f32,
    /// "wall": lateral gain along a followed wall (1/s).
    /// Range: 0 to 20; default 1.
    pub center_follow_lateral_per_s: f32,
    /// "wall": largest lateral speed along a followed wall (m/s).
    /// Range: 0 to 1; default 0.25.
    pub center_follow_lateral_max_mps: f32,
    /// "firmware": lateral gain (1/s).
    /// Range: 0 to 20; default 2.
    pub center_firmware_lateral_per_s: f32,
    /// "firmware": yaw rate per relative difference of a side's beams (rad/s); the default is 30°/s.
    /// Range: 0 to 20; default 0.5235988.
    pub center_firmware_yaw_radps: f32,
    /// "firmware": width from which the nearer wall is followed instead of centering (m).
    /// Range: 0 to 20; default 1.
    pub center_firmware_wide_m: f32,
    /// "firmware": distance kept from a followed wall (m).
    /// Range: 0 to 2; default 0.39.
    pub center_firmware_goal_m: f32,
    /// Loss of the base link above which the chain needs one more UAV (dB).
    /// Range: -50 to 200; default 60.
    pub takeoff_s_min_db: f32,
    /// What a take-off waits for besides the threshold.
    /// One of `UCHAIN_LAUNCH_…`; default `UCHAIN_LAUNCH_THRESHOLD`.
    pub takeoff_launch: u8,
    /// Imbalance of every relay, by its own estimates, that counts as levelled for "converged" (dB).
    /// Range: 0 to 100; default 4.
    pub takeoff_converged_db: f32,
    /// Which loss of the base link is compared with `s_min_db`.
    /// One of `UCHAIN_SIGNAL_…`; default `UCHAIN_SIGNAL_FILTERED`.
    pub takeoff_launch_signal: u8,
    /// How long the loss must stay above `s_min_db` (s). 1 s avoids needless late launches.
    /// Range: 0 to 600; default 1.
    pub takeoff_launch_hold_s: f32,
    /// How long the UAV ahead must have flown (s).
    /// Range: 0 to 600; default 3.
    pub takeoff_after_previous_s: f32,
    /// Time from the ground to flight height (s).
    /// Range: 0 to 60; default 1.
    pub takeoff_rise_s: f32,
    /// Time of hovering before the UAV follows its laws (s).
    /// Range: 0 to 60; default 1.
    pub takeoff_hover_s: f32,
    /// Loss that relays level and thresholds look at.
    /// One of `UCHAIN_SIGNAL_…`; default `UCHAIN_SIGNAL_FILTERED`.
    pub link_signal: u8,
    /// What a filter does in a decision period without a packet.
    /// One of `UCHAIN_GAP_…`; default `UCHAIN_GAP_HOLD`.
    pub link_gap: u8,
    /// How long "predict" predicts before it holds (s).
    /// Range: 0 to 600; default 1.
    pub link_predict_s: f32,
    /// Whether optic flow drives the filter of the link to the base as well, and that of the next UAV in line, which
    /// stands at the base and measures what will be its link.
    /// 0 or 1; default 1.
    pub link_base_flow: u8,
    /// Silence after which a link is lost (s).
    /// Range: 0 to 600; default 1.
    pub link_lost_s: f32,
    /// Loss of the head's back link, by `signal`, above which its forward command is zeroed (dB).
    /// Range: -50 to 300; default 70.
    pub link_head_stop_db: f32,
    /// Loss of the head's back link, by `signal`, above which it is forced backward (dB).
    /// Range: -50 to 300; default 75.
    pub link_head_back_db: f32,
    /// Loss of a relay's back link, by `signal`, above which it flies backward (dB).
    /// Range: -50 to 300; default 80.
    pub link_relay_back_db: f32,
    /// How far a loss must fall below its threshold before the override ends (dB).
    /// Range: 0 to 100; default 3.
    pub link_hysteresis_db: f32,
    /// Speed of a forced retreat (m/s).
    /// Range: 0 to 1; default 0.2.
    pub link_retreat_mps: f32,
    /// What a ToF sensor reads that sees nothing (m).
    /// Range: 0.1 to 100; default 2.
    pub tof_range_m: f32,
}
