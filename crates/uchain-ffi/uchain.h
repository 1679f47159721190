/* The chain node of U-Chain (Laclau 2021) in C: what to call is in docs/guide/firmware.md.
 *
 * Units are in the names: _m metres, _mps metres per second, _s seconds, _db decibels, _rad radians. Axes: x forward, y
 * left, angles counter-clockwise seen from above. Radio is a loss in dB, the received power in dBm with its sign changed:
 * bigger is worse.
 *
 * A pointer is NULL, or points to what its type says; what the pointers of one call point to may not overlap. Nothing is
 * allocated, and no input, whatever it is, ends the program: NULL, wrong choices and losses that are none are answered by a
 * uchain_status. All memory is the caller's; text that is returned is constant.
 *
 * Made of crates/uchain-ffi/src by cbindgen: change it there. */

#ifndef UCHAIN_H
#define UCHAIN_H

#include <stdint.h>

// Version of this interface. It changes whenever a program that was compiled with another header would go wrong.
#define UCHAIN_ABI_VERSION 1

// Most bytes of a packet.
#define UCHAIN_PACKET_MAX 30

// Id of the base station, which is no UAV.
#define UCHAIN_BASE_ID 65535

// No place in the chain is known.
#define UCHAIN_NO_PLACE 65535

// Size of `uchain_node` (32-bit words).
#define UCHAIN_NODE_WORDS 180

// Size of `uchain_params` (bytes).
#define UCHAIN_PARAMS_BYTES 212

// Size of `uchain_observation` (bytes).
#define UCHAIN_OBSERVATION_BYTES 40

// Size of `uchain_command` (bytes).
#define UCHAIN_COMMAND_BYTES 16

// Size of `uchain_explanation` (bytes).
#define UCHAIN_EXPLANATION_BYTES 56

// How a call went. `UCHAIN_STATUS_OK` is 0.
enum uchain_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // As asked.
    UCHAIN_STATUS_OK = 0,
    // A pointer is NULL, or not aligned for what it points to.
    UCHAIN_STATUS_BAD_POINTER = 1,
    // The node was never initialised: call `uchain_node_init` first.
    UCHAIN_STATUS_NOT_INITIALISED = 2,
    // A choice (role, wall, law, 0 or 1) that there is none of: see the constants.
    UCHAIN_STATUS_BAD_CHOICE = 3,
    // A number outside its range, NaN and infinities included.
    UCHAIN_STATUS_OUT_OF_RANGE = 4,
    // Too few bytes for a packet.
    UCHAIN_STATUS_TOO_SHORT = 5,
    // Too many bytes for a packet.
    UCHAIN_STATUS_TOO_LONG = 6,
    // A packet of another version, or no packet of this project: its first byte is not the version.
    UCHAIN_STATUS_OTHER_VERSION = 7,
    // A packet whose content makes no sense.
    UCHAIN_STATUS_MALFORMED = 8,
    // A packet that says it comes from this very node: two UAVs have the same id.
    UCHAIN_STATUS_OWN_ID = 9,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_status uchain_status;
#else
typedef uint8_t uchain_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a node is made as.
enum uchain_role
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The explorer: flies as its pilot asks, as long as its back link holds.
    UCHAIN_ROLE_HEAD = 0,
    // Levels its two links.
    UCHAIN_ROLE_RELAY = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_role uchain_role;
#else
typedef uint8_t uchain_role;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Which wall to follow.
enum uchain_follow
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Keep to the middle.
    UCHAIN_FOLLOW_CENTRE = 0,
    // Keep the left wall.
    UCHAIN_FOLLOW_LEFT = 1,
    // Keep the right wall.
    UCHAIN_FOLLOW_RIGHT = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_follow uchain_follow;
#else
typedef uint8_t uchain_follow;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How an imbalance becomes a speed: `equalize_law`.
enum uchain_speed_law
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // "lipschitz": `s_d / (3 k T_s)` (Laclau 2021, Eq. 12).
    UCHAIN_SPEED_LAW_LIPSCHITZ = 0,
    // "inverse-model": a third of the distance that a path-loss model reads from the two losses.
    UCHAIN_SPEED_LAW_INVERSE_MODEL = 1,
    // "bang-bang": a fixed speed outside a band.
    UCHAIN_SPEED_LAW_BANG_BANG = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_speed_law uchain_speed_law;
