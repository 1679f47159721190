use std::io::Cursor;

use serde_json::{Value, json};
use uchain_sim::{
    config::{Source, builtin},
    mission::{chain::Course, explore::Site},
    registry::Registry,
    replay::{Recording, verify},
    run::run,
};

use super::*;
use crate::Engine;

fn ask(engine: &mut Engine, what: &Value, files: &[u8]) -> Result<Value, Value> {
    let mut request = what.to_string().into_bytes();
    request.push(0);
    request.extend_from_slice(files);
    let mut answer: Value = serde_json::from_slice(&engine.call(&request)).unwrap();
    if answer["error"].is_null() { Ok(answer["ok"].take()) } else { Err(answer["error"].take()) }
}

fn text_of(name: &str, duration_s: f64) -> String {
    let text = builtin(name).unwrap().text;
    let line = text.lines().find(|line| line.starts_with("duration_s")).unwrap().to_owned();
    text.replace(&line, &format!("duration_s = {duration_s:?}"))
}

fn open(engine: &mut Engine, name: &str, duration_s: f64, seed: u64) -> Value {
    let flight = json!({"kind": "scenario", "label": name, "text": text_of(name, duration_s), "seed": seed});
    ask(engine, &json!({"do": "open", "flight": flight}), &[]).unwrap()
}

fn advance(engine: &mut Engine, ticks: u64) -> Value {
    ask(engine, &json!({"do": "advance", "ticks": ticks}), &[]).unwrap()
}

fn get(engine: &mut Engine, what: &str, tick: u64, uav: usize) -> Value {
    let what = if what == "why" {
        json!({"do": what, "tick": tick, "uav": uav})
    } else {
        json!({"do": what, "tick": tick})
    };
    loop {
        let got = ask(engine, &what, &[]).unwrap();
        if got["reached"] != json!(false) && got["exact"] != json!(false) {
            return got;
        }
    }
}

fn digest(engine: &mut Engine) -> String {
    let summary = ask(engine, &json!({"do": "summary"}), &[]).unwrap();
    summary["digest"].as_str().unwrap().to_owned()
}

fn read(text: String) -> Source {
    Source { label: "text".to_owned(), text, folder: std::path::PathBuf::new() }
}

#[test]
fn a_flight_on_a_page_has_the_digest_of_the_same_run_however_it_is_sliced() {
    for (name, seed) in [("corner", 1), ("corner", 2), ("lab", 1)] {
        let mut engine = Engine::default();
        open(&mut engine, name, 40.0, seed);
        let mut slice = 1;
        while advance(&mut engine, slice)["stopped"].is_null() {
            slice = slice % 37 + 5;
        }
        let source = read(text_of(name, 40.0));
        let expected = if name == "lab" {
            run(&Site::read(&source, &[]).unwrap(), seed, &mut ()).unwrap().digest
        } else {
            run(&Course::read(&source, &[]).unwrap(), seed, &mut ()).unwrap().digest
        };
        assert_eq!(digest(&mut engine), expected, "{name} {seed}");
        open(&mut engine, name, 39.95, seed);
        advance(&mut engine, 10_000);
        assert!(name == "lab" || digest(&mut engine) != expected, "one tick less is another flight");
    }
}

