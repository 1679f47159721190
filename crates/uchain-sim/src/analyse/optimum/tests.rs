//! The optimum against exhaustive search, closed forms, jumps and a tunnel that turns back on itself.

use glam::DVec2;
use uchain_core::bounded;

use super::*;
use crate::{
    map::{Map, Tunnel, Vertex, corridor},
    radio::{Antenna, PathLoss, RadioModel, RadioParams, Shadowing},
    seed::{Seed, Source, Stream},
};

/// Eq. 22 in the open, without the clamp below d0.
fn straight(a_m: f64, b_m: f64) -> f64 {
    35.0 + 20.0 * libm::log10(1.0 + (b_m - a_m).abs() / 0.25)
}

fn table(loss_db: impl Fn(f64, f64) -> f64, depth_m: f64) -> BottleneckTable {
    BottleneckTable::new(loss_db, depth_m, 0.05, 16)
}

/// A corridor through rock and a radio in it.
struct Case {
    map: Map,
    tunnel: Tunnel,
    path_loss: PathLoss,
}

impl Case {
    fn draw(random: &mut Stream) -> Self {
        loop {
            let mut between = |low: f64, high: f64| low + (high - low) * f64::from(random.uniform());
            let (legs, width_m) = (between(1.0, 5.99) as usize, between(0.5, 1.5));
            let (mut at, mut heading_rad) = (DVec2::ZERO, between(-3.0, 3.0));
            let vertex = |p: DVec2, bend_radius_m| Vertex { x: p.x, y: p.y, bend_radius_m };
            let mut corners = vec![vertex(at, 0.0)];
            for _ in 0..legs {
                at += DVec2::new(libm::cos(heading_rad), libm::sin(heading_rad)) * between(1.0, 5.0);
                heading_rad += between(-2.4, 2.4);
                corners.push(vertex(at, if between(0.0, 1.0) < 0.3 { width_m } else { 0.0 }));
            }
            let shadowing =
                if between(0.0, 1.0) < 0.3 { Shadowing::WallCount } else { Shadowing::MeanExponent };
            let alpha_wall = between(2.5, 6.0) as f32;
            // Nearly half of the lines cross themselves or have a leg too short for its corners.
            let Ok((map, line)) = corridor(&corners, width_m, false) else { continue };
            let (base, heading_rad) = line.at(0.3);
            let params = RadioParams { shadowing, alpha_wall, ..RadioParams::default() };
            let path_loss = PathLoss::new(params, &map).unwrap();
            return Self { map, tunnel: Tunnel::new(line, base, heading_rad), path_loss };
        }
    }

    fn loss_db(&self, a_m: f64, b_m: f64) -> f64 {
        let [a, b] = [a_m, b_m].map(|depth_m| Antenna::from(self.tunnel.at(depth_m).0));
        self.path_loss.loss_db(&self.map, &a, &b).into()
    }
}

/// Tries every place of the next relays, from sample `at` on.
fn deeper(pairs: &[Vec<f64>], to_head: &[f64], at: usize, worst_db: f64, relays: usize, best: &mut f64) {
    if worst_db >= *best {
        return;
    }
    if relays == 0 {
        *best = worst_db.max(to_head[at]).min(*best);
        return;
    }
    for next in at..to_head.len() {
        deeper(pairs, to_head, next, worst_db.max(pairs[next][at]), relays - 1, best);
    }
}

/// The best worst link over all ordered places of the relays on these depths, each pair tried (but for those that
/// already lose to one found before).
fn exhaustive(loss_db: &impl Fn(f64, f64) -> f64, grid_m: &[f64], head_m: f64, links: usize) -> f64 {
    let from_base: Vec<f64> = grid_m.iter().map(|&x| loss_db(0.0, x)).collect();
    let to_head: Vec<f64> = grid_m.iter().map(|&x| loss_db(x, head_m)).collect();
    let pairs: Vec<Vec<f64>> = match links {
        2 => Vec::new(),
        _ => grid_m
            .iter()
            .map(|&b| grid_m.iter().map(|&a| if a <= b { loss_db(a, b) } else { f64::NAN }).collect())
            .collect(),
    };
    let mut best = f64::INFINITY;
    for (first, &first_db) in from_base.iter().enumerate() {
        deeper(&pairs, &to_head, first, first_db, links - 2, &mut best);
    }
    best
}