#else
typedef uint8_t uchain_speed_law;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Whose centering: `center_law`.
enum uchain_center_law
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // "wall": both walls while they run alike, else along the nearer one, and away from a wall ahead.
    UCHAIN_CENTER_LAW_WALL = 0,
    // "paper": Laclau 2021, Eq. 20 and 21 as printed.
    UCHAIN_CENTER_LAW_PAPER = 1,
    // "firmware": the authors' flight firmware.
    UCHAIN_CENTER_LAW_FIRMWARE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_center_law uchain_center_law;
#else
typedef uint8_t uchain_center_law;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Which loss is looked at: `link_signal` and `takeoff_launch_signal`.
enum uchain_signal
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // "filtered": the Kalman filter's estimate.
    UCHAIN_SIGNAL_FILTERED = 0,
    // "raw": the last sample.
    UCHAIN_SIGNAL_RAW = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_signal uchain_signal;
#else
typedef uint8_t uchain_signal;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a filter does in a decision period without a packet: `link_gap`.
enum uchain_gap
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // "hold": nothing.
    UCHAIN_GAP_HOLD = 0,
    // "predict": it goes on with the neighbour's last speed, for `link_predict_s` at most.
    UCHAIN_GAP_PREDICT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_gap uchain_gap;
#else
typedef uint8_t uchain_gap;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a take-off waits for besides the threshold: `takeoff_launch`.
enum uchain_launch
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // "threshold": nothing.
    UCHAIN_LAUNCH_THRESHOLD = 0,
    // "converged": the flying chain has levelled.
    UCHAIN_LAUNCH_CONVERGED = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_launch uchain_launch;
#else
typedef uint8_t uchain_launch;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a node is doing.
enum uchain_stage
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // On the ground, until the link that will be its own is weak enough for long enough.
    UCHAIN_STAGE_WAITING = 0,
    // Rising and hovering, until it has settled.
    UCHAIN_STAGE_RISING = 1,
    // Flying by its laws.
    UCHAIN_STAGE_FLYING = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_stage uchain_stage;
#else
typedef uint8_t uchain_stage;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why a UAV flies otherwise than its law, or its pilot, wishes.
enum uchain_override
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // It flies as wished.
    UCHAIN_OVERRIDE_NONE = 0,
    // A head that has heard nobody behind it yet stays.
    UCHAIN_OVERRIDE_NEVER_HEARD = 1,
    // The head's back link is too weak to go on (`link_head_stop_db`).
    UCHAIN_OVERRIDE_HEAD_STOP = 2,
    // The back link is so weak that it flies backward (`link_head_back_db`, `link_relay_back_db`).
    UCHAIN_OVERRIDE_RETREAT = 3,
    // The back link is lost (`link_lost_s`): it flies backward.
    UCHAIN_OVERRIDE_BACK_LOST = 4,
    // The front link is lost (`link_lost_s`): it hovers.
    UCHAIN_OVERRIDE_FRONT_LOST = 5,
    // A relay is nearer to a neighbour than `equalize_spacing_db` and backs away from it.
    UCHAIN_OVERRIDE_SPACING = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_override uchain_override;
#else
typedef uint8_t uchain_override;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Which walls centering steers by.
enum uchain_walls
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // None, or there are no distances in the observation.
    UCHAIN_WALLS_NONE = 0,
    // It keeps to the middle.
    UCHAIN_WALLS_BOTH = 1,
    // It runs along the left one.
    UCHAIN_WALLS_LEFT = 2,
    // It runs along the right one.
    UCHAIN_WALLS_RIGHT = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum uchain_walls uchain_walls;
#else
typedef uint8_t uchain_walls;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The brain of one UAV: memory of the caller, filled by `uchain_node_init`. It holds no pointer: it may be copied. Two
// threads may not use the same one at the same time.
typedef struct uchain_node {
    uint32_t opaque[UCHAIN_NODE_WORDS];
} uchain_node;

