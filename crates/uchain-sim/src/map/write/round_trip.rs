//! What is written as SVG or GeoJSON is read again as the same map, every wall within a millimetre.

use std::path::Path;

use proptest::prelude::*;

use super::{write_geojson, write_svg};
use crate::map::{
    GeojsonConfig, Map, MapError, Place, SvgConfig, Unknown,
    drawing::{Drawing, Shape, Solid, Wall},
    geojson_in_memory, read_moving_ai, read_ros, svg_in_memory,
};

/// How far a wall may be from where it was (m).
const WITHIN_M: f32 = 1e-3;

/// Of walls shorter than this the material may be lost: no piece of rock behind them is deep enough to be read again (m).
const SHORTEST_M: f32 = 0.01;

type Again = fn(&Map) -> Result<Map, MapError>;

const FORMATS: [(&str, Again); 2] = [
    ("SVG", |map| svg_in_memory("a.svg".as_ref(), write_svg(map).as_bytes(), &SvgConfig::default())),
    ("GeoJSON", |map| {
        geojson_in_memory("a.geojson".as_ref(), write_geojson(map).as_bytes(), &GeojsonConfig::default())
    }),
];

/// The corner or middle of a wall of one map that is farthest from all walls of the other (m).
fn farthest_m(of: &Map, from: &Map) -> f32 {
    let places = of.walls().iter().flat_map(|wall| [wall.a, wall.a.midpoint(wall.b)]);
    places.map(|at| from.clearance_m(from.to_local(of.to_file(at)))).fold(0.0, f32::max)
}

fn holds(map: &Map, format: &str, again: &Map) {
    let (there, back) = (farthest_m(map, again), farthest_m(again, map));
    assert!(there <= WITHIN_M && back <= WITHIN_M, "{format}: {there} m, {back} m");
    let (low, high) = map.bounds();
    for step in 0..400_u16 {
        // A lattice that is no multiple of anything drawn.
        let share = glam::Vec2::new(f32::from(step % 20) + 0.377, f32::from(step / 20) + 0.613) / 20.0;
        let at = low + share * (high - low);
        if map.clearance_m(at) > 0.01 {
            assert_eq!(again.in_rock(again.to_local(map.to_file(at))), map.in_rock(at), "{format}: {at}");
        }
    }
    assert_eq!(again.places().len(), map.places().len(), "{format}");
    for (place, was) in again.places().iter().zip(map.places()) {
        assert_eq!((&place.name, place.height_m), (&was.name, was.height_m), "{format}");
        let off_m = glam::DVec2::from(place.at_m).distance(was.at_m.into());
        assert!(off_m <= f64::from(WITHIN_M), "{format}: {} is {off_m} m off", place.name);
    }
    for (index, wall) in map.walls().iter().enumerate() {
        let Some(material) = map.material_of_wall(index) else { continue };
        if wall.a.distance(wall.b) < SHORTEST_M {
            continue;
        }
        let at = again.to_local(map.to_file(wall.a.midpoint(wall.b)));
        let nearest = again
            .walls()
            .iter()
            .enumerate()
            .min_by(|(_, a), (_, b)| a.distance_m(at).total_cmp(&b.distance_m(at)));
        let read = nearest.and_then(|(index, _)| again.material_of_wall(index));
        assert_eq!(read, Some(material), "{format}: wall {index}");
    }
}

fn square(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
    vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_drawn_map_keeps_walls_materials_and_places(
        radii in prop::collection::vec(15.0..25.0_f64, 5..40),
        pillars in prop::collection::btree_set((-3..3_i32, -3..3_i32), 0..6),
        lined in any::<bool>(), hollow in any::<bool>(),
        far in prop::sample::select(vec![[0.0, 0.0], [-3.25, 7.5], [2_600_000.125, 1_200_000.5]]),
    ) {
        let mut drawing = Drawing::default();
        let turn = |index: usize| std::f64::consts::TAU * index as f64 / radii.len() as f64;
        let corner = |index: usize, more: f64| {
            let radius = radii[index] + more;
            [far[0] + radius * libm::cos(turn(index)), far[1] + radius * libm::sin(turn(index))]
        };
        let outline: Vec<[f64; 2]> = (0..radii.len()).map(|index| corner(index, 0.0)).collect();
        drawing.free.push(Shape { outline: outline.clone(), holes: Vec::new() });
        let brick = drawing.material("Brick 3", Some(7.25));
        if lined {
            drawing.walls.push(Wall { line: outline, closed: true, thickness_m: 0.3, material: Some(brick) });
        }
        let rock = drawing.material("concrete & \"<steel>", None);
        for &(x, y) in &pillars {
            let (x, y) = (far[0] + 3.0 * f64::from(x), far[1] + 3.0 * f64::from(y));
            let holes = if hollow { vec![square(x + 0.5, y + 0.5, 0.75)] } else { Vec::new() };
            let shape = Shape { outline: square(x, y, 2.0), holes };
            drawing.solids.push(Solid { shape, material: (x > far[0]).then_some(rock) });
        }
        drawing.places = vec![
            Place { name: "Base & <camp>".into(), at_m: [far[0] + 0.5, far[1] - 1.25], height_m: None },
            Place { name: "Schacht 2".into(), at_m: [far[0], far[1]], height_m: Some(-20.5) },
        ];
        let map = drawing.into_map().unwrap();
        for (format, read) in FORMATS {
            let again = read(&map).unwrap_or_else(|error| panic!("{format}: {error}"));
            holds(&map, format, &again);
        }
    }
}

