//! Maps and radio laid out as a scenario asks for them, and places in a map.

mod radio;

use glam::Vec2;

pub use radio::lay_radio;

use crate::{
    config::{ConfigError, CorridorConfig, Document, MapConfig, MovingAiConfig, RosConfig, WallsConfig},
    map::{CentreLine, Map, MapError, Vertex, corridor, drawn, read_moving_ai, read_ros},
};

/// The map a scenario asks for, and its middle if it is a corridor, which is built around a place (m). Files are read from
/// the folder of the document.
///
/// # Errors
/// [`ConfigError::Map`]: no such file, or no map.
pub fn lay_map(
    config: &MapConfig,
    around_m: [f64; 2],
    document: &Document<'_>,
) -> Result<(Map, Option<CentreLine>), ConfigError> {
    let laid = match config {
        MapConfig::Corridor(config) => build(config, around_m).map(|(map, line)| (map, Some(line))),
        MapConfig::Walls(config) => draw(config).map(|map| (map, None)),
        MapConfig::Movingai(config) => read_grid(config, document).map(|map| (map, None)),
        MapConfig::Ros(config) => read(config, document).map(|map| (map, None)),
    };
    let key = match config {
        MapConfig::Corridor(_) => "map.corridor",
        MapConfig::Walls(_) => "map.walls",
        MapConfig::Movingai(_) => "map.movingai.file",
        MapConfig::Ros(_) => "map.ros.file",
    };
    laid.map_err(|cause| refuse(document, key, cause))
}

/// Builds a corridor around the base: there `f32` is finest, wherever the scenario's own frame has its origin.
fn build(config: &CorridorConfig, [base_x_m, base_y_m]: [f64; 2]) -> Result<(Map, CentreLine), MapError> {
    let around = |x_m: f64, y_m: f64| {
        let corner = |numbers: &Vec<f64>| Vertex {
            x: numbers.first().copied().unwrap_or_default() - x_m,
            y: numbers.get(1).copied().unwrap_or_default() - y_m,
            bend_radius_m: numbers.get(2).copied().unwrap_or_default(),
        };
        let corners: Vec<Vertex> = config.centre_line_m.iter().map(corner).collect();
        corridor(&corners, config.width_m, config.closed)
    };
    match around(base_x_m, base_y_m) {
        Ok((map, line)) => Ok((map.with_offset_m([base_x_m, base_y_m]), line)),
        // What is wrong is said in the scenario's own coordinates.
        Err(cause) => Err(around(0.0, 0.0).err().unwrap_or(cause)),
    }
}

fn draw(config: &WallsConfig) -> Result<Map, MapError> {
    let loops: Vec<Vec<[f64; 2]>> =
        std::iter::once(&config.outer_m).chain(&config.inner_m).cloned().collect();
    drawn(&loops)
}

fn read(config: &RosConfig, document: &Document<'_>) -> Result<Map, MapError> {
    read_ros(&document.folder().join(&config.file), config.unknown, config.cell_m, config.simplify_m)
}

fn read_grid(config: &MovingAiConfig, document: &Document<'_>) -> Result<Map, MapError> {
    read_moving_ai(&document.folder().join(&config.file), config.cell_m)
}

pub(crate) fn refuse(document: &Document<'_>, key: &str, cause: MapError) -> ConfigError {
    ConfigError::Map { at: document.origin(key), key: key.to_owned(), cause: Box::new(cause) }
}

/// What a place is that lies beyond all free ground: how far that reaches, in the scenario's own frame.
pub fn outside(map: &Map, at: Vec2) -> Option<String> {
    let (low, high) = map.bounds();
    if at.cmpge(low).all() && at.cmple(high).all() {
        return None;
    }
    let [x_m, y_m] = map.offset_m();
    let own = |at: Vec2| [f64::from(at.x) + x_m, f64::from(at.y) + y_m].map(to_a_micrometre);
    let ([left, bottom], [right, top]) = (own(low), own(high));
    Some(format!("outside the map, which reaches from ({left}, {bottom}) to ({right}, {top}) m"))
}

/// What a place in rock is; `None` for free ground.
pub fn in_rock(map: &Map, at: Vec2) -> Option<String> {
    let words =
        || outside(map, at).map_or_else(|| "in rock".to_owned(), |outside| format!("in rock, {outside}"));
    map.in_rock(at).then(words)
}

/// For messages (m): a sum of binary fractions shows no digits that nobody wrote.
pub(crate) fn to_a_micrometre(at_m: f64) -> f64 {
    (at_m * 1e6).round() / 1e6
}
