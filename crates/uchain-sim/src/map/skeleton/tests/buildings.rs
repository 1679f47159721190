//! Real buildings and grids that nobody drew for this.

use std::path::PathBuf;

use super::*;
use crate::map::{Unknown, read_moving_ai, read_ros};

/// A file of the real inputs; says so where they are absent, and fails there if the environment is a check's.
fn real(name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/maps").join(name);
    if path.exists() {
        return Some(path);
    }
    assert!(std::env::var_os("CI").is_none(), "{} is absent", path.display());
    eprintln!("SKIPPED: {} is absent; the tunnel graph of a real building is not checked", path.display());
    None
}

/// Dead ends, junctions and ways round within bounds, and ways of the tree at least so deep (m).
fn checked(map: &Map, dead_ends: [usize; 2], junctions: [usize; 2], deepest_m: [f64; 2]) {
    let graph = map.tunnel_graph().unwrap();
    check(map, &graph);
    let numbers = map.numbers(&graph, 0.06);
    assert!((dead_ends[0]..=dead_ends[1]).contains(&numbers.dead_ends), "{numbers:?}");
    assert!((junctions[0]..=junctions[1]).contains(&numbers.junctions), "{numbers:?}");
    let widest = graph.nodes.iter().max_by(|p, q| p.width_m.total_cmp(&q.width_m)).unwrap();
    let tree = graph.tree(map, widest.at);
    let deepest = tree.depth_m.iter().copied().fold(0.0, f64::max);
    assert!((deepest_m[0]..=deepest_m[1]).contains(&deepest), "{deepest}");
}

#[test]
fn a_maze_of_one_cell_corridors_has_an_end_for_every_cell_with_one_neighbour() {
    let Some(path) = real("movingai/maze-128-128-1.map") else { return };
    let map = read_moving_ai(&path, 1.0).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let rows: Vec<&[u8]> = text.lines().skip(4).map(str::as_bytes).collect();
    let free = |x: usize, y: usize| rows.get(y).and_then(|row| row.get(x)) == Some(&b'.');
    let (mut ends, mut junctions) = (0, 0);
    for (x, y) in (0..128).flat_map(|y| (0..128).map(move |x| (x, y))).filter(|&(x, y)| free(x, y)) {
        let around = [(x + 1, y), (x.wrapping_sub(1), y), (x, y + 1), (x, y.wrapping_sub(1))];
        match around.into_iter().filter(|&(x, y)| free(x, y)).count() {
            1 => ends += 1,
            3.. => junctions += 1,
            _ => {}
        }
    }
    assert!(ends > 700 && junctions > 600, "{ends} {junctions}");
    let graph = map.tunnel_graph().unwrap();
    check(&map, &graph);
    assert_eq!(kinds(&graph), [ends, junctions, 0, 0]);
    assert_eq!(map.numbers(&graph, 0.06).loops, 0, "a perfect maze has no way round");
}

#[test]
fn grids_of_rooms_and_streets_have_sound_graphs() {
    let Some(rooms) = real("movingai/room-32-32-4.map") else { return };
    checked(&read_moving_ai(&rooms, 1.0).unwrap(), [16, 16], [48, 56], [38.0, 48.0]);
    let Some(berlin) = real("movingai/Berlin_1_256.map") else { return };
    checked(&read_moving_ai(&berlin, 0.5).unwrap(), [70, 100], [110, 180], [130.0, 180.0]);
    let Some(large) = real("movingai/orz900d.map") else { return };
    checked(&read_moving_ai(&large, 1.0).unwrap(), [250, 310], [230, 350], [2_700.0, 3_000.0]);
}

#[test]
fn a_surveyed_office_with_thousands_of_little_steps_has_a_sound_graph() {
    let Some(willow) = real("ros/willow/willow-full-0.05.pgm") else { return };
    let map = read_ros(&willow, Unknown::Rock, Some(0.05), 0.05).unwrap();
    checked(&map, [700, 1_100], [1_400, 2_000], [50.0, 80.0]);
    let Some(stata) = real("ros/f1tenth/stata_basement.yaml") else { return };
    checked(&read_ros(&stata, Unknown::Rock, None, 0.05).unwrap(), [120, 230], [80, 200], [60.0, 110.0]);
}