#[test]
fn a_flight_by_hand_is_flown_again_from_its_scenario_its_file_and_its_recording() {
    let mut engine = Engine::default();
    open(&mut engine, "corner", 30.0, 3);
    advance(&mut engine, 150);
    let steer = |engine: &mut Engine, speed_mps: f32, follow: &str| {
        ask(engine, &json!({"do": "steer", "speed_mps": speed_mps, "follow": follow}), &[])
    };
    steer(&mut engine, 0.1, "left").unwrap();
    advance(&mut engine, 100);
    steer(&mut engine, 0.1, "left").unwrap(); // nothing new
    advance(&mut engine, 20);
    steer(&mut engine, -0.05, "centre").unwrap();
    assert!(
        steer(&mut engine, 1.5, "left").unwrap_err()["message"]
            .as_str()
            .unwrap()
            .contains("must lie in -1..=1")
    );
    advance(&mut engine, 10_000);
    let flown = digest(&mut engine);
    let inputs = ask(&mut engine, &json!({"do": "inputs"}), &[]).unwrap();
    assert_eq!(inputs.as_array().unwrap().len(), 2, "{inputs}");

    let toml = ask(&mut engine, &json!({"do": "toml", "by_hand": true}), &[]).unwrap();
    let source = read(toml["text"].as_str().unwrap().to_owned());
    let course = Course::read(&source, &[]).unwrap();
    assert_eq!(run(&course, 3, &mut ()).unwrap().digest, flown);

    let flight = ask(&mut engine, &json!({"do": "flight"}), &[]).unwrap();
    let mut again = Engine::default();
    ask(&mut again, &json!({"do": "open", "flight": flight}), &[]).unwrap();
    advance(&mut again, 10_000);
    assert_eq!(digest(&mut again), flown);

    while ask(&mut engine, &json!({"do": "record", "ticks": 77}), &[]).unwrap()["done"] == json!(false) {}
    let file = engine.payload().to_vec();
    let verdict = verify(&mut Recording::<_, Course>::read(file.as_slice(), "memory").unwrap()).unwrap();
    assert!(verdict.agrees() && verdict.ticks == 600, "{verdict:?}");

    // A recording that is read on a page is that flight, and may be flown on from anywhere.
    let scene = ask(&mut again, &json!({"do": "recording", "label": "run.mcap"}), &file).unwrap();
    assert_eq!((&scene["recorded"], &scene["flies_again"]), (&json!(true), &json!(true)));
    let end = advance(&mut again, 10_000);
    assert_eq!((&end["tick"], &end["stopped"]["why"]), (&json!(600), &json!("recorded")));
    assert_eq!(digest(&mut again), flown);
    assert_eq!(get(&mut again, "why", 300, 1), get(&mut engine, "why", 300, 1));
    ask(&mut again, &json!({"do": "cut", "tick": 270}), &[]).unwrap();
    advance(&mut again, 270);
    advance(&mut again, 10_000);
    let cut = ask(&mut again, &json!({"do": "inputs"}), &[]).unwrap();
    assert_eq!(cut.as_array().unwrap().len(), 1, "what was asked for from tick 270 on is forgotten");
    assert_ne!(digest(&mut again), flown);
}

#[test]
fn what_a_thinned_film_does_not_hold_is_flown_again_as_it_was() {
    let whole = &mut Engine::default();
    open(whole, "corner", 60.0, 1);
    advance(whole, 10_000);
    let flight = json!({"kind": "scenario", "label": "corner", "text": text_of("corner", 60.0), "seed": 1});
    let file: FlightFile = serde_json::from_value(flight).unwrap();
    let course = Course::read(&read(text_of("corner", 60.0)), &[]).unwrap();
    let mut thinned = Flown::live(course, file, Vec::new()).unwrap();
    thinned.watched.film.most_bytes = 20_000;
    assert!(thinned.advance(10_000).unwrap().kept_every > 16);
    for tick in [1200, 1, 777, 778, 40, 1199] {
        let there = get(whole, "frame", tick, 0);
        let here: Value = loop {
            let here: Value = serde_json::from_str(&thinned.frame(tick).unwrap()).unwrap();
            assert!(here["tick"].as_u64().unwrap() <= tick);
            if here["exact"] == json!(true) {
                break here;
            }
        };
        assert_eq!(here, there, "tick {tick}");
        assert_eq!(thinned.why(tick, 1).unwrap()["words"], get(whole, "why", tick, 1)["words"]);
    }
}

