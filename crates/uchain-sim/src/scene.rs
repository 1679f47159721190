//! Maps and radio laid out as a scenario asks for them, and places in a map.

mod radio;

use glam::Vec2;

pub use radio::lay_radio;

use crate::{
    config::{ConfigError, Document, MapConfig},
    map::{CentreLine, Map, MapError},
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
    let laid = config.lay(document.folder(), around_m);
    laid.map_err(|cause| refuse(document, &config.format().fault_key(), cause))
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

/// The nearest place with room for a body of this radius, for the end of a message: "; there is room at (3.2, 1.05) m". A rough
/// search on rings, 15 % apart.
pub(crate) fn room_near(map: &Map, at: Vec2, radius_m: f32) -> String {
    const DIRECTIONS: usize = 48;
    let (low, high) = map.bounds();
    let farthest_m = at.distance(low).max(at.distance(high)) + 1.0;
    let mut ring_m = 0.5 * radius_m.max(0.02);
    while ring_m < farthest_m {
        for direction in 0..DIRECTIONS {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * direction as f32 / DIRECTIONS as f32);
            let there = at + Vec2::new(cos, sin) * ring_m;
            if !map.in_rock(there) && map.clearance_m(there) > radius_m + 0.02 {
                let [x_m, y_m] = map.offset_m();
                let [x_m, y_m] = [f64::from(there.x) + x_m, f64::from(there.y) + y_m]
                    .map(|at_m| (100.0 * at_m).round() / 100.0);
                return format!("; there is room at ({x_m}, {y_m}) m");
            }
        }
        ring_m *= 1.15;
    }
    String::new()
}

/// For messages (m): a sum of binary fractions shows no digits that nobody wrote.
pub(crate) fn to_a_micrometre(at_m: f64) -> f64 {
    (at_m * 1e6).round() / 1e6
}
