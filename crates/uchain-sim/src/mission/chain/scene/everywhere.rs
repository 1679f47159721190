//! How many relays every place of a map needs, those on the shortest way to it.

use std::collections::{BTreeSet, VecDeque};

use glam::{IVec2, Vec2};
use uchain_core::bounded;

use super::Course;
use crate::{
    analyse::optimum::fewest_links,
    map::{CellGrid, MapError, WayTree},
    radio::Antenna,
};

/// About how many cells the free area is looked at in, and where a loss takes a search.
const CELLS: f64 = 40_000.0;
const CELLS_WHERE_COSTLY: f64 = 2_000.0;
/// Most cells: along ragged walls more middles of cells may be free than the area has room for.
const MOST_CELLS: usize = 200_000;
/// How far a place may lie from the sample that it is reached from, as a share of the longest link.
const STRAIGHT: f64 = 0.25;
/// Spacing of the samples that relays stand on, as a share of the longest link, and its bounds (m).
const SPACING: f64 = 1.0 / 60.0;
const SPACING_M: (f64, f64) = (0.05, 0.25);
/// Smallest cell (m).
const CELL_LEAST_M: f32 = 0.02;
/// Most columns or rows that are counted: a map may be 200 km wide.
const MOST_SIDE: f32 = 1e9;
/// As near as this a reach is found (m), and none is longer than this (m).
const REACH_M: (f32, f32) = (0.01, 1e6);

/// How many relays every place needs that can be reached from the base.
#[derive(Debug, Clone)]
pub struct Everywhere {
    /// The shortest ways from the base along the middle of the passages, wide enough for a UAV.
    pub tree: WayTree,
    /// The relays that a head at each sample of the tree needs, as many as it takes for every link to stay within
    /// `takeoff.s_min_db`; `None` where no number is enough.
    pub relays: Vec<Option<u32>>,
    /// Side of a cell (m).
    pub cell_m: f32,
    /// The cells whose middles are free and joined with the base, each after one that it is joined with.
    pub cells: Vec<ReachedCell>,
    /// Area of free space, that out of reach included (m²).
    pub free_area_m2: f64,
}

/// A square cell of free space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReachedCell {
    /// Column and row from the lower left corner of the map's bounds.
    pub column_and_row: [i32; 2],
    /// Its middle (m).
    pub at: Vec2,
    /// Length of the way there from the base: along the tree as far as it is seen from there, then straight (m).
    pub depth_m: f64,
    /// The relays that a head there needs; `None` where no number is enough.
    pub relays: Option<u32>,
}

impl Everywhere {
    /// The share of the free area where so many relays are enough (1), the parts of the map that no way joins with the base
    /// counted as out of reach.
    pub fn share_within(&self, relays: u32) -> f64 {
        let within =
            self.cells.iter().filter(|cell| cell.relays.is_some_and(|needed| needed <= relays)).count();
        self.share(within)
    }

    /// The share of the free area that a way joins with the base (1).
    pub fn share_joined(&self) -> f64 {
        self.share(self.cells.len())
    }

    fn share(&self, cells: usize) -> f64 {
        let area_m2 = cells as f64 * f64::from(self.cell_m) * f64::from(self.cell_m);
        if self.free_area_m2 > 0.0 { (area_m2 / self.free_area_m2).min(1.0) } else { 0.0 }
    }

    /// The most relays that a place needs which can be reached at all; `None` without such a place.
    pub fn relays_most(&self) -> Option<u32> {
        self.cells.iter().filter_map(|cell| cell.relays).max()
    }
}

/// The ways from the base, and after their samples the cells.
struct Ways {
    at: Vec<Vec2>,
    parent: Vec<Option<u32>>,
    depth_m: Vec<f64>,
    cells: Vec<IVec2>,
}

