//! Maps made from a seed: tunnels, caves, mazes, rooms and mines to try things on. The same wish gives the same walls, bit
//! for bit.
//!
//! Two ways to make one: `bore` rounds passages out of rock around lines; `lattice` opens cells of a grid whose lines
//! are walls. In both, the free space is one piece and no passage is narrower than the wish says.

mod bore;
mod lattice;
#[cfg(test)]
mod tests;

use super::{Map, MapError};
use crate::seed::{Seed, Source, Stream};

/// What can be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One winding way.
    Tunnel,
    /// Chambers and the passages between them, rugged.
    Cave,
    /// One-way-only corridors: between two places there is one way.
    Maze,
    /// Rooms with doors.
    Rooms,
    /// A mine whose roof stands on pillars.
    RoomAndPillar,
    /// A mine of one drift, from which galleries leave, and galleries from those.
    Branching,
}

/// Every kind, in the order in which messages name them.
pub const KINDS: [Kind; 6] =
    [Kind::Tunnel, Kind::Cave, Kind::Maze, Kind::Rooms, Kind::RoomAndPillar, Kind::Branching];

impl Kind {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tunnel => "tunnel",
            Self::Cave => "cave",
            Self::Maze => "maze",
            Self::Rooms => "rooms",
            Self::RoomAndPillar => "room-and-pillar",
            Self::Branching => "branching",
        }
    }

    /// The kind of this name.
    pub fn find(name: &str) -> Option<Self> {
        KINDS.into_iter().find(|kind| kind.name() == name)
    }

    /// How it is sized where nobody says.
    fn usual(self) -> Usual {
        let usual = |extent, width_m, roughness| Usual { extent, width_m, roughness };
        match self {
            Self::Tunnel => usual(Extent::Length(100.0), 2.0, Some(0.1)),
            Self::Cave => usual(Extent::Size([60.0, 40.0]), 2.0, Some(0.4)),
            Self::Maze => usual(Extent::Size([20.0, 15.0]), 1.0, None),
            Self::Rooms => usual(Extent::Size([30.0, 20.0]), 1.0, None),
            Self::RoomAndPillar => usual(Extent::Size([120.0, 80.0]), 5.0, None),
            Self::Branching => usual(Extent::Length(1000.0), 3.0, Some(0.1)),
        }
    }
}

struct Usual {
    extent: Extent,
    width_m: f64,
    /// `None` for kinds whose walls are straight.
    roughness: Option<f64>,
}

/// How large a map is: by the length of its ways, or by its box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// Of all ways together (m).
    Length(f64),
    /// Across and up (m).
    Size([f64; 2]),
}

/// What is wished for. What is `None` is as usual for the kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wish {
    /// What.
    pub kind: Kind,
    /// Which one of them.
    pub seed: u64,
    /// How large.
    pub extent: Option<Extent>,
    /// Width of the passages, of doors in `rooms` (m).
    pub width_m: Option<f64>,
    /// By which share of it the width varies along the way, 0 to 0.5.
    pub roughness: Option<f64>,
}

/// What came of a wish.
#[derive(Debug, Clone)]
pub struct Made {
    /// The map.
    pub map: Map,
    /// A place for a base station, in the map's own frame (m).
    pub base_m: [f64; 2],
    /// The place farthest from there by the way, in the map's own frame (m).
    pub goal_m: [f64; 2],
    /// The way between them (m).
    pub way_m: f64,
    /// All ways together (m).
    pub length_m: f64,
    /// Width of the passages (m).
    pub width_m: f64,
    /// By which share of it the width varies.
    pub roughness: f64,
}

/// Why there is no such map.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MakeError {
    /// A wish that means nothing for the kind.
    #[error("a {} has no {what}; {instead}", kind.name())]
    Meaningless {
        /// The kind.
        kind: Kind,
        /// What was wished.
        what: &'static str,
        /// What it has instead.
        instead: &'static str,
    },
    /// A number out of its range.
    #[error("{what} = {got}: must lie in {low}..={high}")]
    Range {
        /// The quantity, unit included.
        what: &'static str,
        /// What was wished.
        got: f64,
        /// Least value allowed.
        low: f64,
        /// Greatest value allowed.
        high: f64,
    },
    /// No map came of it.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// Widths of passages (m).
const WIDTHS_M: (f64, f64) = (0.2, 50.0);
/// Longest ways together, and longest side (m).
const LONGEST_M: f64 = 20_000.0;
const LARGEST_M: f64 = 5000.0;
/// Most widths that a length or the product of both sides may come to: what is kept in memory grows with them.
const MOST_WIDTHS: f64 = 20_000.0;
/// Most that a width varies.
const ROUGHEST: f64 = 0.5;