// All a chain node may know at one instant. Axes: x forward, y left, angles counter-clockwise. Fill it with zeros first:
// then nothing is measured. What is not a finite number counts as not measured.
typedef struct uchain_observation {
    // Distance front left, along the beam at +45° (m). A beam without a return reads `tof_range_m`; so does one that is
    // negative or not finite. This and the other three count if `has_tof` is 1.
    float tof_nw_m;
    // Distance front right, along the beam at -45° (m).
    float tof_ne_m;
    // Distance rear left, along the beam at +135° (m).
    float tof_sw_m;
    // Distance rear right, along the beam at -135° (m).
    float tof_se_m;
    // Own forward ground speed by optic flow (m/s), negative backward. It counts if `has_ground_speed` is 1.
    float ground_speed_mps;
    // Share of the own battery's charge that is left (0 to 1). It counts if `has_battery` is 1.
    float battery;
    // Forward speed that the pilot asks for (m/s), negative backward. It counts if `has_pilot` is 1; only the head has a
    // pilot.
    float pilot_speed_mps;
    // Place in the chain (0 to 65,533): 0 leads it, larger ones are nearer to the base. It counts if `has_place` is 1; else the
    // place is what it was.
    uint16_t place;
    // Wall that the pilot chooses: one of `UCHAIN_FOLLOW_…`. It counts if `has_pilot` is 1.
    uint8_t pilot_follow;
    // 1 if `place` is told, else 0.
    uint8_t has_place;
    // 1 if there is a new set of distances: at the rate of the sensors, 10 Hz say. Else 0.
    uint8_t has_tof;
    // 1 if a decision is due, every `equalize_decision_s`: what `uchain_hear` collected goes into it, and silence counts.
    // Else 0.
    uint8_t is_decision_due;
    // 1 if the ground speed was measured, else 0.
    uint8_t has_ground_speed;
    // 1 if the battery's charge was measured, else 0.
    uint8_t has_battery;
    // 1 if there is a pilot, else 0.
    uint8_t has_pilot;
} uchain_observation;

// What a node believes, and why it asks for what it asks: for telemetry, nothing in a flight depends on it. NaN: not known
// yet.
typedef struct uchain_explanation {
    // Filtered loss of the link toward the base (dB).
    float back_filtered_db;
    // Variance of that estimate (dB²).
    float back_variance_db2;
    // Loss of the last packet from there, as measured (dB).
    float back_raw_db;
    // For how long nothing has been heard from there (s).
    float back_silent_s;
    // Filtered loss of the link toward the head (dB).
    float front_filtered_db;
    // Variance of that estimate (dB²).
    float front_variance_db2;
    // Loss of the last packet from there, as measured (dB).
    float front_raw_db;
    // For how long nothing has been heard from there (s).
    float front_silent_s;
    // Loss of the front link minus that of the back link (dB): what it levels.
    float imbalance_db;
    // Forward speed that its law, or its pilot, wishes (m/s).
    float wish_mps;
    // Forward speed by its laws and overrides, before it slows down near walls (m/s); NaN while it cannot fly freely.
    float allowed_mps;
    // Share of its forward speed that its distances to the walls leave it (0 to 1).
    float speed_share;
    // Its place in the chain, 0 leads it; `UCHAIN_NO_PLACE` if it was never told.
    uint16_t place;
    // What it is in the chain: one of `UCHAIN_ROLE_…`.
    uint8_t role;
    // What it is doing: one of `UCHAIN_STAGE_…`.
    uint8_t stage;
    // What its wish was overridden by: one of `UCHAIN_OVERRIDE_…`.
    uint8_t overridden;
    // The wall choice it flies by: one of `UCHAIN_FOLLOW_…`.
    uint8_t follow;
    // The walls that its centering steers by, given the distances of the observation: one of `UCHAIN_WALLS_…`.
    uint8_t walls;
} uchain_explanation;

