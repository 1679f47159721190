//! For each cell of a lattice, the walls within reach of it.

use glam::Vec2;

use super::{
    batch::{Batch, LANES},
    lattice::{BLOCK_CELLS, Cell, Lattice},
};
use crate::map::Segment;

/// Walls listed cell by cell, in batches. All blocks without walls share one.
#[derive(Debug, Clone)]
pub(super) struct Lists {
    lattice: Lattice,
    /// For each block of the lattice its place in `starts`, in blocks.
    blocks: Vec<u32>,
    /// Where each cell's batches start; one more than there are cells.
    starts: Vec<u32>,
    batches: Vec<Batch>,
}

/// How many walls each cell is to list.
#[derive(Debug)]
pub(super) struct Counts {
    lattice: Lattice,
    reach_m: f32,
    blocks: Vec<u32>,
    walls: Vec<u32>,
    batches: usize,
}

impl Lists {
    /// Puts the walls into the lists counted for them.
    pub(super) fn new(walls: &[Segment], counts: Counts) -> Self {
        let Counts { lattice, reach_m, blocks, walls: counts, .. } = counts;
        let mut total = 0;
        let start_of = |count: &u32| {
            let start = total;
            total += count.div_ceil(LANES as u32);
            start
        };
        let mut starts: Vec<u32> = counts.iter().map(start_of).collect();
        starts.push(total);
        let mut lists = Self { lattice, blocks, starts, batches: vec![Batch::EMPTY; total as usize] };
        lists.fill(walls, reach_m, counts);
        lists
    }

    fn fill(&mut self, walls: &[Segment], reach_m: f32, mut left: Vec<u32>) {
        for wall in walls {
            self.lattice.near(wall, reach_m, |cell| {
                let index = index(&self.blocks, cell);
                let (from, to) = (self.starts[index] as usize, self.starts[index + 1] as usize);
                left[index] -= 1;
                let place = left[index] as usize;
                self.batches[from..to][place / LANES].set(place % LANES, wall);
                true
            });
        }
    }

    /// The walls within reach of a point, and perhaps a few more. `None` outside the lattice, where there are none.
    #[inline]
    pub(super) fn near(&self, p: Vec2) -> Option<&[Batch]> {
        let index = index(&self.blocks, self.lattice.cell_at(p)?);
        let (&from, &to) = (self.starts.get(index)?, self.starts.get(index + 1)?);
        self.batches.get(from as usize..to as usize)
    }

    /// Every wall, many of them more than once.
    pub(super) fn all(&self) -> &[Batch] {
        &self.batches
    }

    pub(super) fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Memory (bytes).
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        bytes(self.blocks.len(), self.starts.len() - 1, self.batches.len())
    }
}

impl Counts {
    /// For lists of all walls within `reach_m` of each cell; the walls' own bounds are `low` to `high`. Cells are
    /// `cell_m` wide, or as much wider as it takes to fit `most_bytes`, or to be one.
    pub(super) fn new(
        walls: &[Segment],
        (low, high): (Vec2, Vec2),
        reach_m: f32,
        mut cell_m: f32,
        most_bytes: usize,
    ) -> Self {
        loop {
            let lattice = Lattice::new(low - reach_m, high + reach_m, cell_m, most_bytes / size_of::<u32>());
            let counts = lattice.and_then(|lattice| Self::in_lattice(walls, lattice, reach_m, most_bytes));
            if let Some(counts) = counts {
                return counts;
            }
            cell_m *= 1.25;
        }
    }

    /// `None` if the lists would not fit.
    fn in_lattice(walls: &[Segment], lattice: Lattice, reach_m: f32, most_bytes: usize) -> Option<Self> {
        let most_bytes = if lattice.blocks() == 1 { usize::MAX } else { most_bytes };
        let blocks = vec![0; lattice.blocks()];
        // The first block is the empty one.
        let mut counts = Self { lattice, reach_m, blocks, walls: vec![0; BLOCK_CELLS], batches: 0 };
        walls
            .iter()
            .all(|wall| lattice.near(wall, reach_m, |cell| counts.add(cell, most_bytes)))
            .then_some(counts)
    }

    /// One wall more for a cell. Whether all still fits.
    fn add(&mut self, cell: Cell, most_bytes: usize) -> bool {
        let block = &mut self.blocks[cell.block];
        if *block == 0 {
            *block = (self.walls.len() / BLOCK_CELLS) as u32;
            self.walls.resize(self.walls.len() + BLOCK_CELLS, 0);
        }
        let count = &mut self.walls[*block as usize * BLOCK_CELLS + cell.place];
        self.batches += usize::from((*count as usize).is_multiple_of(LANES));
        *count += 1;
        bytes(self.blocks.len(), self.walls.len(), self.batches) <= most_bytes
    }

    /// The mean number of walls in a list, empty ones left out.
    pub(super) fn mean(&self) -> f32 {
        let (sum, lists) = self
            .walls
            .iter()
            .filter(|count| **count > 0)
            .fold((0, 0), |(s, n), c| (s + u64::from(*c), n + 1_u64));
        sum as f32 / lists.max(1) as f32
    }

    pub(super) fn cell_m(&self) -> f32 {
        self.lattice.cell_m()
    }
}

#[inline]
fn index(blocks: &[u32], cell: Cell) -> usize {
    blocks.get(cell.block).map_or(0, |&block| block as usize * BLOCK_CELLS) + cell.place
}

fn bytes(blocks: usize, cells: usize, batches: usize) -> usize {
    (blocks + cells + 1) * size_of::<u32>() + batches * size_of::<Batch>()
}