#[test]
fn a_cleft_two_millimetres_wide_is_kept_though_its_walls_have_a_material() {
    let mut radii = [15.0; 12];
    (radii[0], radii[1], radii[11]) =
        (15.708_431_960_311_941, 21.754_811_224_143_303, 15.661_256_779_570_637);
    let outline = radii.iter().enumerate().map(|(index, radius)| {
        let turn = std::f64::consts::TAU * index as f64 / 12.0;
        [radius * libm::cos(turn), radius * libm::sin(turn)]
    });
    let outline: Vec<[f64; 2]> = outline.collect();
    let mut drawing = Drawing::default();
    drawing.free.push(Shape { outline: outline.clone(), holes: Vec::new() });
    let brick = drawing.material("brick", None);
    drawing.walls.push(Wall { line: outline, closed: true, thickness_m: 0.3, material: Some(brick) });
    let map = drawing.into_map().unwrap();
    for (format, read) in FORMATS {
        holds(&map, format, &read(&map).unwrap());
    }
}

#[test]
fn where_a_map_lies_on_earth_and_how_it_was_read_is_kept() {
    let text = r#"{"type": "Polygon", "coordinates": [[[8, 47], [8.001, 47], [8.001, 47.001], [8, 47]]]}"#;
    let config = GeojsonConfig { outside: crate::map::Outside::Free, ..GeojsonConfig::default() };
    let map = geojson_in_memory("a.geojson".as_ref(), text.as_bytes(), &config).unwrap();
    let about_deg = map.import().about_deg.unwrap();
    assert!((about_deg[0] - 8.0005).abs() < 1e-9 && (about_deg[1] - 47.0005).abs() < 1e-9, "{about_deg:?}");
    for (format, read) in FORMATS {
        assert_eq!(read(&map).unwrap().import().about_deg, Some(about_deg), "{format}");
    }
    assert!(write_svg(&map).contains("frame: degrees as metres about longitude 8.000500"));
    assert!(write_geojson(&map).contains("frame: degrees as metres about longitude 8.000500"));
}

#[test]
fn a_wall_that_has_moved_by_a_centimetre_is_noticed() {
    let room = |x: f64| Drawing {
        free: vec![Shape { outline: square(x, 0.0, 4.0), holes: Vec::new() }],
        ..Drawing::default()
    };
    let (one, other) = (room(0.0).into_map().unwrap(), room(0.01).into_map().unwrap());
    let away_m = farthest_m(&one, &other);
    assert!((away_m - 0.01).abs() < 1e-4, "{away_m}");
}

#[test]
fn real_maps_keep_their_walls() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/maps");
    if !data.is_dir() {
        assert!(
            std::env::var("CI").as_deref() != Ok("true"),
            "{} is missing: the gate needs it",
            data.display()
        );
        eprintln!("skipped: {} is not there", data.display());
        return;
    }
    let grid = |name: &str| read_moving_ai(&data.join("movingai").join(name), 0.5).unwrap();
    let stata = data.join("ros/f1tenth/stata_basement.yaml");
    let maps = [
        ("den312d", grid("den312d.map")),
        ("maze-32-32-2", grid("maze-32-32-2.map")),
        ("room-64-64-8", grid("room-64-64-8.map")),
        ("random-32-32-20", grid("random-32-32-20.map")),
        ("stata_basement", read_ros(&stata, Unknown::Rock, None, 0.06).unwrap()),
    ];
    for (name, map) in maps {
        for (format, read) in FORMATS {
            let again = read(&map).unwrap_or_else(|error| panic!("{name} as {format}: {error}"));
            let (there, back) = (farthest_m(&map, &again), farthest_m(&again, &map));
            println!(
                "{name} as {format}: {} walls, {} again, {there} m and {back} m apart",
                map.walls().len(),
                again.walls().len()
            );
            assert!(there <= WITHIN_M && back <= WITHIN_M, "{name} as {format}: {there} m, {back} m");
        }
    }
}