impl Course {
    /// How many relays every place needs that can be reached from the base. The relays of a place stand on the shortest way
    /// there along the middle of the passages ([`Map::tunnel_graph`](crate::map::Map::tunnel_graph)), anywhere on it, and
    /// every link loses `takeoff.s_min_db` at most, noise off. A place beside the middle is reached straight from the
    /// nearest sample of the ways that sees it; on open ground, and where none sees it, from place to place.
    ///
    /// # Errors
    /// A map too large for the tunnel graph.
    pub fn relays_everywhere(&self) -> Result<Everywhere, MapError> {
        let graph = self.map.tunnel_graph()?;
        let s_min_db = self.scenario.takeoff.s_min_db;
        let reach_m = self.reach_m(s_min_db);
        let spacing_m = bounded(SPACING * reach_m, SPACING_M.0, SPACING_M.1);
        let tree = graph.tree_every(&self.map, self.base, self.scenario.motion.radius_m, spacing_m);
        let free_area_m2: f64 = self.map.free_areas_m2().iter().sum();
        let cells = if self.radio.is_costly() { CELLS_WHERE_COSTLY } else { CELLS };
        let cell_m = ((free_area_m2 / cells).sqrt() as f32).max(CELL_LEAST_M);
        let ways = self.ways(&tree, cell_m, STRAIGHT * reach_m);
        let antennas: Vec<Antenna> = (0..ways.at.len()).map(|index| ways.antenna(index)).collect();
        let loss_db = |from: usize, to: usize| f64::from(self.loss_db(&antennas[from], &antennas[to]));
        let links = fewest_links(&ways.at, &ways.parent, reach_m, s_min_db.into(), loss_db);
        // The last link has no relay at its far end, but the head.
        let mut relays: Vec<Option<u32>> =
            links.into_iter().map(|links| links.map(|links| links.saturating_sub(1))).collect();
        let of_cells = relays.split_off(tree.at.len());
        let cells = ways.cells.iter().zip(of_cells).enumerate().map(|(index, (cell, relays))| {
            let sample = tree.at.len() + index;
            ReachedCell {
                column_and_row: cell.to_array(),
                at: ways.at[sample],
                depth_m: ways.depth_m[sample],
                relays,
            }
        });
        let cells = cells.collect();
        Ok(Everywhere { tree, relays, cell_m, cells, free_area_m2 })
    }

    /// The longest straight distance over which a link may lose no more than so much (m); infinite where nobody knows.
    fn reach_m(&self, s_min_db: f32) -> f64 {
        let (within_m, most_m) = REACH_M;
        let is_out = |apart_m: f32| self.least_loss_db(apart_m) > s_min_db;
        if !is_out(most_m) {
            return f64::INFINITY;
        }
        let (mut near_m, mut far_m) = (0.0, most_m);
        while far_m - near_m > within_m.max(1e-6 * far_m) {
            let middle_m = f32::midpoint(near_m, far_m);
            *(if is_out(middle_m) { &mut far_m } else { &mut near_m }) = middle_m;
        }
        far_m.into()
    }

    /// The tree, and the cells that can be flooded from it, each joined to the nearest sample that it sees. On open ground, where
    /// that is farther than `straight_m`, cells go on from one another, in steps as long: relays have to stand in between.
    fn ways(&self, tree: &WayTree, cell_m: f32, straight_m: f64) -> Ways {
        let mut ways = Ways {
            at: tree.at.clone(),
            parent: tree.parent.clone(),
            depth_m: tree.depth_m.clone(),
            cells: Vec::new(),
        };
        let (low, high) = self.map.bounds();
        let size = ((high - low) / cell_m).ceil().min(Vec2::splat(MOST_SIDE)).as_ivec2().max(IVec2::ONE);
        let middle = |cell: IVec2| low + (cell.as_vec2() + 0.5) * cell_m;
        let near = tree.near();
        let mut seen = BTreeSet::new();
        let mut open: VecDeque<(IVec2, u32)> = VecDeque::new();
        for (sample, &at) in tree.at.iter().enumerate() {
            open.push_back((((at - low) / cell_m).floor().as_ivec2(), sample as u32));
        }
        while let Some((cell, from)) = open.pop_front() {
            let inside = cell.cmpge(IVec2::ZERO).all() && cell.cmplt(size).all();
            if !inside || seen.len() == MOST_CELLS || seen.contains(&(cell.y, cell.x)) {
                continue;
            }
            let at = middle(cell);
            if self.map.in_rock(at) {
                seen.insert((cell.y, cell.x));
                continue;
            }
            // A wall may run between two neighbours: another one may still join the cell.
            let sample = near.seen_from(&self.map, at, 0.0).map(|sample| sample as u32);
            let is_far =
                |sample: u32, ways: &Ways| f64::from(ways.at[sample as usize].distance(at)) > straight_m;
            let sample = sample.filter(|&sample| !is_far(sample, &ways));
            let sample = sample.or_else(|| self.map.sees(at, ways.at[from as usize]).then_some(from));
            let Some(mut before) = sample else { continue };
            while let Some(earlier) = ways.parent[before as usize]
                && before >= tree.at.len() as u32
                && !is_far(earlier, &ways)
                && self.map.sees(at, ways.at[earlier as usize])
            {
                before = earlier;
            }
            seen.insert((cell.y, cell.x));
            let here = ways.at.len() as u32;
            let step_m = f64::from(ways.at[before as usize].distance(at));
            ways.depth_m.push(ways.depth_m[before as usize] + step_m);
            ways.at.push(at);
            ways.parent.push(Some(before));
            ways.cells.push(cell);
            open.extend(CellGrid::STEPS.map(|step| (cell + step, here)));
        }
        ways
    }
}

