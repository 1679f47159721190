//! Any file for a map: a drawing is read, or refused in words.

use std::path::Path;

use uchain_sim::map::{
    DxfConfig, GeojsonConfig, Map, MapError, SvgConfig, dxf_in_memory, geojson_in_memory, svg_in_memory,
};

/// Bytes as an SVG drawing.
///
/// # Panics
/// If the walls of a map cross, or lie nowhere; if an error says nothing.
pub fn svg(bytes: &[u8]) {
    judge(svg_in_memory(Path::new("a.svg"), bytes, &SvgConfig::default()));
}

/// Bytes as a GeoJSON file, in degrees or metres by the first of them.
///
/// # Panics
/// As [`svg`].
pub fn geojson(bytes: &[u8]) {
    let metres = bytes.first().is_some_and(u8::is_ascii_whitespace);
    let config = GeojsonConfig { metres, ..GeojsonConfig::default() };
    judge(geojson_in_memory(Path::new("a.geojson"), bytes, &config));
}

/// Bytes as a DXF drawing.
///
/// # Panics
/// As [`svg`].
pub fn dxf(bytes: &[u8]) {
    judge(dxf_in_memory(Path::new("a.dxf"), bytes, &DxfConfig::default()));
}

pub(crate) fn judge(read: Result<Map, MapError>) {
    match read {
        Ok(map) => {
            assert_eq!(map.first_crossing(), None);
            assert!(map.walls().iter().all(|wall| wall.a.is_finite() && wall.b.is_finite()));
            assert!(map.places().iter().all(|place| !place.name.is_empty()));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
