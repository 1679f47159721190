//! The rules as sentences, and files that mean harm.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::*;

fn feature(geometry: &Value, properties: &Value) -> Value {
    json!({"type": "Feature", "geometry": geometry, "properties": properties})
}

fn collection(features: &[Value]) -> Value {
    json!({"type": "FeatureCollection", "units": "m", "features": features})
}

fn drawn(file: &Value) -> Result<Drawing, String> {
    read(file.to_string().as_bytes(), &GeojsonConfig::default())
}

fn square(low: f64, high: f64) -> Value {
    json!([[low, low], [high, low], [high, high], [low, high], [low, low]])
}

fn polygon(rings: &[Value]) -> Value {
    json!({"type": "Polygon", "coordinates": rings})
}

fn line(places: &Value) -> Value {
    json!({"type": "LineString", "coordinates": places})
}

fn said(drawing: &Drawing, kind: RemarkKind, part: &str) -> usize {
    let of_it = drawing.import.remarks.iter().filter(|said| said.kind == kind && said.what.contains(part));
    of_it.map(|said| said.count).sum()
}

#[test]
fn polygons_are_rock_and_lines_are_walls_unless_their_kind_says_otherwise() {
    let area = polygon(&[square(0.0, 9.0), square(1.0, 2.0)]);
    let way = line(&json!([[0.0, 0.0], [10.0, 0.0], [10.0, 5.0]]));
    let counts = |geometry: &Value, kind: &Value| {
        let drawing =
            drawn(&collection(&[feature(geometry, &json!({"kind": kind, "thickness_m": 2.0}))])).unwrap();
        [drawing.solids.len(), drawing.free.len(), drawing.walls.len()]
    };
    assert_eq!(counts(&area, &Value::Null), [1, 0, 0]);
    assert_eq!(counts(&area, &json!("rock")), [1, 0, 0]);
    assert_eq!(counts(&area, &json!("free")), [0, 1, 0]);
    assert_eq!(counts(&area, &json!("wall")), [0, 0, 2], "its two rings");
    assert_eq!(counts(&way, &Value::Null), [0, 0, 1]);
    assert_eq!(counts(&way, &json!("room")), [0, 3, 0], "a passage: two pieces and the bend");
    let drawing = drawn(&collection(&[feature(&area, &json!({"kind": "free"}))])).unwrap();
    assert_eq!(drawing.free[0].holes.len(), 1);
    let wrong = drawn(&collection(&[feature(&area, &json!({"kind": "cheese"}))])).unwrap_err();
    assert_eq!(wrong, "feature 1: kind = \"cheese\": expected rock, free, wall, place or ignore");
    let many = json!({"type": "MultiPolygon", "coordinates": [[square(0.0, 1.0)], [square(2.0, 3.0)]]});
    let several = json!({"type": "GeometryCollection", "geometries": [many, way]});
    assert_eq!(counts(&several, &Value::Null), [2, 0, 1]);
    assert_eq!(
        drawn(&several).map(|drawing| drawing.solids.len()),
        Err(drawn(&several).unwrap_err()),
        "degrees"
    );
}

#[test]
fn properties_say_material_loss_and_thickness_and_points_are_places() {
    let way = line(&json!([[0.0, 0.0], [200.0, 0.0]]));
    let drawing = drawn(&collection(&[
        feature(&way, &json!({"material": "concrete", "loss_db": 12.5, "thickness_m": 0.3})),
        feature(&way, &json!({"layer": "Brick walls"})),
        feature(&way, &Value::Null),
        feature(&json!({"type": "Point", "coordinates": [3.0, 4.0, -20.5]}), &json!({"name": " Shaft 2 "})),
        feature(&json!({"type": "Point", "coordinates": [3.0, 4.0]}), &json!({"name": 7})),
        feature(&Value::Null, &json!({"name": "nowhere"})),
    ]))
    .unwrap();
    let thick: Vec<f64> = drawing.walls.iter().map(|wall| wall.thickness_m).collect();
    assert_eq!(thick, [0.3, 0.1, 0.1]);
    let materials: Vec<_> = drawing.materials.iter().map(|of| (of.name.as_str(), of.loss_db)).collect();
    assert_eq!(materials, [("concrete", Some(12.5)), ("brick", None)]);
    assert_eq!(drawing.places, [Place { name: "Shaft 2".into(), at_m: [3.0, 4.0], height_m: Some(-20.5) }]);
    for part in ["points without a name", "without a geometry", "no text"] {
        assert_eq!(said(&drawing, RemarkKind::Dropped, part), 1, "{:?}", drawing.import);
    }
    for (key, value) in [("loss_db", json!(-1)), ("thickness_m", json!("wide"))] {
        let wrong = drawn(&collection(&[feature(&way, &json!({key: value}))])).unwrap_err();
        assert!(
            wrong.starts_with(&format!("feature 1: {key} = {value}: expected a number from 0")),
            "{wrong}"
        );
    }
}

#[test]
fn degrees_become_metres_about_their_middle_and_can_be_had_back() {
    let way = line(&json!([[8.0, 47.0], [8.01, 47.004]]));
    let drawing = drawn(&way).unwrap();
    let [a, b] = drawing.walls[0].line[..] else { panic!("two ends") };
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    // By Vincenty's formula the two are 880.9948 m apart, and along the parallel through their middle 760.5316 m.
    assert!((libm::hypot(x, y) - 880.994_8).abs() < 1e-3 && (x - 760.531_6).abs() < 1e-3, "{x} {y}");
    assert_eq!(said(&drawing, RemarkKind::Guessed, "about longitude 8.005000, latitude 47.002000"), 1);
    let back = drawing.import.to_degrees(b).unwrap();
    assert!((back[0] - 8.01).abs() < 1e-12 && (back[1] - 47.004).abs() < 1e-12, "{back:?}");
}

