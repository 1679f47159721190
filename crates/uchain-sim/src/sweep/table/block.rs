//! Rows of successive runs, column by column.

use std::ops::Range;

use super::Values;
use crate::analyse::{Cell, Column};

/// Most rows of a block: what reads a table block by block needs room for one.
pub const BLOCK_ROWS: usize = 16_384;

/// Rows of successive runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    first: u64,
    rows: usize,
    values: Vec<Values>,
}

impl Block {
    pub(super) fn of(columns: &[Column], first: u64) -> Self {
        Self { first, rows: 0, values: columns.iter().map(|column| Values::of(column.kind)).collect() }
    }

    /// Without rows, with room for the runs from the first up to an end.
    fn with_room(columns: &[Column], first: u64, end: u64) -> Self {
        let mut block = Self::of(columns, first);
        let rows = usize::try_from(end - first).unwrap_or(usize::MAX).min(BLOCK_ROWS);
        block.values.iter_mut().for_each(|values| values.reserve(rows));
        block
    }

    /// Its runs.
    pub fn runs(&self) -> Range<u64> {
        self.first..self.first + self.rows as u64
    }

    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Its columns, in the order of the table's.
    pub fn values(&self) -> &[Values] {
        &self.values
    }

    /// A row as it is written to files.
    pub(super) fn row(&self, row: usize) -> Vec<Cell> {
        self.values.iter().map(|values| values.cell(row)).collect()
    }

    /// Appends the row of the next run.
    pub(super) fn push<'c>(&mut self, row: impl Iterator<Item = &'c Cell>) {
        for (values, cell) in self.values.iter_mut().zip(row.chain(std::iter::repeat(&Cell::Absent))) {
            values.push(cell);
        }
        self.rows += 1;
    }
}

/// Puts blocks into the order of their runs, as few as hold them; how they were cut up before does not show.
///
/// # Errors
/// A run that is in two of them.
pub(super) fn joined(columns: &[Column], mut blocks: Vec<Block>) -> Result<Vec<Block>, u64> {
    blocks.sort_by_key(|block| block.first);
    if let Some(pair) = blocks.windows(2).find(|pair| pair[1].first < pair[0].runs().end) {
        return Err(pair[1].first);
    }
    let gaps = ends_before_gaps(&blocks);
    let mut whole: Vec<Block> = Vec::new();
    // Each is given up as soon as its rows are elsewhere.
    for (block, gap) in blocks.into_iter().zip(gaps) {
        let mut from = 0;
        while from < block.rows {
            let run = block.first + from as u64;
            let last = whole.last_mut().filter(|last| last.runs().end == run && last.rows < BLOCK_ROWS);
            let Some(last) = last else {
                whole.push(Block::with_room(columns, run, gap));
                continue;
            };
            let taken = (BLOCK_ROWS - last.rows).min(block.rows - from);
            for (here, there) in last.values.iter_mut().zip(&block.values) {
                here.extend(there, from..from + taken);
            }
            last.rows += taken;
            from += taken;
        }
    }
    Ok(whole)
}

/// For each block the run at which the successive runs end that it belongs to.
fn ends_before_gaps(blocks: &[Block]) -> Vec<u64> {
    let mut ends: Vec<u64> = blocks.iter().map(|block| block.runs().end).collect();
    for place in (1..blocks.len()).rev() {
        if ends[place - 1] == blocks[place].first {
            ends[place - 1] = ends[place];
        }
    }
    ends
}
