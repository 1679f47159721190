//! Layouts of a few tiles, and the worlds of the SubT challenge.

use std::{fmt::Write as _, path::PathBuf};

use glam::Vec2;
use proptest::prelude::*;

use super::{tiles::SIDES, *};

fn settings() -> SubtConfig {
    toml::from_str("file = \"mine.tsv\"").unwrap()
}

fn laid(layout: &str, graph: Option<&str>) -> Result<Map, MapError> {
    subt_in_memory("mine.tsv".as_ref(), layout, graph, &settings())
}

fn remarks(map: &Map) -> String {
    let mut said = String::new();
    for remark in &map.import().remarks {
        writeln!(said, "{remark}").unwrap();
    }
    said
}

/// Base, straight along x, a turn to the right, a ramp downward and a constrained tile two rows below; beside them a cross at
/// another level.
const MINE: &str = "base_station,0,0\ttunnel_tile_5,90,0\ttunnel_tile_2,270,0\ttunnel_tile_1,0,1\n\
                    \t\ttunnel_tile_6,0,-1,Phone@1 0 0 0 0 0;tunnel_tile_blocker@11 0 0 0 0 0\n\
                    \t\tConstrained Tunnel Tile Short Lights,0,-1\n\tsomething_else,0,0\n";

#[test]
fn tiles_that_open_onto_one_another_at_one_level_are_one_tunnel() {
    let map = laid(MINE, None).unwrap();
    let free = |x: f64, y: f64| !map.in_rock(map.to_local([x, y]));
    // The base is the origin; tiles lie 20 m apart, rows downward.
    assert!(free(0.0, 0.0) && free(20.0, 2.4) && !free(20.0, 2.6) && free(40.0, -30.0));
    assert!(free(40.9, -40.0) && !free(41.1, -40.0), "constrained");
    assert!(
        free(42.4, 2.4) && !free(49.0, 0.0) && !free(50.0, 0.0),
        "a turn does not open onto the cross beside it"
    );
    assert!(free(60.0, 0.0) && map.loops().count() == 2, "the cross stands alone");
    let names: Vec<_> =
        map.places().iter().map(|place| (place.name.as_str(), place.height_m.unwrap())).collect();
    let expected = [
        ("BaseStation", 0.0),
        ("tile_1", 0.0),
        ("tile_2", 0.0),
        ("tile_3", 5.0),
        ("tile_4", -2.5),
        ("tile_6", -5.0),
    ];
    assert_eq!(names, expected, "blockers are numbered, too");
    let said = remarks(&map);
    for part in [
        "read 6 tiles of 20 m, levels -1 to 1",
        "guessed 1 constrained tiles' width: 2 m",
        "dropped 1 tiles of a type that is not known: something_else",
        "dropped 1 things that stand in tiles",
        "dropped 1 climbs of ramps",
        "guessed 5 openings onto no tile's opening: closed",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn a_blocker_closes_what_would_be_open() {
    let row = |things: &str| format!("tunnel_tile_5,90,0{things}\ttunnel_tile_5,270,0\n");
    let free = |layout: &str, x: f64| {
        let map = laid(layout, None).unwrap();
        !map.in_rock(map.to_local([x, 0.0]))
    };
    assert!(free(&row(""), 10.0));
    assert!(!free(&row(",tunnel_tile_blocker@11 0 0 0 0 0"), 10.0));
    let near = row(",tunnel_tile_blocker@5 0 0 0 0 0");
    assert!(free(&near, 4.0) && !free(&near, 5.0) && !free(&near, 10.0) && free(&near, 11.0));
    assert!(free(&row(",tunnel_tile_blocker@-11 0 0 0 0 0"), 10.0), "the control: on the other side");
    // The lower end of a ramp is its right one where it is turned by 90 degrees, and its left one by 270.
    let ramp = |yaw_deg: i32, level: i32| {
        free(&format!("tunnel_tile_6,{yaw_deg},0\ttunnel_tile_5,90,{level}\n"), 10.0)
    };
    assert_eq!([ramp(90, 0), ramp(90, 1), ramp(270, 0), ramp(270, 1)], [true, false, false, true]);
}

#[test]
fn a_graph_names_tiles_and_has_to_be_of_the_same_layout() {
    let layout = "base_station,0,0\ttunnel_tile_5,90,0\ttunnel_tile_5,90,0\n";
    let graph = "/* made */\ngraph {\n  0 [label=\"0::base_station::BaseStation\"];\n  1 [label=\"1::tunnel_tile_5::drift\"];\n  \
                 2 [label=\"2::tunnel_tile_5::tile_2\"];\n  /* a */ 0 -- 1 [label=1];\n  1  -- 2 [label=3]; /* b */\n}\n";
    let map = laid(layout, Some(graph)).unwrap();
    assert_eq!(map.places()[1].name, "drift");
    let said = remarks(&map);
    assert!(said.contains("read 2 passages that the graph knows, too; all of its passages cost 4"), "{said}");
    let other = graph.replace("1::tunnel_tile_5", "1::tunnel_tile_1");
    let said = laid(layout, Some(&other)).unwrap_err().to_string();
    assert!(
        said.starts_with("mine.tsv: its graph is another layout's: tile 1 is \"tunnel_tile_5\" here"),
        "{said}"
    );
    let broken = graph.replace("1  -- 2", "1  -> 2");
    let said = laid(layout, Some(&broken)).unwrap_err().to_string();
    assert!(said.contains("its graph, line 7: \"1  -> 2 [label=3];\": expected a tile"), "{said}");
}

#[test]
fn what_is_wrong_is_said_with_its_cell() {
    let cases = [
        ("", "no tile that is known is in it"),
        ("nonsense,0,0", "no tile that is known is in it"),
        (
            "tunnel_tile_5",
            "row 1, column 1: \"tunnel_tile_5\": expected a tile: its type, its yaw in degrees and its level",
        ),
        (
            "\n\ttunnel_tile_5,45,0",
            "row 2, column 2: \"tunnel_tile_5,45,0\": expected a yaw in quarter turns, not 45 degrees",
        ),
        ("tunnel_tile_5,NaN,0", "a yaw in quarter turns"),
        ("tunnel_tile_5,90,0.5", "a whole level within ±1000, not 0.5"),
        ("tunnel_tile_5,90,1e9", "a whole level within ±1000"),
        ("tunnel_tile_5,90,inf", "a whole level within ±1000"),
        (&"\t".repeat(1_000_001), "more than 1000000 cells"),
        (&"tunnel_tile_5,0,0\t".repeat(20_001), "more than 20000 tiles"),
    ];
    for (layout, expected) in cases {
        let said = laid(layout, None).unwrap_err().to_string();
        assert!(said.starts_with("mine.tsv: ") && said.contains(expected), "expected {expected:?}: {said}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.dot");
    std::fs::write(&file, "graph {\n 1 [label=\"1::tunnel_tile_5::tile_1\"];\n}\n").unwrap();
    let said = read_subt(&file, None, &settings()).unwrap_err().to_string();
    assert!(
        said.contains("does not say where they lie; give the layout") && said.ends_with("mine.tsv"),
        "{said}"
    );
    assert_eq!(super::super::kind_of_map(&file), Some("subt"));
    assert!((FORMAT.sniff)(MINE.as_bytes()) && !(FORMAT.sniff)(b"a\tb\n1,2\t3\n"));
}

/// Every pair of a layout and its graph; `None` where this machine has none.
fn pairs() -> Option<Vec<PathBuf>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/subt");
    if !folder.is_dir() {
        assert!(std::env::var_os("CI").is_none_or(|ci| ci != "true"), "{} is absent", folder.display());
        eprintln!("skipped: {} is absent", folder.display());
        return None;
    }
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let mut layouts: Vec<PathBuf> =
        files.filter(|file| file.extension().is_some_and(|end| end == "tsv")).collect();
    layouts.sort();
    Some(layouts)
}

#[test]
fn neighbours_see_each_other_in_the_map_where_the_graph_joins_them_and_nowhere_else() {
    let Some(layouts) = pairs() else { return };
    let (mut joined, mut apart) = (0, 0);
    for file in &layouts {
        let map = read_subt(file, None, &settings()).unwrap();
        let said = remarks(&map);
        assert!(
            !said.contains("passages of the graph where") && !said.contains("that the graph does not know"),
            "{said}"
        );
        let tiles = tiles::layout(&std::fs::read_to_string(file).unwrap()).unwrap().tiles;
        let graph = dot::graph(&std::fs::read_to_string(file.with_extension("dot")).unwrap()).unwrap();
        assert_eq!(tiles.len(), graph.tiles.len(), "{}", file.display());
        let at: Vec<Vec2> = map.places().iter().map(|place| map.to_local(place.at_m)).collect();
        for (index, tile) in tiles.iter().enumerate() {
            for [right, up] in SIDES {
                let beside =
                    |other: &tiles::Tile| other.column == tile.column + right && other.row == tile.row - up;
                let Some(other) = tiles.iter().position(beside) else { continue };
                let pair = [tile.number.min(tiles[other].number), tile.number.max(tiles[other].number)];
                let joins = graph.costs.contains_key(&pair);
                assert_eq!(map.sees(at[index], at[other]), joins, "{}: {pair:?}", file.display());
                *(if joins { &mut joined } else { &mut apart }) += 1;
            }
        }
    }
    assert_eq!((layouts.len(), joined), (4, 2 * (31 + 315 + 283 + 271)));
    assert!(apart > 200, "{apart}");
}

proptest! {
    #[test]
    fn noise_is_refused_in_words_or_read(
        cells in "(tunnel_tile_[1-7],(0|90|-90|45),-?[0-2](,tunnel_tile_blocker@[0-9 .-]{0,9})?[\t\n]){0,30}",
        noise in prop::collection::vec(any::<u8>(), 0..60), graph in "[0-9 \\[\\]=\"a-z:;/*\n-]{0,80}",
    ) {
        let text = String::from_utf8_lossy(&noise);
        let _ = laid(&text, Some(&graph));
        let _ = laid(&cells, None);
        let _ = laid(&format!("{cells}{text}"), Some(&graph));
    }
}
