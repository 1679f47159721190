//! JSON Schema of values that are not a single number, a word of an enum or a table.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use super::super::{
    PRESETS, Preset,
    check::{COORDINATE_MAX_M, FRAME_MAX_M, NAME_LENGTH_MAX},
};

/// The name of a scenario, of which an output folder is made.
pub(crate) fn name(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "string", "pattern": format!("^[A-Za-z0-9_-]{{1,{NAME_LENGTH_MAX}}}$") })
}

/// The name of a preset.
pub(crate) fn preset(_: &mut SchemaGenerator) -> Schema {
    let named = |preset: Preset| json!({ "const": preset.name, "description": preset.description() });
    let names: Vec<Value> = PRESETS.into_iter().map(named).collect();
    json_schema!({ "type": "string", "oneOf": names })
}

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