#[test]
fn a_uav_says_why_in_words_that_fit_its_numbers() {
    let engine = &mut Engine::default();
    open(engine, "corner", 120.0, 1);
    advance(engine, 10_000);
    let first = |engine: &mut Engine, tick, uav| {
        get(engine, "why", tick, uav)["words"][0].as_str().unwrap().to_owned()
    };
    assert!(first(engine, 100, 3).starts_with("It waits on the ground"));
    assert!(first(engine, 10, 0).starts_with("It rises for 1 s"));
    assert!(first(engine, 200, 0).contains("what its pilot asks for: 0.20 m/s forward"));
    let relay = get(engine, "why", 2000, 1);
    let imbalance_db = relay["imbalance_db"].as_f64().unwrap();
    assert!(
        relay["words"][0].as_str().unwrap().contains(&format!("{:.1} dB worse", imbalance_db.abs())),
        "{relay}"
    );
    let refused = ask(engine, &json!({"do": "why", "tick": 5, "uav": 44}), &[]).unwrap_err();
    assert_eq!(refused["message"], "there is no UAV 44: expected 0 to 3");
}

#[test]
fn a_dropped_ros_map_is_explored_and_its_flight_is_complete_in_itself() {
    let yaml = b"image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    let mut picture = b"P5 60 60 255\n".to_vec();
    picture.extend(
        (0..3600).map(|i| if (5..55).contains(&(i % 60)) && (5..55).contains(&(i / 60)) { 255 } else { 0 }),
    );
    let engine = &mut Engine::default();
    let map = |files: Value, bytes: &[u8], engine: &mut Engine| {
        ask(engine, &json!({"do": "map", "files": files}), bytes)
    };
    let both =
        json!([{"name": "room.yaml", "bytes": yaml.len()}, {"name": "room.pgm", "bytes": picture.len()}]);
    let bytes = [&yaml[..], &picture].concat();
    let scene = map(both, &bytes, engine).unwrap();
    assert_eq!((&scene["mission"], &scene["name"]), (&json!("exploration"), &json!("room")));
    advance(engine, 20_000);
    let flight = ask(engine, &json!({"do": "flight"}), &[]).unwrap();
    let again = &mut Engine::default();
    ask(again, &json!({"do": "open", "flight": flight}), &[]).unwrap();
    advance(again, 20_000);
    assert_eq!(digest(again), digest(engine));
    let graph = ask(engine, &json!({"do": "graph"}), &[]).unwrap();
    assert!(graph["nodes"].as_array().unwrap().len() > 3);

    let alone = map(json!([{"name": "room.pgm", "bytes": picture.len()}]), &picture, engine).unwrap_err();
    assert!(alone["message"].as_str().unwrap().contains("drop the yaml file"), "{alone}");
    let alone = map(json!([{"name": "room.yaml", "bytes": yaml.len()}]), yaml, engine).unwrap_err();
    assert!(alone["message"].as_str().unwrap().contains("names the picture room.pgm"), "{alone}");
    let short = map(json!([{"name": "room.yaml", "bytes": 9999}]), yaml, engine).unwrap_err();
    assert!(short["message"].as_str().unwrap().contains("9999 bytes were announced"), "{short}");
}

#[test]
fn what_is_wrong_with_a_text_is_said_with_its_line_and_key() {
    let engine = &mut Engine::default();
    let text = text_of("corner", 30.0).replace("[chain]", "[chain]\nuavz = 3");
    let line = 1 + text.lines().position(|line| line == "uavz = 3").unwrap();
    let wrong = ask(engine, &json!({"do": "check", "text": text, "label": "mine.toml"}), &[]).unwrap_err();
    assert_eq!((&wrong["line"], &wrong["key"]), (&json!(line), &json!("chain.uavz")));
    assert!(wrong["message"].as_str().unwrap().starts_with(&format!("mine.toml:{line}: unknown key")));
    let stata = ask(engine, &json!({"do": "text", "name": "stata"}), &[]).unwrap();
    let flight = json!({"kind": "scenario", "label": "stata", "text": stata["text"], "seed": 1});
    let wrong = ask(engine, &json!({"do": "open", "flight": flight}), &[]).unwrap_err();
    assert!(wrong["hint"].as_str().unwrap().contains("drop the map's yaml file"), "{wrong}");
    let about = ask(engine, &json!({"do": "about"}), &[]).unwrap();
    let dry: Vec<&Value> = about["scenarios"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|known| known["flies"] == json!(false))
        .collect();
    assert_eq!(dry.iter().map(|known| &known["name"]).collect::<Vec<_>>(), ["stata"]);
    assert_eq!(
        ask(engine, &json!({"do": "explain", "key": "sigma_db"}), &[]).unwrap()["cards"][0]["unit"],
        "dB"
    );
}

