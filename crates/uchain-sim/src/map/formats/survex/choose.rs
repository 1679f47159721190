//! Which passages come into the map: all, or those on the way between two stations and beside it.

use std::{cmp::Reverse, collections::BinaryHeap};

use super::{
    cave::Cave,
    levels::{Cover, covers},
};

/// What comes into the map, and what became of the rest.
#[derive(Debug, Default)]
pub(super) struct Choice {
    /// Passages, those of the way first.
    pub(super) passages: Vec<usize>,
    /// Nodes on the way, in order; empty without a way.
    pub(super) way: Vec<usize>,
    /// Passages that were left out because another one that came first lies above or below.
    pub(super) separated: Vec<usize>,
    /// Pairs that cross at one height.
    pub(super) merged: usize,
    /// Farther from the way than asked for.
    pub(super) beyond: usize,
}

/// Why no map comes of a choice.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum NoChoice {
    /// No passages join the two stations.
    NoWay,
    /// The way crosses itself at another height; these are the ends of the way's first and second passage there, and the node before it.
    CrossesItself { first: [usize; 2], second: [usize; 2], gap_m: f64, before: usize },
    /// Too much of it.
    TooMuch(String),
}

/// All passages, from this node on outward. Of two that cross at heights more than `level_gap_m` apart, the one farther off is left out.
pub(super) fn all(cave: &Cave, from: usize, level_gap_m: f64) -> Result<Choice, NoChoice> {
    let every: Vec<usize> = (0..cave.passages.len()).collect();
    let mut walk = Walk::new(cave, &every, level_gap_m)?;
    walk.outward([from], f64::INFINITY);
    for node in 0..cave.nodes.len() {
        walk.outward([node], f64::INFINITY);
    }
    Ok(walk.choice)
}

/// The shortest way from one node to another, and what lies beside it up to `branch_m` along the survey.
pub(super) fn way(
    cave: &Cave,
    from: usize,
    to: usize,
    branch_m: f64,
    level_gap_m: f64,
) -> Result<Choice, NoChoice> {
    let passages = shortest(cave, from, to).ok_or(NoChoice::NoWay)?;
    let mut way = vec![from];
    for &passage in &passages {
        way.push(cave.passages[passage].other(*way.last().unwrap_or(&from)));
    }
    // Only what is near is looked at: a cave may be large.
    let mut near = within(cave, &way, branch_m);
    near.extend(&passages);
    near.sort_unstable();
    near.dedup();
    let mut walk = Walk::new(cave, &near, level_gap_m)?;
    for (at, &passage) in passages.iter().enumerate() {
        if let Some(Cover { other, gap_m }) = walk.keep(passage) {
            let [first, second] = [other, passage].map(|passage| cave.passages[passage].ends);
            return Err(NoChoice::CrossesItself { first, second, gap_m, before: way[at] });
        }
    }
    walk.outward(way.iter().copied(), branch_m);
    let mut choice = walk.choice;
    choice.way = way;
    choice.beyond = cave.passages.len() - choice.passages.len() - choice.separated.len();
    Ok(choice)
}

/// Nodes by how far they are: the nearest first, the lower number among equals.
type Queue = BinaryHeap<Reverse<(u64, usize)>>;

/// Of numbers that are not negative, the bits sort as the numbers do.
fn key(far_m: f64) -> u64 {
    far_m.to_bits()
}

fn shortest(cave: &Cave, from: usize, to: usize) -> Option<Vec<usize>> {
    let mut by: Vec<Option<usize>> = vec![None; cave.nodes.len()];
    let mut far_m = vec![f64::INFINITY; cave.nodes.len()];
    far_m[from] = 0.0;
    let mut queue: Queue = [Reverse((key(0.0), from))].into();
    while let Some(Reverse((bits, node))) = queue.pop() {
        if node == to {
            break;
        }
        if bits != key(far_m[node]) {
            continue;
        }
        for &passage in &cave.nodes[node].passages {
            let (next, next_m) =
                (cave.passages[passage].other(node), far_m[node] + cave.passages[passage].length_m);
            if next_m < far_m[next] {
                far_m[next] = next_m;
                by[next] = Some(passage);
                queue.push(Reverse((key(next_m), next)));
            }
        }
    }
    let mut way = Vec::new();
    let mut node = to;
    while node != from {
        let passage = by[node]?;
        way.push(passage);
        node = cave.passages[passage].other(node);
    }
    way.reverse();
    Some(way)
}

