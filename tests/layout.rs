//! The layout for Foxglove in the docs names nothing that a recording does not hold.

use std::collections::BTreeSet;

use prost::encoding::{DecodeContext, WireType, decode_key, decode_varint, skip_field};
use serde_json::Value;
use uchain_sim::{
    mission::chain::ChainTopics,
    record::{Messages, Said, mcap::MessageRecorder},
    run::run,
};

use crate::course;

const LAYOUT: &str = include_str!("../docs/guide/foxglove-layout.json");
const PROTO: &str = include_str!("../crates/uchain-sim/src/mission/uchain.proto");

/// A flight of four UAVs that has all there is to look at.
fn recorded() -> Messages {
    let circuit = course("circuit", &["duration_s=90"]);
    let mut recorder = MessageRecorder::<_, ChainTopics>::start_in(Messages::default(), &circuit, 1).unwrap();
    run(&circuit, 1, &mut recorder).unwrap();
    recorder.into_sink()
}

/// The name of a topic's messages.
fn message_of(messages: &Messages, topic: &str) -> Option<String> {
    messages.said().iter().find_map(|said| match said {
        Said::Channel { topic: named, schema } if named == topic => schema.clone().map(|(name, ..)| name),
        _ => None,
    })
}

/// Number and kind of a field in `uchain.proto`.
fn field(message: &str, name: &str) -> Option<(u32, &'static str)> {
    let (_, body) = PROTO.split_once(&format!("message {message} {{"))?;
    let (body, _) = body.split_once("\n}")?;
    body.lines().find_map(|line| {
        let (declared, rest) = line.split_once(" = ")?;
        let mut words = declared.split_whitespace().rev();
        (words.next() == Some(name)).then_some(())?;
        Some((rest.split(';').next()?.parse().ok()?, words.next()?))
    })
}

/// How many values of a field a message holds.
fn values(mut data: &[u8], number: u32, kind: &str) -> usize {
    let mut count = 0;
    while !data.is_empty() {
        let (tag, wire) = decode_key(&mut data).unwrap();
        if (tag, wire) == (number, WireType::LengthDelimited) {
            let length = decode_varint(&mut data).unwrap() as usize;
            let (list, rest) = data.split_at(length);
            data = rest;
            count +=
                if kind == "float" { length / 4 } else { list.iter().filter(|byte| **byte < 128).count() };
        } else {
            count += usize::from(tag == number);
            skip_field(wire, tag, &mut data, DecodeContext::default()).unwrap();
        }
    }
    count
}

/// What is wrong with a message path: `/frame.link_true_db[0]`.
fn lacks(messages: &Messages, path: &str) -> Option<String> {
    let (topic, rest) = path.split_once('.')?;
    let Some(message) = message_of(messages, topic) else { return Some(format!("no topic {topic}")) };
    let (name, index) = match rest.trim_end_matches(']').split_once('[') {
        Some((name, index)) => (name, index.parse::<usize>().unwrap()),
        None => (rest, 0),
    };
    let Some((number, kind)) = message.strip_prefix("uchain.").and_then(|message| field(message, name))
    else {
        return Some(format!("no {name} in {message}"));
    };
    let most = messages.on(topic).map(|(_, data)| values(data, number, kind)).max().unwrap_or(0);
    (most <= index).then(|| format!("at most {most} values in {topic}.{name}"))
}

/// All strings at a key, wherever it is.
fn all<'v>(value: &'v Value, key: &str, found: &mut Vec<&'v Value>) {
    match value {
        Value::Object(map) => {
            found.extend(map.get(key));
            map.values().for_each(|value| all(value, key, found));
        }
        Value::Array(list) => list.iter().for_each(|value| all(value, key, found)),
        _ => {}
    }
}

#[test]
fn every_topic_and_message_path_of_the_layout_is_in_a_recording() {
    let (layout, messages) = (serde_json::from_str::<Value>(LAYOUT).unwrap(), recorded());
    let of = |key: &str| {
        let mut found = Vec::new();
        all(&layout["configById"], key, &mut found);
        found
    };
    let shown = of("topics").into_iter().flat_map(|topics| topics.as_object().unwrap().keys());
    let logs = of("topicToRender").into_iter().map(|topic| topic.as_str().unwrap());
    let topics: BTreeSet<&str> = shown.map(String::as_str).chain(logs).collect();
    assert!(topics.contains("/links") && topics.contains("/log"), "{topics:?}");
    for topic in topics {
        assert!(messages.on(topic).next().is_some(), "{topic}: no message");
    }
    let paths: Vec<&str> = of("value").into_iter().map(|path| path.as_str().unwrap()).collect();
    assert!(paths.len() > 20, "{paths:?}");
    for path in paths {
        assert_eq!(lacks(&messages, path), None, "{path}");
    }
    // The control: what no recording holds is found wanting.
    for (path, why) in [
        ("/frames.link_true_db[0]", "no topic /frames"),
        ("/frame.link_lost_db[0]", "no link_lost_db in uchain.Frame"),
        ("/frame.overridden[4]", "at most 4 values in /frame.overridden"),
    ] {
        assert_eq!(lacks(&messages, path).as_deref(), Some(why));
    }
}

#[test]
fn every_panel_of_the_layout_has_a_place() {
    let layout: Value = serde_json::from_str(LAYOUT).unwrap();
    let mut placed = BTreeSet::new();
    for end in ["first", "second"] {
        let mut found = Vec::new();
        all(&layout["layout"], end, &mut found);
        placed.extend(found.into_iter().filter_map(Value::as_str));
    }
    let panels: BTreeSet<&str> =
        layout["configById"].as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(placed, panels);
}