#[test]
fn no_placement_on_a_finer_grid_beats_the_optimum_on_1000_random_maps() {
    let mut random = Seed(1).stream(0, Source::Start);
    let mut beaten = Vec::new();
    let mut greedy_is_worse = 0;
    for number in 0..1000 {
        let case = Case::draw(&mut random);
        let loss_db = |a, b| case.loss_db(a, b);
        let head_m = case.tunnel.length_m() - 0.3;
        let links = 2 + number % 3;
        let table = table(loss_db, head_m);
        let found = optimum(&loss_db, &table, head_m, links);

        // It is a chain, and its losses are true.
        assert!(found.depths_m.is_sorted_by(|a, b| a >= b), "{found:?}");
        assert_eq!((found.depths_m[0], found.depths_m[links]), (head_m, 0.0));
        for (i, link_db) in found.link_loss_db.iter().enumerate() {
            assert_eq!(*link_db, loss_db(found.depths_m[i + 1], found.depths_m[i]));
            assert!(*link_db <= found.bottleneck_db);
        }
        // A grid that shares no point with the table's samples.
        let step_m = if links == 2 { 0.01 } else { 0.04 };
        let grid_m: Vec<f64> =
            (0..4000).map(|i| (f64::from(i) + 0.37) * step_m).take_while(|&x| x < head_m).collect();
        let best_db = exhaustive(&loss_db, &grid_m, head_m, links);
        // Loss changes by up to 100 dB/m round a corner: 0.01 dB by the places' resolution.
        if found.bottleneck_db > best_db + 0.01 {
            beaten.push((number, found.bottleneck_db - best_db));
        }
        let greedy = equal_links(&loss_db, head_m, links);
        greedy_is_worse += usize::from(greedy.is_none_or(|g| g.bottleneck_db > found.bottleneck_db + 0.01));
    }
    assert!(beaten.is_empty(), "{beaten:?}");
    assert!(greedy_is_worse > 20, "the maps are too easy: bisection alone fails on {greedy_is_worse}");
}

#[test]
fn in_a_straight_tunnel_relays_stand_equally_far_apart() {
    for (head_m, links) in [(9.7, 3), (10.0, 4), (0.9, 2), (31.4, 7)] {
        let found = optimum(&straight, &table(straight, head_m), head_m, links);
        for (i, (depth_m, link_db)) in found.depths_m.iter().zip(&found.link_loss_db).enumerate() {
            let expected_m = head_m * (links - i) as f64 / links as f64;
            assert!((depth_m - expected_m).abs() < 1e-4, "{i}: {depth_m} {expected_m}");
            assert!((link_db - straight(0.0, head_m / links as f64)).abs() < 1e-4);
        }
    }
}

#[test]
fn where_loss_is_continuous_and_grows_all_links_are_equal() {
    // Eight times steeper between 3 and 3.5 m, as round a corner.
    let along = |x_m: f64| x_m + 7.0 * bounded(x_m - 3.0, 0.0, 0.5);
    let corner = |a_m: f64, b_m: f64| straight(along(a_m), along(b_m)) + 8.0 * (along(b_m) - along(a_m));
    for links in 2..=6 {
        let found = optimum(&corner, &table(corner, 8.0), 8.0, links);
        for link_db in &found.link_loss_db {
            assert!((link_db - found.bottleneck_db).abs() < 0.01, "{found:?}");
        }
        let greedy = equal_links(&corner, 8.0, links).unwrap();
        assert!((greedy.bottleneck_db - found.bottleneck_db).abs() < 1e-3);
    }
}

#[test]
fn where_loss_jumps_links_are_unequal_and_the_infimum_is_approached() {
    // No sight past 2 m: 30 dB for crossing it, so one relay belongs right there, on either side.
    let step = |a_m: f64, b_m: f64| straight(a_m, b_m) + if a_m < 2.0 && b_m > 2.0 { 30.0 } else { 0.0 };
    let found = optimum(&step, &table(step, 8.0), 8.0, 2);
    assert!((found.depths_m[1] - 2.0).abs() < RESOLUTION_M, "{found:?}");
    // From there to the head, or from the base to there: the infimum is the longer of the two.
    assert!((found.bottleneck_db - straight(2.0, 8.0)).abs() < 0.01, "{found:?}");
    assert!(found.link_loss_db[0] - found.link_loss_db[1] > 5.0, "{found:?}");
}