// The tunables of every law a node flies by. Fill it with one of the presets first, then set single fields: a new field
// has its default then. A field is named as its key in a scenario file, with the table before it: `equalize.k_db_per_m` is
// `equalize_k_db_per_m`.
typedef struct uchain_params {
    // Variance of a measured loss (dB²).
    // Range: 0.001 to 10000; default 5.
    float kalman_measurement_variance_db2;
    // Growth of the estimate's variance, per second (dB²/s); the default is 0.1 dB² at 5 Hz.
    // Range: 0 to 10000; default 0.5.
    float kalman_process_variance_db2_per_s;
    // Loss gained per metre by which the ends of a link separate, read from optic flow (dB/m). Positive for a
    // loss; four to five times the physical slope, so that it leads by about 2 dB at 0.2 m/s.
    // Range: -1000 to 1000; default 10.7.
    float kalman_flow_gain_db_per_m;
    // How an imbalance becomes a speed.
    // One of `UCHAIN_SPEED_LAW_…`; default `UCHAIN_SPEED_LAW_LIPSCHITZ`.
    uint8_t equalize_law;
    // Lipschitz constant of quality over distance (dB/m). 15 to 40 all do. At a corner the true slope is 65 to
    // 100 dB/m: the proof of Eq. 12 does not hold there.
    // Range: 0.1 to 10000; default 25.
    float equalize_k_db_per_m;
    // Imbalance that counts as level (dB). The paper also flies with 5 dB ("T5").
    // Range: 0 to 100; default 0.
    float equalize_tolerance_db;
    // Largest speed of a relay, and of a plan's head (m/s).
    // Range: 0 to 1; default 0.3.
    float equalize_v_max_mps;
    // Time between two decisions (s); a multiple of the tick, 0.05 s.
    // Range: 0.05 to 10; default 0.2.
    float equalize_decision_s;
    // Distance that "inverse-model" reads from a loss of 0 dB (m).
    // Range: 0.0001 to 100; default 0.25.
    float equalize_model_d0_m;
    // Loss over which the distance read by "inverse-model" grows e-fold (dB).
    // Range: 1 to 1000; default 50.
    float equalize_model_scale_db;
    // Speed of "bang-bang" (m/s).
    // Range: 0 to 1; default 0.3.
    float equalize_bang_mps;
    // Imbalance within which "bang-bang" stays (dB).
    // Range: 0 to 100; default 1.5.
    float equalize_bang_band_db;
    // Whether a neighbour nearer than `spacing_db` is backed away from before anything is levelled.
    // 0 or 1; default 0.
    uint8_t equalize_spacing;
    // Loss to a neighbour below which it is too near (dB).
    // Range: -50 to 200; default 40.
    float equalize_spacing_db;
    // Speed of backing away (m/s).
    // Range: 0 to 1; default 0.2.
    float equalize_spacing_mps;
    // Whose centering.
    // One of `UCHAIN_CENTER_LAW_…`; default `UCHAIN_CENTER_LAW_WALL`.
    uint8_t center_law;
    // Lateral gain (1/s).
    // Range: 0 to 20; default 0.5.
    float center_c_t_per_s;
    // Yaw gain (rad/(s·m)).
    // Range: 0 to 50; default 3.5.
    float center_c_r_rad_per_s_m;
    // Largest lateral speed (m/s).
    // Range: 0 to 1; default 0.4.
    float center_lateral_max_mps;
    // Largest yaw rate (rad/s); the default is 60°/s.
    // Range: 0 to 20; default 1.0471976.
    float center_yaw_rate_max_radps;
    // "paper": distance kept from a followed wall, along the beam (m).
    // Range: 0 to 2; default 0.28.
    float center_wall_distance_m;
    // "wall" and "paper": difference of the two sides' front-to-rear ratios from which one wall is ignored (1).
    // Range: 0 to 10; default 0.4.
    float center_invalid_ratio;
    // Leading beam at which forward speed is cut to its floor (m).
    // Range: 0 to 2; default 0.2.
    float center_slow_from_m;
    // Length of leading beam over which forward speed recovers (m).
    // Range: 0.001 to 2; default 0.3.
    float center_slow_over_m;
    // Smallest share of the forward speed that is left (1).
    // Range: 0 to 1; default 0.2.
    float center_slow_floor;
    // Beam below which the UAV is pushed to the other side, whatever the law says (m).
    // Range: 0 to 2; default 0.2.
    float center_push_below_m;
    // Speed of that push (m/s).
    // Range: 0 to 1; default 0.2.
    float center_push_mps;
    // "wall": share of the trailing beam below which a side's leading beam counts as closed; with both
    // sides closed there is a wall ahead, and the UAV turns away from the nearer side (1).
    // Range: 0 to 1; default 0.7.
    float center_closed_share;
    // "wall": largest distance kept from a followed wall, by the nearer of its two beams (m).
    // Range: 0 to 2; default 0.45.
    float center_follow_distance_m;
    // "wall": lateral gain along a followed wall (1/s).
    // Range: 0 to 20; default 1.
    float center_follow_lateral_per_s;
    // "wall": largest lateral speed along a followed wall (m/s).
    // Range: 0 to 1; default 0.25.
    float center_follow_lateral_max_mps;
    // "firmware": lateral gain (1/s).
    // Range: 0 to 20; default 2.
    float center_firmware_lateral_per_s;
    // "firmware": yaw rate per relative difference of a side's beams (rad/s); the default is 30°/s.
    // Range: 0 to 20; default 0.5235988.
    float center_firmware_yaw_radps;
    // "firmware": width from which the nearer wall is followed instead of centering (m).
    // Range: 0 to 20; default 1.
    float center_firmware_wide_m;
    // "firmware": distance kept from a followed wall (m).
    // Range: 0 to 2; default 0.39.
    float center_firmware_goal_m;
    // Loss of the base link above which the chain needs one more UAV (dB).
    // Range: -50 to 200; default 60.
    float takeoff_s_min_db;
    // What a take-off waits for besides the threshold.
    // One of `UCHAIN_LAUNCH_…`; default `UCHAIN_LAUNCH_THRESHOLD`.
    uint8_t takeoff_launch;
    // Imbalance of every relay, by its own estimates, that counts as levelled for "converged" (dB).
    // Range: 0 to 100; default 4.
    float takeoff_converged_db;
    // Which loss of the base link is compared with `s_min_db`.
    // One of `UCHAIN_SIGNAL_…`; default `UCHAIN_SIGNAL_FILTERED`.
    uint8_t takeoff_launch_signal;
    // How long the loss must stay above `s_min_db` (s). 1 s avoids needless late launches.
    // Range: 0 to 600; default 1.
    float takeoff_launch_hold_s;
    // How long the UAV ahead must have flown (s).
    // Range: 0 to 600; default 3.
    float takeoff_after_previous_s;
    // Time from the ground to flight height (s).
    // Range: 0 to 60; default 1.
    float takeoff_rise_s;
    // Time of hovering before the UAV follows its laws (s).
    // Range: 0 to 60; default 1.
    float takeoff_hover_s;
    // Loss that relays level and thresholds look at.
    // One of `UCHAIN_SIGNAL_…`; default `UCHAIN_SIGNAL_FILTERED`.
    uint8_t link_signal;
    // What a filter does in a decision period without a packet.
    // One of `UCHAIN_GAP_…`; default `UCHAIN_GAP_HOLD`.
    uint8_t link_gap;
    // How long "predict" predicts before it holds (s).
    // Range: 0 to 600; default 1.
    float link_predict_s;
    // Whether optic flow drives the filter of the link to the base as well, and that of the next UAV in line, which
    // stands at the base and measures what will be its link.
    // 0 or 1; default 1.
    uint8_t link_base_flow;
    // Silence after which a link is lost (s).
    // Range: 0 to 600; default 1.
    float link_lost_s;
    // Loss of the head's back link, by `signal`, above which its forward command is zeroed (dB).
    // Range: -50 to 300; default 70.
    float link_head_stop_db;
    // Loss of the head's back link, by `signal`, above which it is forced backward (dB).
    // Range: -50 to 300; default 75.
    float link_head_back_db;
    // Loss of a relay's back link, by `signal`, above which it flies backward (dB).
    // Range: -50 to 300; default 80.
    float link_relay_back_db;
    // How far a loss must fall below its threshold before the override ends (dB).
    // Range: 0 to 100; default 3.
    float link_hysteresis_db;
    // Speed of a forced retreat (m/s).
    // Range: 0 to 1; default 0.2.
    float link_retreat_mps;
    // What a ToF sensor reads that sees nothing (m).
    // Range: 0.1 to 100; default 2.
    float tof_range_m;
} uchain_params;

