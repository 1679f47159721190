//! What a scenario file may hold, as JSON Schema: for editors, and for [`explain`](super::explain).

use schemars::{JsonSchema, generate::SchemaSettings};
use serde_json::{Map, Number, Value, json};

use uchain_core::explore::ExploreParams;

use super::super::keys::EXPLORE;
use crate::mission::{
    chain::Scenario,
    explore::{CHAIN_ONLY, TeamConfig},
};

/// JSON Schema (draft 7) of a scenario file. Names, types, ranges, defaults and descriptions are those of the laws'
/// own declarations. What a schema cannot say is left to [`Course::read`](crate::mission::chain::Course::read): multiples of
/// the tick, keys that must agree, whether the tunnel can be flown.
///
/// ```
/// let schema = uchain_sim::config::help::schema();
/// assert_eq!(schema["properties"]["equalize"]["properties"]["k_db_per_m"]["maximum"], 10000.0);
/// ```
pub fn schema() -> Value {
    // Written out in full: editors show what stands at a key, not what it refers to.
    let mut schema = of::<Scenario>();
    let keys = [of::<TeamConfig>(), of::<ExploreParams>()].map(|mut table| table["properties"].take());
    let keys: Map<String, Value> =
        keys.into_iter().filter_map(|keys| keys.as_object().cloned()).flatten().collect();
    schema["properties"][EXPLORE.name] = json!({
        "description": EXPLORE.doc, "type": "object", "properties": keys, "additionalProperties": false,
    });
    // Which tables there have to be depends on what the scenario is about.
    let chain_only: Map<String, Value> =
        CHAIN_ONLY.iter().map(|key| ((*key).to_owned(), false.into())).collect();
    schema["if"] = json!({ "required": [EXPLORE.name] });
    schema["then"] = json!({ "properties": chain_only });
    if let Some(required) = schema["required"].as_array_mut() {
        let (chain, both) =
            required.iter().cloned().partition::<Vec<_>, _>(|key| CHAIN_ONLY.iter().any(|c| key == c));
        *required = both;
        schema["else"] = json!({ "required": chain });
    }
    tidy(&mut schema);
    schema
}

fn of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
    settings.into_generator().into_root_schema_for::<T>().to_value()
}

/// Leaves what a TOML file and its editor can use: TOML has no null, a number no width, a table no default of its own;
/// and of `oneOf` an editor can say no more than that nothing fits.
fn tidy(schema: &mut Value) {
    let Value::Object(schema) = schema else { return };
    schema.remove("format");
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|name| name != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            schema.insert("type".to_owned(), only);
        }
    }
    match schema.get_mut("default") {
        Some(Value::Null | Value::Object(_)) => _ = schema.remove("default"),
        Some(Value::Number(number)) => shortest(number),
        _ => {}
    }
    if let Some(Value::Array(choices)) = schema.remove("oneOf") {
        if choices.iter().all(|choice| choice["const"].is_string()) {
            words(schema, &choices);
        } else {
            tables(schema, &choices);
        }
    }
    match schema.get_mut("items") {
        Some(Value::Array(several)) => several.iter_mut().for_each(tidy),
        Some(one) => tidy(one),
        None => {}
    }
    if let Some(Value::Object(table)) = schema.get_mut("properties") {
        table.values_mut().for_each(tidy);
    }
}

/// One of several words. Their meanings stand where Taplo looks for them.
fn words(schema: &mut Map<String, Value>, choices: &[Value]) {
    let all = |key: &str| choices.iter().map(|choice| choice[key].clone()).collect::<Vec<_>>();
    schema.insert("type".to_owned(), "string".into());
    schema.insert("enum".to_owned(), all("const").into());
    schema.insert("x-taplo".to_owned(), json!({ "docs": { "enumValues": all("description") } }));
}

/// One of several tables.
fn tables(schema: &mut Map<String, Value>, choices: &[Value]) {
    let all = choices.iter().filter_map(|choice| choice["properties"].as_object().cloned()).flatten();
    schema.insert("type".to_owned(), "object".into());
    schema.insert("properties".to_owned(), Value::Object(all.collect()));
    schema.insert("additionalProperties".to_owned(), false.into());
    schema.insert("minProperties".to_owned(), 1.into());
    schema.insert("maxProperties".to_owned(), 1.into());
}

/// 0.3 instead of 0.30000001192092896: an `f32` made an `f64`.
fn shortest(number: &mut Number) {
    let single = number.as_f64().filter(|_| number.is_f64()).map(|double| (double, double as f32));
    if let Some((double, single)) = single
        && f64::from(single) == double
        && let Some(short) = single.to_string().parse().ok().and_then(Number::from_f64)
    {
        *number = short;
    }
}

/// A key or table of the schema.
pub(super) struct Entry<'s> {
    /// Its full name; the first entry stands for a list of tables: `pilot.0.speed_mps`.
    pub(super) path: String,
    /// Whether it has to be written where its table is.
    pub(super) required: bool,
    /// Whether it holds keys of its own.
    pub(super) is_table: bool,
    /// What is known of it.
    pub(super) schema: &'s Map<String, Value>,
}

/// All keys and tables, in the order in which they are declared, each table before its keys.
pub(super) fn entries(schema: &Value) -> Vec<Entry<'_>> {
    let mut entries = Vec::new();
    collect(schema, "", &mut entries);
    entries
}

fn collect<'s>(table: &'s Value, path: &str, entries: &mut Vec<Entry<'s>>) {
    let Some(properties) = table["properties"].as_object() else { return };
    let required =
        |name: &str| table["required"].as_array().is_some_and(|keys| keys.iter().any(|k| k == name));
    for (name, value) in properties {
        let Some(schema) = value.as_object() else { continue };
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        let is_list = value["items"]["properties"].is_object();
        let is_table = is_list || value["properties"].is_object();
        entries.push(Entry { path: path.clone(), required: required(name), is_table, schema });
        collect(value, &path, entries);
        if is_list {
            collect(&value["items"], &format!("{path}.0"), entries);
        }
    }
}
