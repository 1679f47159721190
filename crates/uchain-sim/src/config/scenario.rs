//! The shape of a scenario file. Field names are the file's keys.

use serde::{Deserialize, Serialize};
use uchain_core::chain::{CenterParams, EqualizeParams, Follow, KalmanParams, LinkParams, TakeoffParams};

use crate::{
    radio::{FaultConfig, PacketParams, PathLossParams},
    sense::{FlowParams, TofParams},
    world::MotionParams,
};

/// One mission in one map. The tables after `pilot` are the rooms' own Params; all of them are optional.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Short name; it names the output folder.
    pub name: String,
    /// One line that says what happens.
    #[serde(default)]
    pub description: String,
    /// Name of the [`Preset`](super::Preset) that filled in what is not written here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// Simulated time (s), a multiple of the tick.
    pub duration_s: f64,
    /// The tunnel.
    pub map: MapConfig,
    /// Who flies and where they wait.
    pub chain: ChainConfig,
    /// What the pilot asks of the head, in order of time.
    pub pilot: Vec<PilotStep>,
    /// Filter of each link end.
    #[serde(default)]
    pub kalman: KalmanParams,
    /// Law that levels the two links of a relay.
    #[serde(default)]
    pub equalize: EqualizeParams,
    /// Law that keeps a UAV in mid-tunnel.
    #[serde(default)]
    pub center: CenterParams,
    /// When the next UAV takes off.
    #[serde(default)]
    pub takeoff: TakeoffParams,
    /// Head override, retreat, lost links.
    #[serde(default)]
    pub link: LinkParams,
    /// Path loss.
    #[serde(default)]
    pub radio: PathLossParams,
    /// Delivery of packets.
    #[serde(default)]
    pub packets: PacketParams,
    /// Planned faults.
    #[serde(default)]
    pub faults: FaultConfig,
    /// Distance sensors.
    #[serde(default)]
    pub tof: TofParams,
    /// Optic flow.
    #[serde(default)]
    pub flow: FlowParams,
    /// The body.
    #[serde(default)]
    pub motion: MotionParams,
}

/// Where the map comes from: one of `[map.corridor]`, `[map.walls]` and `[map.ros]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum MapConfig {
    /// A corridor of one width along a centre line.
    Corridor(CorridorConfig),
    /// Walls drawn one by one.
    Walls(WallsConfig),
    /// A ROS `map_server` map.
    Ros(RosConfig),
}

/// A corridor of one width along a centre line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CorridorConfig {
    /// Corners of the centre line: `[x, y]` (m), or `[x, y, r]` with a bend of radius r there (m).
    pub centre_line_m: Vec<Vec<f64>>,
    /// Free width, wall to wall (m).
    pub width_m: f64,
    /// Whether the last corner joins the first again.
    #[serde(default)]
    pub closed: bool,
}

/// Walls drawn one by one, as closed loops of corners `[x, y]` (m). Loops neither cross nor touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallsConfig {
    /// What surrounds the free space.
    pub outer_m: Vec<[f64; 2]>,
    /// Solid pieces that stand in it.
    #[serde(default)]
    pub inner_m: Vec<Vec<[f64; 2]>>,
}

/// A ROS `map_server` map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RosConfig {
    /// Path of the yaml file, from the folder of the scenario file (from the working folder for a
    /// compiled-in scenario).
    pub file: std::path::PathBuf,
    /// What cells of unknown state are.
    #[serde(default)]
    pub unknown: crate::map::Unknown,
    /// How far a simplified wall may lie from the cells' edge (m).
    #[serde(default = "default_simplify_m")]
    pub simplify_m: f64,
}

fn default_simplify_m() -> f64 {
    0.06
}

/// Who flies and where they wait.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChainConfig {
    /// UAVs, the head included (1 to 1,000).
    pub uavs: usize,
    /// The base station (m).
    pub base_m: [f64; 2],
    /// The deepest place the head may be sent to (m). A map without a centre line needs it for what is counted in
    /// depth: the optimum and the plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal_m: Option<[f64; 2]>,
    /// How long a UAV flies on one battery (s), for the plan (1 to 86,400); 5 to 15 min in Laclau 2021, §7.
    #[serde(default = "default_endurance_s")]
    pub endurance_s: f32,
    /// Direction of the tunnel at the base, counter-clockwise from the map's x axis (degrees).
    #[serde(default)]
    pub heading_deg: f32,
    /// Distance between waiting UAVs, in a row from the base along `heading_deg`, the head farthest (m).
    #[serde(default = "default_spacing_m")]
    pub spacing_m: f32,
    /// Explicit waiting places instead of the row, head first (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spawns_m: Option<Vec<[f64; 2]>>,
}

fn default_endurance_s() -> f32 {
    420.0
}

fn default_spacing_m() -> f32 {
    0.25
}

/// What the pilot asks of the head from one moment on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PilotStep {
    /// From when on (s).
    pub start_s: f64,
    /// Forward speed, negative backward (m/s).
    pub speed_mps: f32,
    /// Wall to follow.
    #[serde(default)]
    pub follow: Follow,
}
