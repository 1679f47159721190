//! JSON Schema of values that are not a single number, a word of an enum or a table.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use super::super::{PRESETS, Preset, check::NAME_LENGTH_MAX};

pub(crate) use crate::map::shape::{point, points};

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
