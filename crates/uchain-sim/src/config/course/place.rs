//! Maps, as a scenario asks for them.

use glam::Vec2;

use super::to_a_micrometre;
use crate::{
    config::{
        ConfigError, CorridorConfig, MovingAiConfig, RosConfig, Source, WallsConfig, document::Document,
    },
    map::{CentreLine, Map, MapError, Vertex, corridor, drawn, read_moving_ai, read_ros},
};

/// Builds a corridor around the base: there `f32` is finest, wherever the scenario's own frame has its origin.
pub(in super::super) fn build(
    config: &CorridorConfig,
    [base_x_m, base_y_m]: [f64; 2],
) -> Result<(Map, CentreLine), MapError> {
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

pub(in super::super) fn draw(config: &WallsConfig) -> Result<Map, MapError> {
    let loops: Vec<Vec<[f64; 2]>> =
        std::iter::once(&config.outer_m).chain(&config.inner_m).cloned().collect();
    drawn(&loops)
}

pub(in super::super) fn read(config: &RosConfig, source: &Source) -> Result<Map, MapError> {
    read_ros(&source.folder.join(&config.file), config.unknown, config.cell_m, config.simplify_m)
}

pub(in super::super) fn read_grid(config: &MovingAiConfig, source: &Source) -> Result<Map, MapError> {
    read_moving_ai(&source.folder.join(&config.file), config.cell_m)
}

pub(in super::super) fn refuse(document: &Document<'_>, key: &str, cause: MapError) -> ConfigError {
    ConfigError::Map { at: document.origin(key), key: key.to_owned(), cause: Box::new(cause) }
}

/// What a place is that lies beyond all free ground: how far that reaches, in the scenario's own frame.
pub(in super::super) fn outside(map: &Map, at: Vec2) -> Option<String> {
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
pub(in super::super) fn in_rock(map: &Map, at: Vec2) -> Option<String> {
    let words =
        || outside(map, at).map_or_else(|| "in rock".to_owned(), |outside| format!("in rock, {outside}"));
    map.in_rock(at).then(words)
}