// All a chain node may ask of its body. Axes: x forward, y left, angles counter-clockwise.
typedef struct uchain_command {
    // Forward velocity (m/s), negative backward; at most `equalize_v_max_mps`.
    float forward_mps;
    // Leftward velocity (m/s), negative to the right.
    float lateral_mps;
    // Yaw rate, counter-clockwise seen from above (rad/s).
    float yaw_rate_radps;
    // 1: take off if it stands on the ground, and stay in the air; 0: stay on the ground.
    uint8_t airborne;
} uchain_command;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Version of the library that is linked; it has to be `UCHAIN_ABI_VERSION`.
uint32_t uchain_abi_version(void);

// What a node believes after `uchain_step` with this observation.
uchain_status uchain_explain(const struct uchain_node *node,
                             const struct uchain_observation *observation,
                             struct uchain_explanation *explanation);

// Takes in a packet that the radio brought, for the next decision; of each sender the newest counts. `bytes` and `length`:
// as received, whatever they are. `loss_db`: the received power (RSSI in dBm) with its sign changed (dB), bigger is worse.
//
// Of more than 8 senders between two decisions those are kept that are next to the node's place, as it was told last; told none, a
// relay believes to be the last before the base. `UCHAIN_STATUS_OUT_OF_RANGE`: the
// loss is not finite.
uchain_status uchain_hear(struct uchain_node *node,
                          const uint8_t *bytes,
                          uint32_t length,
                          float loss_db);