/// All passages that end within a way of the nodes.
fn within(cave: &Cave, nodes: &[usize], farthest_m: f64) -> Vec<usize> {
    let mut far_m = vec![f64::INFINITY; cave.nodes.len()];
    let mut queue = Queue::new();
    for &node in nodes {
        far_m[node] = 0.0;
        queue.push(Reverse((key(0.0), node)));
    }
    let mut found = vec![false; cave.passages.len()];
    while let Some(Reverse((bits, node))) = queue.pop() {
        if bits != key(far_m[node]) {
            continue;
        }
        for &passage in &cave.nodes[node].passages {
            let (next, next_m) =
                (cave.passages[passage].other(node), far_m[node] + cave.passages[passage].length_m);
            if next_m > farthest_m {
                continue;
            }
            found[passage] = true;
            if next_m < far_m[next] {
                far_m[next] = next_m;
                queue.push(Reverse((key(next_m), next)));
            }
        }
    }
    (0..found.len()).filter(|&passage| found[passage]).collect()
}

/// Takes passages one by one, the nearest first.
struct Walk<'a> {
    cave: &'a Cave,
    covers: Vec<Vec<Cover>>,
    level_gap_m: f64,
    chosen: Vec<bool>,
    kept: Vec<bool>,
    refused: Vec<bool>,
    seen: Vec<bool>,
    choice: Choice,
}

impl<'a> Walk<'a> {
    fn new(cave: &'a Cave, chosen: &[usize], level_gap_m: f64) -> Result<Self, NoChoice> {
        let covers = covers(cave, chosen).map_err(NoChoice::TooMuch)?;
        let none = vec![false; cave.passages.len()];
        let (kept, refused, seen) = (none.clone(), none.clone(), vec![false; cave.nodes.len()]);
        let mut is_chosen = none;
        for &passage in chosen {
            is_chosen[passage] = true;
        }
        Ok(Self {
            cave,
            covers,
            level_gap_m,
            chosen: is_chosen,
            kept,
            refused,
            seen,
            choice: Choice::default(),
        })
    }

    /// Keeps a passage, unless one that was kept before lies above or below it.
    fn keep(&mut self, passage: usize) -> Option<Cover> {
        let covered = self.covers[passage].iter().filter(|cover| self.kept[cover.other]);
        let (mut merged, mut worst) = (0, None::<Cover>);
        for cover in covered {
            merged += 1;
            if cover.gap_m > self.level_gap_m && worst.is_none_or(|worst| worst.gap_m < cover.gap_m) {
                worst = Some(*cover);
            }
        }
        if worst.is_some() {
            self.refused[passage] = true;
            self.choice.separated.push(passage);
        } else {
            self.kept[passage] = true;
            self.choice.passages.push(passage);
            self.choice.merged += merged;
        }
        worst
    }

    /// Keeps what can be reached, nearest first.
    fn outward(&mut self, from: impl IntoIterator<Item = usize>, farthest_m: f64) {
        let mut far_m = std::collections::BTreeMap::new();
        let mut queue = Queue::new();
        for node in from {
            if !self.seen[node] {
                far_m.insert(node, 0.0);
                queue.push(Reverse((key(0.0), node)));
            }
        }
        while let Some(Reverse((_, node))) = queue.pop() {
            if std::mem::replace(&mut self.seen[node], true) {
                continue;
            }
            let so_far_m = far_m.get(&node).copied().unwrap_or_default();
            for &passage in &self.cave.nodes[node].passages {
                let next = self.cave.passages[passage].other(node);
                let next_m = so_far_m + self.cave.passages[passage].length_m;
                if !self.chosen[passage]
                    || self.refused[passage]
                    || next_m > farthest_m && !self.kept[passage]
                {
                    continue;
                }
                if !self.kept[passage] && self.keep(passage).is_some() {
                    continue;
                }
                if far_m.get(&next).is_none_or(|&known_m| next_m < known_m) {
                    far_m.insert(next, next_m);
                    queue.push(Reverse((key(next_m), next)));
                }
            }
        }
    }
}
