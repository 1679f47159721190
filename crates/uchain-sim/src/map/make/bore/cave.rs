//! Chambers and the passages between them.

use glam::DVec2;

use super::{Bore, Drilled};
use crate::{
    map::make::{between, farthest, way_lengths_m},
    seed::Stream,
};

/// Least distance between two chambers (widths), and attempts to find room for one more.
const APART: f64 = 5.0;
const ATTEMPTS: usize = 60;
/// Share of the passages that are not needed to get everywhere, but are there.
const LOOPS: f64 = 0.4;
/// Pieces of a passage.
const PIECES: usize = 4;

pub(super) fn drill(size_m: [f64; 2], width_m: f64, stream: &mut Stream) -> Drilled {
    let sites = sites(size_m, width_m, stream);
    let chambers_m: Vec<f64> = sites.iter().map(|_| between(stream, 0.5, 1.4) * width_m).collect();
    let mut bores: Vec<Bore> = Vec::new();
    let mut edges = vec![Vec::new(); sites.len()];
    for (a, b) in passages(&sites, stream) {
        // Each winds by itself; in the middle it is narrowest.
        let (from, to) = (sites[a], sites[b]);
        let aside = (to - from).perp() * between(stream, -0.22, 0.22);
        let middle_m = between(stream, 0.5, 0.8) * width_m;
        let at = |share: f64| from.lerp(to, share) + aside * 4.0 * share * (1.0 - share);
        let half_m = |share: f64| {
            let end_m = if share < 0.5 { chambers_m[a] } else { chambers_m[b] };
            let off = (2.0 * share - 1.0) * (2.0 * share - 1.0);
            middle_m + (end_m.max(middle_m) - middle_m) * off * off
        };
        let mut length_m = 0.0;
        for piece in 0..PIECES {
            let shares = [piece, piece + 1].map(|end| end as f64 / PIECES as f64);
            let ends = shares.map(at);
            length_m += ends[0].distance(ends[1]);
            bores.push(Bore { ends, half_m: shares.map(half_m) });
        }
        edges[a].push((b, length_m));
        edges[b].push((a, length_m));
    }
    let base = (0..sites.len()).min_by(|&a, &b| sites[a].x.total_cmp(&sites[b].x)).unwrap_or(0);
    let (goal, way_m) = farthest(&way_lengths_m(base, &edges), |_| true);
    Drilled { bores, base: sites[base], goal: sites[goal], way_m }
}

/// Middles of chambers, far enough from each other and from the box.
fn sites([width, height]: [f64; 2], width_m: f64, stream: &mut Stream) -> Vec<DVec2> {
    let rim_m = 2.5 * width_m;
    let mut sites: Vec<DVec2> = Vec::new();
    let mut failed = 0;
    while failed < ATTEMPTS || sites.len() < 2 {
        let at = DVec2::new(between(stream, rim_m, width - rim_m), between(stream, rim_m, height - rim_m));
        // A box so small that two have no room is filled with two that are nearer.
        let least_m = if failed < 4 * ATTEMPTS { APART } else { 1.0 } * width_m;
        if sites.iter().all(|site| site.distance(at) >= least_m) {
            sites.push(at);
            failed = 0;
        } else {
            failed += 1;
        }
    }
    sites
}

/// Pairs of neighbours that get a passage: all that the shortest tree needs, and some of those between which no third one
/// lies (the relative neighbourhood graph). No two of them cross.
fn passages(sites: &[DVec2], stream: &mut Stream) -> Vec<(usize, usize)> {
    let apart = |a: usize, b: usize| sites[a].distance_squared(sites[b]);
    let mut near: Vec<(f64, usize, usize)> = Vec::new();
    for a in 0..sites.len() {
        for b in a + 1..sites.len() {
            let between = |c: usize| c != a && c != b && apart(a, c).max(apart(b, c)) < apart(a, b);
            if !(0..sites.len()).any(between) {
                near.push((apart(a, b), a, b));
            }
        }
    }
    near.sort_by(|p, q| p.0.total_cmp(&q.0).then((p.1, p.2).cmp(&(q.1, q.2))));
    // The shortest first: a passage between two that are connected already is one more than needed (Kruskal).
    let mut group: Vec<usize> = (0..sites.len()).collect();
    let mut kept = Vec::new();
    for (_, a, b) in near {
        let is_needed = group[a] != group[b];
        if is_needed {
            let (from, to) = (group[a], group[b]);
            group.iter_mut().filter(|of| **of == from).for_each(|of| *of = to);
        }
        if is_needed || f64::from(stream.uniform()) < LOOPS {
            kept.push((a, b));
        }
    }
    kept
}