impl Ways {
    /// A UAV that has come this way, or the base.
    fn antenna(&self, index: usize) -> Antenna {
        let at = self.at[index];
        let heading_rad = self.parent[index].map(|before| {
            let along = at - self.at[before as usize];
            libm::atan2f(along.y, along.x)
        });
        Antenna { heading_rad, ..at.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{config::builtin, map::Map};

    #[test]
    fn the_whole_of_an_open_field_can_be_reached_with_relays_enough() {
        let field =
            ["map={ walls = { outer_m = [[0, 0], [40, 0], [40, 40], [0, 40]] } }", "chain.base_m=[10, 10]"];
        let everywhere = course("straight", &field).relays_everywhere().unwrap();
        let most = everywhere.relays_most().unwrap();
        assert!(everywhere.share_within(most) > 0.99, "{}", everywhere.share_within(most));
        // The farthest corner is 42.4 m away, and a link reaches 4.446 m: 9 relays, or a few more from cell to cell.
        assert!((9..=13).contains(&most), "{most}");
    }

    fn course(name: &str, sets: &[&str]) -> std::sync::Arc<Course> {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Course::read(&builtin(name).unwrap(), &sets).unwrap()
    }

    #[test]
    fn along_a_tunnel_every_place_needs_what_the_optimum_says_or_one_more_just_before_that_does() {
        for (name, sets) in
            [("straight", &[] as &[&str]), ("corner", &["takeoff.s_min_db=50"]), ("staircase", &[])]
        {
            let course = course(name, sets);
            let (optimum, tunnel) = (course.optimum().unwrap(), course.tunnel.as_ref().unwrap());
            let everywhere = course.relays_everywhere().unwrap();
            let (mut alike, mut ahead) = (0, 0);
            for (&at, &relays) in everywhere.tree.at.iter().zip(&everywhere.relays).step_by(7) {
                let depth_m = tunnel.depth_m(at);
                if depth_m <= 0.0 || at.distance(tunnel.at(depth_m).0) > 0.02 {
                    continue;
                }
                let needed = optimum.links_needed(depth_m).map(|links| links as u32 - 1);
                match (needed, relays) {
                    _ if needed == relays => alike += 1,
                    (Some(needed), Some(relays)) if relays == needed + 1 => ahead += 1,
                    _ => panic!("{name}: {depth_m} m: the optimum needs {needed:?}, the tree {relays:?}"),
                }
            }
            assert!(alike > 20 && alike > 6 * ahead, "{name}: {alike} alike, {ahead} one more");
        }
    }

    #[test]
    fn a_weaker_link_takes_more_relays_and_no_place_is_lost_by_a_stronger_one() {
        let [weak, strong] = [50.0, 60.0].map(|s_min_db: f32| {
            let course = course("circuit", &[&format!("takeoff.s_min_db={s_min_db}")]);
            let mut everywhere = course.relays_everywhere().unwrap();
            everywhere.cells.sort_by_key(|cell| cell.column_and_row);
            everywhere
        });
        assert_eq!(weak.cells.len(), strong.cells.len());
        for (weak, strong) in weak.cells.iter().zip(&strong.cells) {
            assert_eq!(weak.column_and_row, strong.column_and_row);
            assert!(strong.relays.is_some() && weak.relays >= strong.relays, "{weak:?} {strong:?}");
        }
        assert!(weak.relays_most() > strong.relays_most());
        let shares: Vec<f64> = (0..=strong.relays_most().unwrap()).map(|n| strong.share_within(n)).collect();
        assert!(shares.is_sorted() && shares[0] > 0.0 && shares[0] < 0.5, "{shares:?}");
        assert_eq!(shares.last().copied(), Some(strong.share_joined()));
        assert!(strong.share_joined() > 0.97, "{}", strong.share_joined());
    }

    #[test]
    fn what_no_way_joins_with_the_base_is_out_of_reach() {
        // Around the base a room, and another one beside it.
        let room = |y: f32| [[-1.0, y], [9.0, y], [9.0, y + 2.0], [-1.0, y + 2.0]].map(Vec2::from).to_vec();
        let mut two = (*course("straight", &[])).clone();
        two.map = std::sync::Arc::new(Map::from_loops(vec![room(-1.0), room(1.5)]).unwrap());
        let everywhere = two.relays_everywhere().unwrap();
        assert!(everywhere.cells.iter().all(|cell| cell.at.y < 1.0));
        assert!((everywhere.share_joined() - 0.5).abs() < 0.02, "{}", everywhere.share_joined());
        assert_eq!(everywhere.free_area_m2, 40.0);
    }
}