impl Wish {
    /// Makes the map.
    ///
    /// ```
    /// use uchain_sim::map::make::{Kind, Wish};
    /// let wish = Wish { kind: Kind::Maze, seed: 7, extent: None, width_m: None, roughness: None };
    /// let made = wish.make().unwrap();
    /// assert!(!made.map.in_rock(made.map.to_local(made.goal_m)));
    /// ```
    ///
    /// # Errors
    /// [`MakeError`]: a number that is out of its range or that the kind has no use for.
    pub fn make(&self) -> Result<Made, MakeError> {
        let usual = self.kind.usual();
        let width_m = within("width_m", self.width_m.unwrap_or(usual.width_m), WIDTHS_M.0, WIDTHS_M.1)?;
        let roughness = match (self.roughness, usual.roughness) {
            (Some(_), None) => {
                let instead = "its walls are straight";
                return Err(MakeError::Meaningless { kind: self.kind, what: "roughness", instead });
            }
            (asked, usual) => within("roughness", asked.or(usual).unwrap_or(0.0), 0.0, ROUGHEST)?,
        };
        let stream = || Seed(self.seed).stream(0, Source::Map);
        let made = match (self.extent.unwrap_or(usual.extent), usual.extent) {
            (Extent::Length(length_m), Extent::Length(_)) => {
                let most_m = LONGEST_M.min(MOST_WIDTHS * width_m);
                let length_m = within("length_m", length_m, 5.0 * width_m, most_m)?;
                bore::ways(self.kind, length_m, width_m, roughness, &mut stream())?
            }
            (Extent::Size(size_m), Extent::Size(_)) => {
                let least_m = if self.kind == Kind::Cave { 10.0 } else { 4.0 } * width_m;
                for side_m in size_m {
                    within("size_m", side_m, least_m, LARGEST_M)?;
                }
                let widths = size_m[0] * size_m[1] / (width_m * width_m);
                within("size_m (both sides multiplied, in squares of the width)", widths, 1.0, MOST_WIDTHS)?;
                match self.kind {
                    Kind::Cave => bore::cave(size_m, width_m, roughness, &mut stream())?,
                    kind => lattice::grid(kind, size_m, width_m, &mut stream())?,
                }
            }
            (Extent::Length(_), Extent::Size(_)) => {
                let instead = "it has a size";
                return Err(MakeError::Meaningless { kind: self.kind, what: "length", instead });
            }
            (Extent::Size(_), Extent::Length(_)) => {
                let instead = "it has a length";
                return Err(MakeError::Meaningless { kind: self.kind, what: "size", instead });
            }
        };
        let short = |at_m: [f64; 2]| at_m.map(|m| (m * 100.0).round() / 100.0);
        Ok(Made { base_m: short(made.base_m), goal_m: short(made.goal_m), width_m, roughness, ..made })
    }
}

fn within(what: &'static str, got: f64, low: f64, high: f64) -> Result<f64, MakeError> {
    if (low..=high).contains(&got) { Ok(got) } else { Err(MakeError::Range { what, got, low, high }) }
}

/// Uniform between two numbers.
fn between(stream: &mut Stream, low: f64, high: f64) -> f64 {
    low + (high - low) * f64::from(stream.uniform())
}

/// A whole number below `count`, which is at least 1.
fn below(stream: &mut Stream, count: usize) -> usize {
    (f64::from(stream.uniform()) * count as f64) as usize
}

/// For each node the length of the shortest way from the first one (m), by Dijkstra; infinite where there is none.
fn way_lengths_m(from: usize, edges: &[Vec<(usize, f64)>]) -> Vec<f64> {
    let mut lengths_m = vec![f64::INFINITY; edges.len()];
    let mut open = std::collections::BTreeSet::from([(0_u64, from)]);
    lengths_m[from] = 0.0;
    while let Some((bits, node)) = open.pop_first() {
        for &(next, edge_m) in &edges[node] {
            let length_m = f64::from_bits(bits) + edge_m;
            if length_m < lengths_m[next] {
                // Bits of numbers that are not negative are ordered as the numbers are.
                open.remove(&(lengths_m[next].to_bits(), next));
                open.insert((length_m.to_bits(), next));
                lengths_m[next] = length_m;
            }
        }
    }
    lengths_m
}

/// The node farthest from the first one that can be reached, and how far it is (m).
fn farthest(lengths_m: &[f64], may_be: impl Fn(usize) -> bool) -> (usize, f64) {
    let reached = lengths_m.iter().copied().enumerate().filter(|&(node, m)| m.is_finite() && may_be(node));
    reached.fold((0, 0.0), |best, (node, m)| if m > best.1 { (node, m) } else { best })
}
