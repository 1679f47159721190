//! A scenario's schema, put together from what missions hand in.

use serde_json::{Value, json};
use uchain_core::params::Key;

use super::super::{
    super::{Keys, KnownKeys, builtin},
    explain,
    schema::{schema, schema_of, schema_with_table},
};
use crate::{
    mission::{Scene as _, chain::Course, explore::Site},
    registry::Registry,
};

uchain_core::params! {
    /// Robots in a ring.
    #[derive(serde::Serialize)]
    pub struct RingConfig {
        /// Radius of the ring (m).
        pub radius_m: f64, in 0.1..=10.0;
    }
}

const RING: Key = Key { name: "ring", range: None, doc: "Robots in a ring." };
const RING_KEYS: Keys = Keys {
    marker: Some("ring"),
    tables: &[("", &[RING]), ("ring", RingConfig::KEYS)],
    renamed: &[("ring.size_m", "ring.radius_m")],
};

/// The schema of the missions there are, and of one more.
fn of_three() -> Value {
    schema([
        (&RING_KEYS, schema_with_table(&RING, [schema_of::<RingConfig>()])),
        (Course::KEYS, Course::schema(Course::BUILTIN)),
        (Site::KEYS, Site::schema(Site::BUILTIN)),
    ])
}

/// Whether a schema takes a scenario with these keys at the top, whatever their values are.
fn takes(schema: &Value, keys: &[&str]) -> bool {
    let Some(schema) = schema.as_object() else { return schema == &json!(true) };
    let has = |name: &str| keys.contains(&name);
    let required = schema.get("required").and_then(Value::as_array).into_iter().flatten();
    let properties = schema.get("properties").and_then(Value::as_object);
    let branch = schema.get("if").map(|condition| if takes(condition, keys) { "then" } else { "else" });
    required.clone().all(|name| has(name.as_str().unwrap()))
        && properties.into_iter().flatten().all(|(name, rule)| rule != &json!(false) || !has(name))
        && branch.is_none_or(|branch| takes(&schema[branch], keys))
}

#[test]
fn each_mission_has_its_own_keys_and_no_others() {
    let schema = of_three();
    let taken = |keys: &[&str]| takes(&schema, &[&["name", "duration_s", "map"], keys].concat());
    for right in [&["ring"][..], &["explore"], &["chain", "pilot"], &["chain", "pilot", "preset", "motion"]] {
        assert!(taken(right), "{right:?}");
    }
    for wrong in [
        &[][..],
        &["chain"],
        &["pilot"],
        &["ring", "explore"],
        &["ring", "chain", "pilot"],
        &["explore", "preset"],
    ] {
        assert!(!taken(wrong), "{wrong:?}");
    }
    assert!(!takes(&schema, &["name", "duration_s", "ring"]), "without a map");
}

#[test]
fn a_further_mission_leaves_what_is_said_of_the_others_and_is_explained() {
    let (three, two) = (of_three(), Registry::default().schema());
    for (name, key) in two["properties"].as_object().unwrap() {
        assert_eq!(&three["properties"][name], key, "{name}");
    }
    assert_eq!(three["title"], two["title"]);
    let radius = &three["properties"]["ring"];
    assert_eq!(
        (&radius["required"], &radius["properties"]["radius_m"]["maximum"]),
        (&json!(["radius_m"]), &json!(10.0))
    );

    let known = KnownKeys::of(&[Course::KEYS, Site::KEYS, &RING_KEYS]);
    let explain = |name: &str| explain(name, &three, &known);
    assert_eq!(explain("ring").unwrap().len(), 2);
    assert_eq!(explain("ring.radius_m").unwrap()[0].range, Some((0.1, 10.0)));
    assert!(explain("size_m").unwrap_err().to_string().ends_with("did you mean 'ring.radius_m'?"));
    // The last part of its name is now that of two keys.
    let two = explain("radius_m").unwrap_err().to_string();
    assert_eq!(two, "no key is called 'radius_m' (known: motion.radius_m, ring.radius_m)");
}

#[test]
fn what_only_chains_have_is_refused_in_an_exploration_in_words() {
    let schema = Registry::default().schema();
    let foreign = schema["then"]["properties"].as_object().unwrap();
    assert_eq!(foreign.len(), 12);
    let said = |set: &str| {
        let read = crate::mission::explore::ExploreScenario::parse(
            &builtin("apartment").unwrap(),
            &[set.to_owned()],
        );
        read.map_or_else(|error| error.to_string(), |_| "ok".to_owned())
    };
    for key in foreign.keys() {
        let value = match key.as_str() {
            "preset" => "cavemod",
            "pilot" => "[]",
            _ => "{}",
        };
        let said = said(&format!("{key}={value}"));
        assert!(
            said.contains("belongs to a chain, and a scenario with [explore] is an exploration"),
            "{key}: {said}"
        );
    }
    assert_eq!(said("explore.robots=2"), "ok");
}

#[test]
fn a_mission_alone_asks_for_all_it_needs() {
    let alone = schema([(Course::KEYS, Course::schema(Course::BUILTIN))]);
    assert!(alone.get("if").is_none());
    assert!(takes(&alone, &["name", "duration_s", "map", "chain", "pilot"]));
    assert!(!takes(&alone, &["name", "duration_s", "map", "chain"]));
    // Without a mission for what has no marker, nothing else is a scenario.
    let marked = schema([(Site::KEYS, Site::schema(Site::BUILTIN))]);
    assert!(takes(&marked, &["name", "duration_s", "map", "explore"]));
    assert!(!takes(&marked, &["name", "duration_s", "map"]));
}