#[test]
fn metres_are_what_the_key_or_the_file_says_or_what_no_degrees_can_be() {
    let way = line(&json!([[0.0, 0.0], [1.0, 1.0]]));
    let end = |file: &Value, config: &GeojsonConfig| {
        read(file.to_string().as_bytes(), config).unwrap().walls[0].line[1]
    };
    let metres = GeojsonConfig { metres: true, ..GeojsonConfig::default() };
    let degrees = GeojsonConfig::default();
    assert_eq!(end(&way, &metres), [1.0, 1.0]);
    assert_eq!(end(&collection(&[feature(&way, &Value::Null)]), &degrees), [1.0, 1.0], "units: m");
    let crs = |name: &str| json!({"type": "name", "properties": {"name": name}});
    let named =
        |name: &str| json!({"type": "Feature", "crs": crs(name), "geometry": way, "properties": null});
    assert_eq!(end(&named("urn:ogc:def:crs:EPSG::2056"), &degrees), [1.0, 1.0]);
    assert_ne!(end(&named("urn:ogc:def:crs:OGC:1.3:CRS84"), &degrees), [1.0, 1.0], "longitude and latitude");
    assert_ne!(end(&way, &degrees), [1.0, 1.0]);
    let far = line(&json!([[2_600_000.5, 1_200_000.25], [2_600_010.0, 1_200_000.0]]));
    assert_eq!(end(&far, &degrees), [2_600_010.0, 1_200_000.0], "beyond all degrees");
    let room = line(&json!([[0.0, 0.0], [40.0, 20.0]]));
    assert!(
        drawn(&room).unwrap_err().contains("40.0 × 20.0 degrees large; expected a map of 2 at most"),
        "a room in metres"
    );
}

#[test]
#[expect(clippy::disallowed_methods, reason = "how long it takes is what is asked")]
fn what_means_harm_is_refused_in_words_and_in_time() {
    let line = |inner: &str| format!("{{\"type\":\"LineString\",\"coordinates\":{inner}}}");
    let deep = "{\"type\":\"GeometryCollection\",\"geometries\":[".repeat(1_000_000);
    let cases: [(&str, String, &str); 13] = [
        ("a million brackets", line(&"[".repeat(1_000_000)), "no GeoJSON: "),
        ("a million collections", deep, "values; expected 2400000 at most"),
        (
            "a hundred collections",
            "{\"type\":\"GeometryCollection\",\"geometries\":[".repeat(120),
            "no GeoJSON: ",
        ),
        ("objects", line(&format!("[{}]", "{\"\":0},".repeat(400_000))), "objects; expected 120000 at most"),
        ("values", line(&format!("[{}]", "[0,0],".repeat(1_000_000))), "values; expected 2400000 at most"),
        ("far", line("[[0,0],[1e300,0]]"), "expected numbers within"),
        ("too far", line("[[0,0],[1e999,0]]"), "no GeoJSON: number out of range"),
        ("no number", line("[[0,0],[NaN,0]]"), "no GeoJSON: "),
        ("short", line("[[0,0],[1]]"), "a position of 1 numbers; expected x and y"),
        (
            "nothing",
            "{\"type\":\"FeatureCollection\",\"features\":[]}".into(),
            "no line and no polygon in it (0 points",
        ),
        ("no text", "\u{fffd}".into(), "no GeoJSON: "),
        ("other JSON", "{\"type\":\"Topology\"}".into(), "no GeoJSON: "),
        ("cut off", "{\"type\":\"Feature".into(), "no GeoJSON: EOF"),
    ];
    for (name, text, expected) in cases {
        let start = std::time::Instant::now();
        let mut refused = None;
        let memory =
            allocation_counter::measure(|| refused = Some(read(text.as_bytes(), &GeojsonConfig::default())));
        let why = refused.unwrap().unwrap_err();
        let took_s = start.elapsed().as_secs_f64();
        println!("{name}: {took_s:.3} s, {} MB: {why}", memory.bytes_max >> 20);
        assert!(memory.bytes_max < 128 << 20, "{name}: {} MB", memory.bytes_max >> 20);
        assert!(why.contains(expected), "{name}: {why}");
        assert!(took_s < 4.0, "{name}: {took_s} s");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_damaged_file_is_read_or_refused_in_words(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..6),
        bytes in prop::option::weighted(0.1, prop::collection::vec(any::<u8>(), 0..200)),
    ) {
        let area = feature(&polygon(&[square(0.0, 9.0), square(1.0, 2.0)]), &json!({"kind": "free", "loss_db": 3.5}));
        let several = json!({"type": "GeometryCollection", "geometries": [line(&json!([[0.0, 0.0], [1e-3, 5.0]]))]});
        let point = feature(&json!({"type": "MultiPoint", "coordinates": [[3.0, 4.0, 5.0]]}), &json!({"name": "a"}));
        let example = collection(&[area, feature(&several, &json!({"material": "brick"})), point]).to_string();
        let mut text = bytes.unwrap_or_else(|| example.into_bytes());
        for (at, byte, what) in cuts {
            if text.is_empty() { break }
            let at = at.index(text.len());
            match what {
                0 => text[at] = byte % 128,
                1 => { text.remove(at); }
                2 => text.insert(at, b"0123456789-.eE[]{}\",:"[usize::from(byte) % 21]),
                _ => { let piece = text[at..(at + usize::from(byte)).min(text.len())].to_vec(); text.splice(at..at, piece); }
            }
        }
        if let Ok(drawing) = read(&text, &GeojsonConfig::default()) {
            let ends = drawing.walls.iter().flat_map(|wall| &wall.line).flatten();
            prop_assert!(ends.into_iter().all(|m| m.is_finite()));
        }
    }
}