// What the node tells whoever hears it: call it before `uchain_step`, with the same observation, and broadcast the first
// bytes of `out`, as many as it returns (14 to `UCHAIN_PACKET_MAX`). `out` has room for `UCHAIN_PACKET_MAX` bytes. 0: a
// pointer or a choice is wrong, and there is nothing to send.
uint8_t uchain_say(struct uchain_node *node,
                   const struct uchain_observation *observation,
                   uint8_t *out);

// What the base station tells whoever hears it, five times a second or more often: it stands still, behind everybody.
// `sequence`: one more every time; 255 is followed by 0. `out` has room for `UCHAIN_PACKET_MAX` bytes. How many of them to
// broadcast; 0: `out` is NULL.
uint8_t uchain_say_base(uint8_t sequence,
                        uint8_t *out);

// Makes a node on the ground. `role`: one of `UCHAIN_ROLE_…`; later on its place says whether it leads. `id`: what other
// UAVs know it by, its own for life, not `UCHAIN_BASE_ID`. `params` are copied.
//
// `UCHAIN_STATUS_BAD_CHOICE` or `UCHAIN_STATUS_OUT_OF_RANGE`: the node is not made; `uchain_params_check` says which key is wrong.
uchain_status uchain_node_init(struct uchain_node *node,
                               uint8_t role,
                               uint16_t id,
                               const struct uchain_params *params);

// One step of the control loop: shows the node what is seen, and asks it what to do. Call it at the rate of the loop, 20 Hz
// say, with `is_decision_due` every `equalize_decision_s`.
//
// Whatever is wrong, the command is safe: it says to hover, or to stay on the ground if the node has not taken off.
uchain_status uchain_step(struct uchain_node *node,
                          const struct uchain_observation *observation,
                          struct uchain_command *command);

// Writes the defaults.
uchain_status uchain_params_default(struct uchain_params *params);

// Writes the values of the authors' simulator, with which the figures of Laclau 2021 were computed: preset
// "frontiers2021" of the simulator.
uchain_status uchain_params_frontiers2021(struct uchain_params *params);

// Writes the values of the authors' flight firmware, which flew in the experiment of Laclau 2021: preset "cavemod" of the
// simulator. It decides ten times a second.
uchain_status uchain_params_cavemod(struct uchain_params *params);

// Looks whether params are legal. If not, `key` (if it is not NULL) is set to the name of the first key that is wrong, as in
// a scenario file, `equalize.k_db_per_m` say: text that is there for ever, ended by a 0. Else it is set to NULL.
//
// Every key by itself: that thresholds are in order (`takeoff_s_min_db` below `link_head_stop_db` below `link_head_back_db`, and
// below `link_relay_back_db`) is not looked at. If they are not, the head stops before the next relay takes off.
uchain_status uchain_params_check(const struct uchain_params *params,
                                  const char **key);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

/* What the library was compiled with: a compiler that lays a struct out otherwise stops here. */
typedef char uchain_node_has_its_size[sizeof(uchain_node) == 4 * UCHAIN_NODE_WORDS ? 1 : -1];
typedef char uchain_params_has_its_size[sizeof(uchain_params) == UCHAIN_PARAMS_BYTES ? 1 : -1];
typedef char uchain_observation_has_its_size[sizeof(uchain_observation) == UCHAIN_OBSERVATION_BYTES ? 1 : -1];
typedef char uchain_command_has_its_size[sizeof(uchain_command) == UCHAIN_COMMAND_BYTES ? 1 : -1];
typedef char uchain_explanation_has_its_size[sizeof(uchain_explanation) == UCHAIN_EXPLANATION_BYTES ? 1 : -1];

#endif /* UCHAIN_H */
