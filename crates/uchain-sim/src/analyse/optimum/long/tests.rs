//! Long tunnels against the table and its exact answers, where both can be had; and kilometres, by hand.

use std::cell::Cell;

use glam::{DVec2, Vec2};

use super::*;
use crate::{
    analyse::optimum::{AtHead, BottleneckTable},
    map::{Map, Tunnel, Vertex, corridor},
    radio::{Antenna, PathLoss, RadioModel, RadioParams},
    seed::{Seed, Source},
};

/// A corridor through rock and the radio of Eq. 22 in it.
struct Corridor {
    map: Map,
    tunnel: Tunnel,
    radio: PathLoss,
    /// Whether the radio tells what a link loses at least.
    tells: bool,
    asked: Cell<usize>,
}

impl Corridor {
    fn new(corners: &[DVec2], width_m: f64, alpha_wall: f32) -> Option<Self> {
        let vertex = |p: &DVec2| Vertex { x: p.x, y: p.y, bend_radius_m: 0.0 };
        let (map, line) = corridor(&corners.iter().map(vertex).collect::<Vec<_>>(), width_m, false).ok()?;
        let (base, heading_rad) = line.at(0.3);
        let radio = PathLoss::new(RadioParams { alpha_wall, ..RadioParams::default() }, &map).ok()?;
        Some(Self {
            map,
            tunnel: Tunnel::new(line, base, heading_rad),
            radio,
            tells: true,
            asked: Cell::new(0),
        })
    }

    fn length_m(&self) -> f64 {
        self.tunnel.length_m()
    }
}

impl Losses for &Corridor {
    type Place = Vec2;

    fn place(&self, depth_m: f64) -> Vec2 {
        self.tunnel.at(depth_m).0
    }

    fn db(&self, shallow: &Vec2, deep: &Vec2) -> f64 {
        self.asked.set(self.asked.get() + 1);
        self.radio.loss_db(&self.map, &Antenna::from(*shallow), &Antenna::from(*deep)).into()
    }

    fn least_db(&self, shallow: &Vec2, deep: &Vec2) -> f64 {
        self.least_at_db(shallow.distance(*deep).into())
    }

    fn least_at_db(&self, apart_m: f64) -> f64 {
        if self.tells { self.radio.least_loss_db(apart_m as f32).into() } else { f64::NEG_INFINITY }
    }

    fn spot(&self, place: &Vec2) -> Vec2 {
        *place
    }
}

/// Winding corridors of 40 to 90 m: sharp corners, legs of 2 to 9 m, through rock that dampens much or little, so that links
/// leap across where the tunnel turns back.
fn winding(count: usize) -> Vec<Corridor> {
    let mut random = Seed(3).stream(0, Source::Start);
    let mut between = |low: f64, high: f64| low + (high - low) * f64::from(random.uniform());
    let mut found = Vec::new();
    while found.len() < count {
        let (mut at, mut heading_rad) = (DVec2::ZERO, 0.0);
        let mut corners = vec![at];
        for _ in 0..12 {
            at += DVec2::new(libm::cos(heading_rad), libm::sin(heading_rad)) * between(2.0, 9.0);
            heading_rad += between(-2.4, 2.4);
            corners.push(at);
        }
        // Most lines cross themselves.
        let alpha_wall = if found.len() % 2 == 0 { 6.0 } else { 2.5 };
        found.extend(Corridor::new(&corners, 1.0, alpha_wall).filter(|corridor| corridor.length_m() > 40.0));
    }
    found
}

