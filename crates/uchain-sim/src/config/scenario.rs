//! The shape of a scenario file. Field names are the file's keys.

use serde::{Deserialize, Serialize};
use uchain_core::chain::{CenterParams, EqualizeParams, Follow, KalmanParams, LinkParams, TakeoffParams};

use crate::{
    radio::{FaultConfig, PacketParams, PathLossParams},
    sense::{FlowParams, TofParams},
    world::MotionParams,
};

uchain_core::params! {
    /// One mission in one map. All tables but `map`, `chain` and `pilot` may be left out.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Scenario {
        /// Short name; it names the output folder.
        #[schemars(schema_with = "super::help::shape::name")]
        pub name: String;
        /// One line that says what happens.
        #[serde(default)]
        pub description: String;
        /// Name of a preset, which fills in what is not written here.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "super::help::shape::preset")]
        pub preset: Option<String>;
        /// Simulated time (s); a multiple of the tick, 0.05 s.
        pub duration_s: f64, in 0.05..=86_400.0;
        /// The tunnel: one of `[map.corridor]`, `[map.walls]`, `[map.movingai]` and `[map.ros]`.
        pub map: MapConfig;
        /// Who flies and where they wait.
        pub chain: ChainConfig;
        /// What the pilot asks of the head, in order of time.
        pub pilot: Vec<PilotStep>;
        /// Filter of each link end.
        #[serde(default)]
        pub kalman: KalmanParams;
        /// Law that levels the two links of a relay.
        #[serde(default)]
        pub equalize: EqualizeParams;
        /// Law that keeps a UAV in mid-tunnel.
        #[serde(default)]
        pub center: CenterParams;
        /// When the next UAV takes off.
        #[serde(default)]
        pub takeoff: TakeoffParams;
        /// Head override, retreat, lost links.
        #[serde(default)]
        pub link: LinkParams;
        /// Path loss.
        #[serde(default)]
        pub radio: PathLossParams;
        /// Delivery of packets.
        #[serde(default)]
        pub packets: PacketParams;
        /// Planned faults.
        #[serde(default)]
        pub faults: FaultConfig;
        /// Distance sensors.
        #[serde(default)]
        pub tof: TofParams;
        /// Optic flow.
        #[serde(default)]
        pub flow: FlowParams;
        /// The body.
        #[serde(default)]
        pub motion: MotionParams;
    }
}

/// Where the map comes from: one of `[map.corridor]`, `[map.walls]`, `[map.movingai]` and `[map.ros]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum MapConfig {
    /// A corridor of one width along a centre line.
    Corridor(CorridorConfig),
    /// Walls drawn one by one.
    Walls(WallsConfig),
    /// A grid map of the MovingAI benchmarks.
    Movingai(MovingAiConfig),
    /// A ROS `map_server` map.
    Ros(RosConfig),
}

uchain_core::params! {
    /// A corridor of one width along a centre line.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct CorridorConfig {
        /// Corners of the centre line: `[x, y]` (m), or `[x, y, r]` with a bend of radius r there (m).
        #[schemars(schema_with = "super::help::shape::corners")]
        pub centre_line_m: Vec<Vec<f64>>;
        /// Free width, wall to wall (m).
        pub width_m: f64, in 0.1..=100.0;
        /// Whether the last corner joins the first again.
        #[serde(default)]
        pub closed: bool;
    }
}

uchain_core::params! {
    /// Walls drawn one by one, as closed loops of corners `[x, y]` (m). Loops neither cross nor touch. Rock within rock
    /// is rock, and beyond the outer wall all is.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct WallsConfig {
        /// Corners of what surrounds the free space (m).
        #[schemars(schema_with = "super::help::shape::points")]
        pub outer_m: Vec<[f64; 2]>;
        /// Corners of the solid pieces that stand in it (m).
        #[serde(default)]
        #[schemars(schema_with = "super::help::shape::loops")]
        pub inner_m: Vec<Vec<[f64; 2]>>;
    }
}

uchain_core::params! {
    /// A grid map of the MovingAI benchmarks (`type octile`): `.`, `G` and `S` are free.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct MovingAiConfig {
        /// Path of the map file, from the folder of the scenario file (from the working folder for a compiled-in
        /// scenario).
        pub file: std::path::PathBuf;
        /// Side of a cell (m); the file does not say.
        /// - Source: ours
        #[serde(default = "default_cell_m")]
        pub cell_m: f64, in 0.001..=1000.0;
    }
}

fn default_cell_m() -> f64 {
    0.5
}

uchain_core::params! {
    /// A ROS `map_server` map.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct RosConfig {
        /// Path of the yaml file, or of the picture alone (pgm, png; then cells are 0.05 m unless `cell_m` says otherwise),
        /// from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: std::path::PathBuf;
        /// What cells of unknown state are.
        #[serde(default)]
        pub unknown: crate::map::Unknown;
        /// Side of a cell (m), instead of the file's own `resolution`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.001, max = 1000.0))]
        pub cell_m: Option<f64>;
        /// How far a simplified wall may lie from the cells' edge (m).
        /// - Source: ours
        #[serde(default = "default_simplify_m")]
        pub simplify_m: f64, in 0.0..=1.0;
    }
}

fn default_simplify_m() -> f64 {
    0.06
}

uchain_core::params! {
    /// Who flies and where they wait.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct ChainConfig {
        /// UAVs, the head included.
        /// - Symbol: `n`
        /// - Source: Laclau 2021, §3.1; a head and 3 relays in its §6.1.3
        pub uavs: usize, in 1..=1000;
        /// The base station (m).
        #[schemars(schema_with = "super::help::shape::point")]
        pub base_m: [f64; 2];
        /// The deepest place the head may be sent to (m). A map without a centre line needs it for what is counted in
        /// depth: the optimum and the plan.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "super::help::shape::point")]
        pub goal_m: Option<[f64; 2]>;
        /// How long a UAV flies on one battery (s), for the plan.
        /// - Source: Laclau 2021, §7 (5 to 15 min); the value is ours
        #[serde(default = "default_endurance_s")]
        pub endurance_s: f32, in 1.0..=86_400.0;
        /// Direction of the tunnel at the base, counter-clockwise from the map's x axis (degrees).
        /// - Source: ours
        #[serde(default)]
        pub heading_deg: f32, in -360.0..=360.0;
        /// Distance between waiting UAVs, in a row from the base along `heading_deg`, the head farthest (m).
        /// - Source: ours
        #[serde(default = "default_spacing_m")]
        pub spacing_m: f32, in 0.0..=100.0;
        /// Explicit waiting places instead of the row, head first, one per UAV (m).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "super::help::shape::points")]
        pub spawns_m: Option<Vec<[f64; 2]>>;
    }
}

fn default_endurance_s() -> f32 {
    420.0
}

fn default_spacing_m() -> f32 {
    0.25
}

uchain_core::params! {
    /// What the pilot asks of the head from one moment on.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct PilotStep {
        /// From when on (s), later than the step before.
        pub start_s: f64, in 0.0..=86_400.0;
        /// Forward speed, negative backward (m/s).
        /// - Source: Laclau 2021, §6.1.3 (0.2)
        pub speed_mps: f32, in -1.0..=1.0;
        /// Wall to follow.
        /// - Source: Laclau 2021, Eq. 21 and §7
        #[serde(default)]
        pub follow: Follow;
    }
}
