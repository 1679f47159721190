//! JSON Schema of places and of lists of them.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::json;

use super::{COORDINATE_MAX_M, FRAME_MAX_M};

/// `[x, y]`, in a map's own frame.
pub(crate) fn point(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": "array",
        "items": { "type": "number", "minimum": -FRAME_MAX_M, "maximum": FRAME_MAX_M },
        "minItems": 2,
        "maxItems": 2,
    })
}

/// A list of [`point`]s.
pub(crate) fn points(generator: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "array", "items": point(generator) })
}

/// A list of loops, each a list of [`point`]s.
pub(crate) fn loops(generator: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "array", "items": points(generator) })
}

/// `[x, y]` or `[x, y, r]`, several of them.
pub(crate) fn corners(_: &mut SchemaGenerator) -> Schema {
    let place = json!({ "type": "number", "minimum": -COORDINATE_MAX_M, "maximum": COORDINATE_MAX_M });
    let radius = json!({ "type": "number", "minimum": 0.0, "maximum": COORDINATE_MAX_M });
    json_schema!({
        "type": "array",
        "items": { "type": "array", "items": [place, place, radius], "minItems": 2, "maxItems": 3 },
        "minItems": 2,
    })
}