#[test]
fn a_long_tunnels_chains_are_those_of_the_exact_search_on_tunnels_that_both_can_take() {
    let (mut compared, mut greedy_is_worse) = (0, 0);
    for corridor in winding(6) {
        let losses = &corridor;
        let length_m = losses.length_m();
        let table = BottleneckTable::draw(&losses, length_m, 0.1, 200);
        let long = Long::new(length_m, 24.0);
        for i in 1..=12 {
            let head_m = length_m * f64::from(i) / 12.0;
            let exact = AtHead::new(losses, &table, head_m);
            let needed = exact.links_needed(60.0);
            assert_eq!(long.links_needed(&losses, head_m, 60.0), needed, "{head_m} of {length_m}");
            let Some(needed) = needed else { continue };
            for links in [needed, needed + 2] {
                let found = long.optimum(&losses, head_m, links, 60.0);
                let best_db = exact.optimum(links).bottleneck_db;
                assert!(found.bottleneck_db < best_db + 0.05, "{head_m} of {length_m}: {found:?} {best_db}");
                let greedy = level::farthest(&losses, head_m, links, best_db + 0.05);
                greedy_is_worse += usize::from(greedy.is_none());
                // It is a chain, and its losses are true.
                assert!(found.depths_m.is_sorted_by(|a, b| a >= b), "{found:?}");
                assert_eq!((found.depths_m[0], found.depths_m[links]), (head_m, 0.0));
                for (i, &link_db) in found.link_loss_db.iter().enumerate() {
                    let [deep, shallow] = [i, i + 1].map(|i| losses.place(found.depths_m[i]));
                    assert_eq!(link_db, losses.db(&shallow, &deep));
                }
                compared += 1;
            }
        }
    }
    // Links as long as can be, one after the other, are not as good everywhere: the tunnels are hard enough.
    assert!(compared > 100 && greedy_is_worse > 0, "{compared} {greedy_is_worse}");
}

#[test]
fn ten_kilometres_of_straight_tunnel_take_the_links_they_take_by_hand() {
    let corridor = Corridor::new(&[DVec2::ZERO, DVec2::new(10_000.0, 0.0)], 2.0, 6.0).unwrap();
    let losses = &corridor;
    let long = Long::new(losses.length_m(), 24.0);
    // 60 dB reach 0.25 · 10^1.25 m.
    let reach_m = 0.25 * libm::pow(10.0, 1.25);
    for head_m in [4.0, 4.5, 100.0, 1_234.5, 9_996.0] {
        let needed = long.links_needed(&losses, head_m, 60.0).unwrap();
        // Ten kilometres from the origin, places are a millimetre apart: 2,249 links may take one more.
        let more = needed as f64 - (head_m / reach_m).ceil();
        assert!(more == 0.0 || (head_m > 9_000.0 && more == 1.0), "{head_m}: {needed}");
        let found = long.optimum(&losses, head_m, needed, 60.0);
        let equal_db = 35.0 + 20.0 * libm::log10(head_m / needed as f64 / 0.25);
        assert!(
            (-0.002..0.011).contains(&(found.bottleneck_db - equal_db)),
            "{head_m}: {found:?} {equal_db}"
        );
    }
    assert!(corridor.asked.get() < 400_000, "{}", corridor.asked.get());
}

#[test]
fn a_radio_that_does_not_tell_how_far_it_reaches_is_asked_and_the_answer_is_the_same() {
    let corners = [DVec2::ZERO, DVec2::new(300.0, 0.0), DVec2::new(300.0, 200.0)];
    let mut corridor = Corridor::new(&corners, 2.0, 6.0).unwrap();
    let needed = |losses: &Corridor| {
        let long = Long::new(losses.length_m(), 24.0);
        [20.0, 303.0, 480.0].map(|head_m| long.links_needed(&losses, head_m, 60.0))
    };
    let told = needed(&corridor);
    corridor.tells = false;
    assert_eq!(needed(&corridor), told);
    assert!(told.iter().all(Option::is_some), "{told:?}");
}

#[test]
fn what_cannot_be_had_is_none_and_ends() {
    let corridor = Corridor::new(&[DVec2::ZERO, DVec2::new(500.0, 0.0)], 2.0, 6.0).unwrap();
    let losses = &corridor;
    let long = Long::new(losses.length_m(), 24.0);
    // No link is better than that over the reference distance.
    assert_eq!(long.links_needed(&losses, 400.0, 34.9), None);
    assert_eq!(long.links_needed(&losses, 0.0, 60.0), Some(1));
    // One link is one link, however bad; more relays than help wait at the base.
    let one = long.optimum(&losses, 400.0, 1, 60.0);
    assert_eq!(one.depths_m, [400.0, 0.0]);
    let many = long.optimum(&losses, 9.0, 400, 60.0);
    assert!(many.depths_m.len() == 401 && many.bottleneck_db < 36.0, "{}", many.bottleneck_db);
}