#[test]
fn in_a_u_the_best_chain_leaps_across_and_bisection_on_the_level_does_not_find_it() {
    // 6 m out, 1 m across, 12 m back, as if rock were air: the relay belongs beyond the turn.
    let at = |x: f64| DVec2::new(if x <= 6.0 { x } else { 13.0 - x.max(7.0) }, bounded(x - 6.0, 0.0, 1.0));
    let u = |a_m: f64, b_m: f64| straight(0.0, at(a_m).distance(at(b_m)));
    let found = optimum(&u, &table(u, 19.0), 19.0, 2);
    // 2.917 m past the base, 3.083 m from it and from the head.
    assert!((found.depths_m[1] - (13.0 + 35.0 / 12.0)).abs() < RESOLUTION_M, "{found:?}");
    assert!((found.bottleneck_db - straight(0.0, 37.0 / 12.0)).abs() < 0.01, "{found:?}");
    // Bisection takes the turn for out of reach, or lands beyond the good places: 58.8 dB against 57.5.
    let greedy = equal_links(&u, 19.0, 2).unwrap();
    assert!(greedy.bottleneck_db > found.bottleneck_db + 1.0, "{greedy:?}");
}

#[test]
fn a_thousand_relays_in_a_short_tunnel_do_no_harm() {
    // From 0.25 m on, Eq. 22 as it is: 35 dB and no less.
    let clamped = |a_m: f64, b_m: f64| 35.0 + 20.0 * libm::log10((b_m - a_m).max(0.25) / 0.25);
    let table = BottleneckTable::new(clamped, 3.0, 0.05, MOST_LINKS);
    let found = optimum(&clamped, &table, 3.0, 1000);
    assert_eq!((found.link_loss_db.len(), found.depths_m.len()), (1000, 1001));
    assert!(table.links_max() < 20 && found.bottleneck_db < 35.001, "{}", found.bottleneck_db);
}

#[test]
fn enough_links_are_no_more_than_needed() {
    let table = table(straight, 20.0);
    // 60 dB reach 0.25 · (10^1.25 − 1) m.
    let reach_m = 0.25 * (libm::pow(10.0, 1.25) - 1.0);
    for (head_m, needed) in
        [(0.0, 1), (reach_m - 1e-3, 1), (reach_m + 1e-3, 2), (2.0 * reach_m - 1e-3, 2), (12.0, 3)]
    {
        assert_eq!(links_needed(&straight, &table, head_m, 60.0), Some(needed), "{head_m}");
    }
    assert_eq!(links_needed(&straight, &table, 12.0, 34.0), None, "no link is as good");
    assert_eq!(
        links_needed(&|_, _| f64::NAN, &BottleneckTable::new(|_, _| f64::NAN, 3.0, 0.1, 8), 2.0, 60.0),
        None
    );
}

#[test]
fn a_chart_is_exhaustive_on_its_samples_and_bounded_for_any_tunnel() {
    let mut random = Seed(2).stream(0, Source::Start);
    let case = Case::draw(&mut random);
    let depth_m = case.tunnel.length_m();
    let table = BottleneckTable::new(|a, b| case.loss_db(a, b), depth_m, 0.25, 4);
    let samples: Vec<f64> = (0..table.bottleneck_db(1).len()).map(|i| i as f64 * table.step_m()).collect();
    let (Some(&head_m), Some(last)) = (samples.last(), samples.len().checked_sub(1)) else { panic!() };
    for links in 2..=4 {
        let best_db = exhaustive(&|a, b| case.loss_db(a, b), &samples, head_m, links);
        assert_eq!(table.bottleneck_db(links)[last], best_db);
    }
    let wide = BottleneckTable::new(straight, 1e6, 0.1, 3);
    assert_eq!(wide.bottleneck_db(3).len(), MOST_SAMPLES);
    for (depth_m, step_m) in
        [(0.0, 0.1), (-1.0, 0.1), (f64::NAN, 0.1), (1.0, 0.0), (1.0, f64::NAN), (1.0, -1.0)]
    {
        let odd = BottleneckTable::new(straight, depth_m, step_m, 3);
        assert!(optimum(&straight, &odd, 5.0, 3).bottleneck_db.is_finite(), "{depth_m} {step_m}");
    }
}
