//! Maps, as a scenario asks for them.

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
