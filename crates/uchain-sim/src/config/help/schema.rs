//! What a scenario file may hold, as JSON Schema: for editors, and for [`explain`](super::explain).

use schemars::{JsonSchema, generate::SchemaSettings};
use serde_json::{Map, Number, Value, json};

use uchain_core::params::Key;

use super::super::{Heading, Keys};

/// JSON Schema (draft 7) of a scenario file, put together from those of the missions: a scenario is of the first mission
/// whose marker it has, else of the one without a marker. Of a key that several have at the top, the first one's
/// description counts, that of the mission without a marker before all others; words that only another one knows are
/// added to it.
pub(crate) fn schema(missions: impl IntoIterator<Item = (&'static Keys, Value)>) -> Value {
    let (marked, unmarked): (Vec<_>, Vec<_>) =
        missions.into_iter().map(|(keys, schema)| (keys.marker, schema)).partition(|(it, _)| it.is_some());
    let mut schema =
        unmarked.first().map_or_else(|| json!({ "type": "object" }), |(_, schema)| schema.clone());
    let all = || unmarked.iter().chain(&marked).map(|(_, schema)| schema);

    let mut properties = Map::new();
    for (name, key) in all().filter_map(|schema| schema["properties"].as_object()).flatten() {
        match properties.get_mut(name) {
            Some(known) => add_words(known, key),
            None => _ = properties.insert(name.clone(), key.clone()),
        }
    }
    let everywhere: Vec<&str> = all().next().map_or_else(Vec::new, required);
    let everywhere: Vec<&str> =
        everywhere.into_iter().filter(|name| all().all(|schema| required(schema).contains(name))).collect();

    // What has to be there, and what must not, depends on whose scenario it is.
    let markers: Vec<&str> = marked.iter().filter_map(|(marker, _)| *marker).collect();
    let mut names: Vec<&String> = properties.keys().collect();
    names.sort_by_key(|name| !all().any(|schema| required(schema).contains(&name.as_str())));
    let rules = |schema: &Value, absent: &[&str]| {
        let foreign = names.iter().filter(|name| schema["properties"].get(name).is_none());
        let foreign = foreign.filter(|name| !absent.contains(&name.as_str()));
        let foreign: Map<String, Value> = foreign.map(|name| ((*name).clone(), false.into())).collect();
        let own: Vec<&str> = required(schema)
            .into_iter()
            .filter(|name| !everywhere.contains(name) && !markers.contains(name))
            .collect();
        let mut rules = Map::new();
        if !own.is_empty() {
            rules.insert("required".to_owned(), own.into());
        }
        if !foreign.is_empty() {
            rules.insert("properties".to_owned(), foreign.into());
        }
        Value::Object(rules)
    };
    // One condition after another; none of the markers is there where only the last is left.
    let mut rest = unmarked.first().map_or(json!(false), |(_, schema)| rules(schema, &markers));
    for (place, (marker, own)) in marked.iter().enumerate().rev() {
        let absent = markers.get(..place).unwrap_or_default();
        rest = json!({ "if": { "required": [marker] }, "then": rules(own, absent), "else": rest });
    }

    let required = json!(everywhere);
    schema["required"] = required;
    schema["properties"] = properties.into();
    if let (Some(schema), Value::Object(rest)) = (schema.as_object_mut(), rest) {
        schema.extend(rest);
    }
    tidy(&mut schema);
    schema
}

/// Adds the choices of a key, or of the keys of a table, that only another mission has.
fn add_words(known: &mut Value, other: &Value) {
    if let (Some(Value::Array(known)), Some(Value::Array(other))) =
        (known.get_mut("oneOf"), other.get("oneOf"))
    {
        for word in other {
            if !known.contains(word) {
                known.push(word.clone());
            }
        }
    }
    let tables = (known.get_mut("properties"), other.get("properties"));
    if let (Some(Value::Object(known)), Some(Value::Object(other))) = tables {
        for (name, known) in known {
            if let Some(other) = other.get(name) {
                add_words(known, other);
            }
        }
    }
}

/// Names of the keys that have to be written.
fn required(schema: &Value) -> Vec<&str> {
    schema["required"]
        .as_array()
        .map(Vec::as_slice)
        .unwrap_or_default()
        .iter()
        .filter_map(Value::as_str)
        .collect()
}

/// JSON Schema of what is read into a type, written out in full: editors show what stands at a key, not what it refers
/// to.
pub fn schema_of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
    settings.into_generator().into_root_schema_for::<T>().to_value()
}

/// JSON Schema of a scenario of which everything but the [`Heading`] stands in one table; `parts` are that table's keys.
pub fn schema_with_table<const N: usize>(table: &Key, parts: [Value; N]) -> Value {
    let mut schema = schema_of::<Heading>();
    let needed: Vec<Value> = parts.iter().flat_map(required).map(Value::from).collect();
    let keys =
        parts.into_iter().filter_map(|mut part| part["properties"].as_object_mut().map(std::mem::take));
    let keys: Map<String, Value> = keys.flatten().collect();
    let mut written = json!({
        "description": table.doc, "type": "object", "properties": keys, "additionalProperties": false,
    });
    if !needed.is_empty() {
        written["required"] = needed.into();
    }
    schema["properties"][table.name] = written;
    schema
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