#[test]
fn no_request_and_no_damaged_recording_is_the_end_of_the_engine() {
    let engine = &mut Engine::default();
    open(engine, "corner", 10.0, 1);
    advance(engine, 200);
    while ask(engine, &json!({"do": "record", "ticks": 1000}), &[]).unwrap()["done"] == json!(false) {}
    let file = engine.payload().to_vec();
    let mut damaged = 0;
    for at in (0..file.len()).step_by(file.len() / 60) {
        let mut flipped = file.clone();
        flipped[at] ^= 1 << (at % 8);
        for bytes in [&flipped[..], &file[..at]] {
            let opened = ask(engine, &json!({"do": "recording", "label": "run.mcap"}), bytes);
            let end = if opened.is_ok() {
                advance(engine, 10_000)["stopped"]["why"].take()
            } else {
                json!("refused")
            };
            damaged += usize::from(end != json!("recorded"));
        }
    }
    assert!(damaged > 60, "{damaged} of 122 were noticed");
    for request in [
        &b""[..],
        b"\0",
        b"{",
        b"[]",
        b"{\"do\":\"frame\",\"tick\":-1}",
        b"\xff\xfe",
        b"{\"do\":\"advance\"}",
    ] {
        let answer: Value = serde_json::from_slice(&engine.call(request)).unwrap();
        assert!(answer["error"]["message"].is_string(), "{answer}");
    }
    let flight = |inputs: Value| json!({"do": "open", "flight": {"kind": "scenario", "label": "c", "text": text_of("corner", 5.0), "inputs": inputs}});
    for inputs in [
        json!([{"tick": 5, "speed_mps": 9.0, "follow": "left"}]),
        json!([{"tick": 5, "speed_mps": 0.1}, {"tick": 5, "speed_mps": 0.2}]),
        json!([{"tick": 5, "speed_mps": 0.1, "follow": "up"}]),
        json!(vec![json!({"tick": 1, "speed_mps": 0.1}); INPUTS_MAX + 1]),
    ] {
        assert!(ask(engine, &flight(inputs.clone()), &[]).is_err(), "{inputs:.100}");
    }
    // And it flies as ever.
    open(engine, "corner", 10.0, 1);
    assert_eq!(advance(engine, 1000)["tick"], json!(200));
}

#[test]
fn a_recording_of_another_flight_is_shown_and_nobody_says_why() {
    let engine = &mut Engine::default();
    open(engine, "corner", 60.0, 1);
    advance(engine, 2000);
    while ask(engine, &json!({"do": "record", "ticks": 2000}), &[]).unwrap()["done"] == json!(false) {}
    let file = engine.payload().to_vec();
    let opened = Opened::read(Cursor::new(file), "run.mcap").unwrap();
    let mut other = FlightFile::new(&opened.source(), 2, None);
    other.seed = 2;
    let kind = Registry::default().describe(&opened.source(), &[]).unwrap().mission.kind();
    assert_eq!(kind, "a chain");
    // As if this program flew it otherwise: it flies another seed than was recorded.
    let mut flown = Flown::<Course>::recorded(opened, other).unwrap();
    flown.advance(2000).unwrap();
    let why = loop {
        match flown.why(900, 1) {
            Ok(told) if told["reached"] == json!(false) => {}
            other => break other,
        }
    };
    assert!(why.unwrap_err().to_string().contains("it is another flight by tick 900"));
}
