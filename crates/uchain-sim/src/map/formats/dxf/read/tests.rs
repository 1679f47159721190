//! The rules as sentences, drawings that mean harm, and another reader.

use std::fmt::Write as _;

use proptest::prelude::*;

use super::*;

/// A drawing in metres: its entities, each as its kind and its pairs, `LINE 8 walls 10 0 20 0 …`.
fn dxf(entities: &[&str]) -> String {
    let mut text =
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n".to_owned();
    for entity in entities {
        text.push_str(&pairs(entity));
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

fn pairs(entity: &str) -> String {
    format!("0\n{}\n", entity.split(' ').collect::<Vec<_>>().join("\n"))
}

fn drawn(entities: &[&str]) -> Drawing {
    read(dxf(entities).as_bytes(), &DxfConfig::default()).unwrap_or_else(|why| panic!("{entities:?}: {why}"))
}

fn rounded(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    line.iter().map(|at| at.map(|m| (m * 1e6).round() / 1e6)).collect()
}

fn said(drawing: &Drawing, kind: RemarkKind, part: &str) -> usize {
    let of_it = drawing.import.remarks.iter().filter(|said| said.kind == kind && said.what.contains(part));
    of_it.map(|said| said.count).sum()
}

const LINE_OF_ONE: &str = "LINE 8 0 10 0 20 0 11 1 21 0";
const LINE: &str = "LINE 8 0 10 0 20 0 11 5 21 0";

#[test]
fn lines_that_meet_are_one_wall_and_their_layer_says_of_what() {
    let drawing = drawn(&[
        "LINE 8 Concrete 10 0 20 0 11 5 21 0",
        "LINE 8 Concrete 10 5 20 3 11 5 21 0",
        "LINE 8 Concrete 10 5 20 3 11 0 21 0",
        "LINE 8 0 10 9 20 9 11 8 21 8",
    ]);
    assert_eq!((drawing.walls.len(), drawing.walls[0].closed, drawing.walls[0].line.len()), (2, true, 3));
    assert_eq!((drawing.materials[0].name.as_str(), drawing.walls[1].material), ("concrete", None));
    assert_eq!(said(&drawing, RemarkKind::Merged, "end to end"), 2);
    assert!(drawing.walls.iter().all(|wall| wall.thickness_m == 0.1));
}

#[test]
fn what_is_closed_on_a_layer_called_free_or_rock_is_an_area() {
    let square = |layer: &str| format!("LWPOLYLINE 8 {layer} 70 1 10 0 20 0 10 4 20 0 10 4 20 4 10 0 20 4");
    let counts = |layer: &str| {
        let drawing = drawn(&[&square(layer)]);
        [drawing.free.len(), drawing.solids.len(), drawing.walls.len()]
    };
    assert_eq!((counts("Rooms"), counts("rock"), counts("0")), ([1, 0, 0], [0, 1, 0], [0, 0, 1]));
    assert_eq!(
        drawn(&["SOLID 8 0 10 0 20 0 11 4 21 0 12 0 22 4 13 4 23 4"]).solids[0].shape.outline[2],
        [4.0, 4.0]
    );
    let passage = drawn(&["LWPOLYLINE 8 passage 43 2 10 0 20 0 10 9 20 0"]);
    assert_eq!(passage.free[0].outline[0], [0.0, -1.0], "as wide as its polyline");
}

#[test]
fn arcs_bulges_circles_ellipses_and_splines_go_where_they_should() {
    let line = |entity: &str| rounded(&drawn(&[entity]).walls[0].line);
    let arc = line("ARC 8 0 10 1 20 0 40 2 50 0 51 90");
    assert_eq!((arc[0], arc[arc.len() - 1]), ([3.0, 0.0], [1.0, 2.0]));
    let over = line("ARC 8 0 10 0 20 0 40 2 50 270 51 90");
    assert!(over.iter().all(|at| at[0] >= 0.0), "past the zero: {over:?}");
    let below = line("ARC 8 0 10 1 20 0 40 2 50 0 51 90 230 -1");
    assert_eq!(below[0], [-3.0, 0.0], "seen from below");
    let bulge = line("LWPOLYLINE 8 0 70 1 10 0 20 0 42 1 10 2 20 0");
    assert!(bulge.iter().any(|at| at[1] < -0.98) && bulge.iter().all(|at| at[1] <= 0.0), "{bulge:?}");
    let circle = drawn(&["CIRCLE 8 0 10 0 20 0 40 3"]);
    assert!(circle.walls[0].closed && circle.walls[0].line.len() > 20);
    let ellipse = line("ELLIPSE 8 0 10 0 20 0 11 4 21 0 40 0.5 41 0 42 3.141592653589793");
    assert_eq!((ellipse[0], ellipse[ellipse.len() - 1]), ([4.0, 0.0], [-4.0, 0.0]));
    assert!(ellipse.iter().any(|at| (at[1] - 2.0).abs() < 0.02));
    let spline = "SPLINE 8 0 70 8 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 10 1 20 2 10 2 20 0";
    assert_eq!(line(spline)[8], [1.0, 1.0], "the parabola's top");
    let old = drawn(&[
        "POLYLINE 8 0 66 1 70 0",
        "VERTEX 8 0 10 0 20 0",
        "VERTEX 8 0 10 3 20 0",
        "SEQEND 8 0",
        "LINE 10 7 20 7 11 8 21 8",
    ]);
    assert_eq!(rounded(&old.walls[0].line), [[0.0, 0.0], [3.0, 0.0]]);
    assert_eq!(old.walls.len(), 2, "what follows its vertices is read as well");
}

#[test]
fn blocks_are_drawn_where_they_are_inserted() {
    let block = format!(
        "{}{}{}",
        pairs("BLOCK 2 door 10 1 20 0"),
        pairs("LINE 8 0 10 1 20 0 11 2 21 0"),
        pairs("ENDBLK 8 0")
    );
    let text = dxf(&["INSERT 8 Wood 2 door 10 5 20 5 41 2 42 2 50 90", "INSERT 8 0 2 none 10 0 20 0"]);
    let text = text.replacen(
        "0\nSECTION\n2\nENTITIES",
        &format!("0\nSECTION\n2\nBLOCKS\n{block}0\nENDSEC\n0\nSECTION\n2\nENTITIES"),
        1,
    );
    let drawing = read(text.as_bytes(), &DxfConfig::default()).unwrap();
    assert_eq!(rounded(&drawing.walls[0].line), [[5.0, 5.0], [5.0, 7.0]]);
    assert_eq!(
        drawing.materials[0].name, "wood",
        "what is on layer 0 of a block is on the layer of its insert"
    );
    assert_eq!(said(&drawing, RemarkKind::Dropped, "not in the file"), 1);
}

#[test]
fn the_unit_is_the_keys_the_files_or_guessed_by_the_size() {
    let end = |units: &str, size: &str, unit_m| {
        let text = dxf(&[LINE_OF_ONE, &format!("LINE 8 0 10 {size} 20 5 11 {size} 21 6")]);
        let text = text.replace("$INSUNITS\n70\n6", &format!("$INSUNITS\n70\n{units}"));
        let drawing = read(text.as_bytes(), &DxfConfig { unit_m, ..DxfConfig::default() }).unwrap();
        (rounded(&[drawing.walls[0].line[1]])[0][0], said(&drawing, RemarkKind::Guessed, "unit: "))
    };
    assert_eq!(end("4", "9", None), (0.001, 0));
    assert_eq!(end("2", "9", None), (0.3048, 0));
    assert_eq!(end("4", "9", Some(2.0)), (2.0, 0));
    assert_eq!(end("0", "900", None), (1.0, 1));
    assert_eq!(end("0", "20000", None), (0.001, 1));
}

#[test]
fn what_is_no_wall_is_dropped_and_counted_and_texts_name_places() {
    let layers = format!("{}{}", pairs("LAYER 2 dark 62 -7"), pairs("LAYER 2 frozen 70 1"));
    let text = dxf(&[
        LINE,
        "TEXT 8 0 10 1 20 1 1 hello",
        "TEXT 8 Places 10 2 20 3 1 Shaft",
        "HATCH 8 0",
        "HATCH 8 0",
        "LINE 8 dark 10 0 20 0 11 1 21 1",
        "LINE 8 frozen 10 0 20 0 11 1 21 1",
        "LINE 8 0 67 1 10 0 20 0 11 1 21 1",
        "LINE 8 Notes 10 0 20 0 11 1 21 1",
        "LINE 8 0 10 1 20 1 11 1 21 1",
    ]);
    let text = text.replacen(
        "0\nSECTION\n2\nENT",
        &format!("0\nSECTION\n2\nTABLES\n{layers}0\nENDSEC\n0\nSECTION\n2\nENT"),
        1,
    );
    let drawing = read(text.as_bytes(), &DxfConfig::default()).unwrap();
    assert_eq!(
        (drawing.walls.len(), drawing.places[0].name.as_str(), drawing.places[0].at_m),
        (1, "Shaft", [2.0, 3.0])
    );
    for (part, count) in [
        ("TEXT", 1),
        ("HATCH", 2),
        ("off or frozen", 2),
        ("paper space", 1),
        ("called notes", 1),
        ("extent", 1),
    ] {
        assert_eq!(said(&drawing, RemarkKind::Dropped, part), count, "{part}: {:?}", drawing.import);
    }
}

#[test]
#[expect(clippy::disallowed_methods, reason = "how long it takes is what is asked")]
fn what_means_harm_is_refused_in_words_and_in_time() {
    let many = dxf(&vec!["A"; 1_000_000]);
    let insert = |name: usize| pairs(&format!("INSERT 8 0 2 b{name} 10 0 20 0"));
    let blocks = |count: usize| -> String {
        let mut all = String::new();
        for i in 0..14 {
            all += &pairs(&format!("BLOCK 2 b{i}"));
            all += &insert(i + 1).repeat(count);
            all += &pairs("ENDBLK 8 0");
        }
        all
    };
    let with = |blocks: &str, last: &str| {
        dxf(&[last]).replacen(
            "0\nSECTION\n2\nENT",
            &format!("0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENT"),
            1,
        )
    };
    let bomb = with(&blocks(10), "INSERT 8 0 2 b0");
    let itself =
        with(&(pairs("BLOCK 2 a") + &pairs("INSERT 8 0 2 a") + &pairs("ENDBLK 8 0")), "INSERT 8 0 2 a");
    let array = with(
        &(pairs("BLOCK 2 a") + &pairs(LINE) + &pairs("ENDBLK 8 0")),
        "INSERT 8 0 2 a 70 9999999 71 9999999",
    );
    let mut corners = "LWPOLYLINE 8 0".to_owned();
    (0..1_050_000).for_each(|i| write!(corners, " 10 {} 20 {}", i % 7, i % 5).unwrap());
    let mut arcs = "LWPOLYLINE 8 0".to_owned();
    (0..100_000).for_each(|i| write!(arcs, " 10 {} 20 0 42 1", i % 2 * 90_000).unwrap());
    let cases: [(&str, String, &str); 14] = [
        ("a million entities", many, "more than 300000 entities"),
        ("a bomb of blocks", bomb, "more than 300000 entities, with all that is inserted"),
        ("a block in itself", itself, "blocks more than 16 deep"),
        ("an array", array, "more than 300000 entities, with all that is inserted"),
        ("corners", dxf(&[&corners]), "more than 1000000 corners"),
        ("arcs", dxf(&[&arcs]), "more than 1000000 corners"),
        (
            "far",
            dxf(&["LINE 8 0 10 0 20 0 11 1e300 21 0"]),
            "line 15: LINE: a corner at (1e300, 0e0) m; expected numbers within",
        ),
        ("no number", dxf(&["LINE 8 0 10 nan 20 0 11 1 21 0"]), "a corner at (NaN"),
        ("infinite", dxf(&["CIRCLE 8 0 10 0 20 0 40 inf"]), "a corner at ("),
        (
            "nothing",
            dxf(&["TEXT 8 0 10 0 20 0 1 a"]),
            "nothing in it is a wall, rock or free space (1 entities of the kind TEXT)",
        ),
        ("empty", dxf(&[]), "no section ENTITIES with anything in it"),
        ("no DXF", "hello\nworld\n".into(), "line 1: \"hello\": expected a whole number"),
        ("binary", "AutoCAD Binary DXF\r\n".into(), "save it as ASCII DXF"),
        ("cut off", "0\nSECTION\n2\nENTITIES\n0\nLINE\n10".into(), "nothing in it is a wall"),
    ];
    for (name, text, expected) in cases {
        let start = std::time::Instant::now();
        let mut refused = None;
        let memory =
            allocation_counter::measure(|| refused = Some(read(text.as_bytes(), &DxfConfig::default())));
        let why = refused.unwrap().unwrap_err();
        let took_s = start.elapsed().as_secs_f64();
        println!("{name}: {took_s:.3} s, {} MB: {why}", memory.bytes_max >> 20);
        assert!(memory.bytes_max < 128 << 20, "{name}: {} MB", memory.bytes_max >> 20);
        assert!(why.contains(expected), "{name}: {why}");
        assert!(took_s < 4.0, "{name}: {took_s} s");
    }
}

#[test]
fn another_reader_finds_the_same_lines() {
    use dxf::{Drawing as Other, LwPolylineVertex, Point, entities::*};
    let mut other = Other::new();
    let at = |x: f64, y: f64| Point::new(x, y, 0.0);
    other.header.version = dxf::enums::AcadVersion::R2010;
    other.header.default_drawing_units = dxf::enums::Units::Millimeters;
    other.add_entity(Entity::new(EntityType::Line(Line::new(at(1.5, 2.0), at(9000.25, -3.0)))));
    other.add_entity(Entity::new(EntityType::Circle(Circle::new(at(500.0, 0.0), 250.0))));
    let corner = |x: f64, y: f64| LwPolylineVertex { x, y, ..LwPolylineVertex::default() };
    let vertices = vec![corner(0.0, 50.0), corner(100.0, 50.125), corner(100.0, 70.0)];
    other.add_entity(Entity::new(EntityType::LwPolyline(LwPolyline { vertices, ..LwPolyline::default() })));
    let mut bytes = Vec::new();
    other.save(&mut bytes).unwrap();
    let drawing = read(&bytes, &DxfConfig::default()).unwrap();
    let lines: Vec<Vec<[f64; 2]>> = drawing.walls.iter().map(|wall| rounded(&wall.line)).collect();
    assert_eq!(lines[0], [[0.0015, 0.002], [9.00025, -0.003]]);
    assert!(
        drawing.walls[1].closed
            && lines[1].iter().all(|at| (libm::hypot(at[0] - 0.5, at[1]) - 0.25).abs() < 1e-5)
    );
    assert_eq!(lines[2], [[0.0, 0.05], [0.1, 0.050_125], [0.1, 0.07]]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_damaged_drawing_is_read_or_refused_in_words(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..6),
        bytes in prop::option::weighted(0.1, prop::collection::vec(any::<u8>(), 0..200)),
    ) {
        let example = dxf(&[
            LINE, "LWPOLYLINE 8 rooms 70 1 43 2 10 0 20 0 42 1 10 2 20 0", "ARC 8 0 10 1 20 0 40 2 50 0 51 90", "POLYLINE 8 0 70 1",
            "VERTEX 10 1 20 2 42 .5", "VERTEX 10 3 20 2", "SEQEND", "ELLIPSE 10 0 20 0 11 4 21 0 40 0.5 41 0 42 3",
            "SPLINE 70 8 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 2 41 1 10 0 20 0 10 1 20 2 10 2 20 0", "INSERT 2 a 10 0 20 0 50 30",
            "SOLID 10 0 20 0 11 4 21 0 12 0 22 4 13 4 23 4",
        ]);
        let block = pairs("BLOCK 2 a") + &pairs(LINE) + &pairs("ENDBLK");
        let example = example.replacen("0\nSECTION\n2\nENT", &format!("0\nSECTION\n2\nBLOCKS\n{block}0\nENDSEC\n0\nSECTION\n2\nENT"), 1);
        let mut text = bytes.unwrap_or_else(|| example.into_bytes());
        for (at, byte, what) in cuts {
            if text.is_empty() { break }
            let at = at.index(text.len());
            match what {
                0 => text[at] = byte % 128,
                1 => { text.remove(at); }
                2 => text.insert(at, b"0123456789-.eA\n"[usize::from(byte) % 15]),
                _ => { let piece = text[at..(at + usize::from(byte)).min(text.len())].to_vec(); text.splice(at..at, piece); }
            }
        }
        if let Ok(drawing) = read(&text, &DxfConfig::default()) {
            let ends = drawing.walls.iter().flat_map(|wall| &wall.line).flatten();
            prop_assert!(ends.into_iter().all(|m| m.is_finite()));
        }
    }
}
