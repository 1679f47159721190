//! Where the map of a scenario comes from. Field names are the file's keys.

use serde::{Deserialize, Serialize};

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
