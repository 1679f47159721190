use std::f32::consts::PI;

use glam::{Vec2, vec2};

use super::Tunnel;
use crate::map::{CentreLine, Map, MapError, Vertex, corridor};

fn built(corners: &[(f64, f64, f64)], width_m: f64, closed: bool) -> (Map, CentreLine) {
    let corners: Vec<Vertex> =
        corners.iter().map(|&(x, y, bend_radius_m)| Vertex { x, y, bend_radius_m }).collect();
    corridor(&corners, width_m, closed).unwrap()
}

/// Largest distance of a line's points from another line (m), between two of its abscissae.
fn apart_m(line: &CentreLine, other: &CentreLine, from_m: f32, to_m: f32) -> f32 {
    (0..=400)
        .map(|i| line.at(from_m + (to_m - from_m) * i as f32 / 400.0).0)
        .map(|p| p.distance(other.at(other.project(p)).0))
        .fold(0.0, f32::max)
}

#[test]
fn depth_grows_toward_the_heading_whichever_way_the_line_runs() {
    let (_, line) = built(&[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)], 1.0, false);
    let ahead = Tunnel::new(line.clone(), vec2(3.0, 0.2), 0.3);
    assert_eq!(
        (ahead.length_m(), ahead.depth_m(vec2(5.0, -0.1)), ahead.depth_m(vec2(1.0, 0.0))),
        (7.0, 2.0, -2.0)
    );
    assert_eq!(ahead.at(4.0), (vec2(7.0, 0.0), 0.0));
    let back = Tunnel::new(line, vec2(3.0, 0.0), 3.0).until(2.5);
    assert_eq!((back.length_m(), back.depth_m(vec2(1.0, 0.0))), (2.5, 2.0));
    assert_eq!(back.at(2.0), (vec2(1.0, 0.0), PI));
}

#[test]
fn a_ring_is_gone_round_once_from_the_base() {
    let square = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 0.0), (0.0, 10.0, 0.0)];
    let (_, line) = built(&square, 1.0, true);
    let clockwise = Tunnel::new(line, vec2(2.0, 0.0), PI);
    assert_eq!(clockwise.length_m(), 40.0);
    assert!((clockwise.depth_m(vec2(0.0, 3.0)) - 5.0).abs() < 1e-6);
    assert!((clockwise.depth_m(vec2(3.0, 0.0)) - 39.0).abs() < 1e-6);
}

#[test]
fn a_centre_path_runs_along_the_centre_line_of_a_corridor() {
    for (width_m, radius_m) in [(0.6, 0.0), (1.0, 0.0), (2.6, 0.0), (1.2, 2.0)] {
        let corners = [(0.0, 0.0, 0.0), (9.0, 0.0, radius_m), (9.0, 8.0, 0.0)];
        let (map, line) = built(&corners, width_m, false);
        let path = map.centre_path(line.at(1.5).0, line.at(line.length_m() - 1.5).0).unwrap();
        let half_m = width_m as f32 / 2.0;
        assert!(apart_m(&path, &line, 0.0, 5.0) < 0.03, "{width_m}: {}", apart_m(&path, &line, 0.0, 5.0));
        assert!(apart_m(&path, &line, 0.0, path.length_m()) < half_m);
        let length_m = line.length_m() - 3.0;
        assert!((path.length_m() - length_m).abs() < 0.6 * width_m as f32, "{} {length_m}", path.length_m());
        for i in 0..1000 {
            let p = path.at(path.length_m() * i as f32 / 1000.0).0;
            assert!(!map.in_rock(p) && map.clearance_m(p) > 0.7 * half_m, "{p}: {}", map.clearance_m(p));
        }
    }
}

#[test]
fn a_centre_path_needs_two_places_in_one_tunnel() {
    let (map, _) = built(&[(0.0, 0.0, 0.0), (9.0, 0.0, 0.0)], 1.0, false);
    let rock = map.centre_path(vec2(1.0, 0.0), vec2(1.0, 2.0));
    assert_eq!(rock.unwrap_err(), MapError::InRock { x: 1.0, y: 2.0 });
    let one_place = map.centre_path(Vec2::ONE * 0.1, Vec2::ONE * 0.1).unwrap_err();
    assert_eq!(
        one_place.to_string(),
        "the two ends of the way are one place (0 m apart); expected at least 0.001 m between them"
    );
    let room = |x0: f32| vec![vec2(x0, 0.0), vec2(x0 + 1.0, 0.0), vec2(x0 + 1.0, 1.0), vec2(x0, 1.0)];
    let rooms = Map::from_loops(vec![room(0.0), room(2.0)]).unwrap();
    let none = rooms.centre_path(vec2(0.5, 0.5), vec2(2.5, 0.5)).unwrap_err();
    assert!(none.to_string().starts_with("no way leads from (0.5, 0.5) to (2.5, 0.5) m"), "{none}");
}

#[test]
fn a_short_tunnel_is_the_centre_path_to_the_last_bit() {
    let (map, line) = built(&[(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (9.0, 8.0, 0.0)], 1.0, false);
    let (from, to) = (line.at(1.5).0, line.at(15.0).0);
    assert_eq!(map.tunnel_between(from, to, 0.06).unwrap(), map.centre_path(from, to).unwrap());
}

#[test]
fn a_tunnel_too_long_or_too_narrow_for_cells_is_found_all_the_same() {
    // Three legs, 6 km in all; cells that fit into its box would be as wide as it is.
    let corners = [(0.0, 0.0, 0.0), (2_000.0, 0.0, 0.0), (2_000.0, 2_000.0, 0.0), (0.0, 2_000.0, 0.0)];
    let (map, line) = built(&corners, 0.3, false);
    let (from, to) = (line.at(1.0).0, line.at(5_999.0).0);
    assert!(matches!(map.centre_path(from, to), Err(MapError::NoWay { .. })));
    let tunnel = map.tunnel_between(from, to, 0.06).unwrap();
    assert!((tunnel.length_m() - 5_998.0).abs() < 1.0, "{}", tunnel.length_m());
    assert!(apart_m(&tunnel, &line, 0.0, tunnel.length_m()) < 0.2);
    let narrow = map.tunnel_between(from, to, 0.5).unwrap_err().to_string();
    assert!(
        narrow.starts_with("the way there is only 0.")
            && narrow.ends_with("expected at least 1.00 m, what a UAV takes"),
        "{narrow}"
    );
    assert_eq!(
        map.tunnel_between(from, vec2(1.0, 5.0), 0.06).unwrap_err(),
        MapError::InRock { x: 1.0, y: 5.0 }
    );
}
