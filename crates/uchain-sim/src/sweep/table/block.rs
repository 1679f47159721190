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
    let mut whole: Vec<Block> = Vec::new();
    let mut end = 0;
    // Each is given up as soon as its rows are elsewhere.
    for block in blocks {
        if block.first < end {
            return Err(block.first);
        }
        let mut from = 0;
        while from < block.rows {
            let run = block.first + from as u64;
            let room =
                whole.last().filter(|last| last.runs().end == run).map_or(0, |last| BLOCK_ROWS - last.rows);
            if room == 0 {
                if from == 0 && block.rows == BLOCK_ROWS {
                    end = block.runs().end;
                    whole.push(block);
                    break;
                }
                whole.push(Block::of(columns, run));
                continue;
            }
            let taken = room.min(block.rows - from);
            if let Some(last) = whole.last_mut() {
                for (here, there) in last.values.iter_mut().zip(&block.values) {
                    here.extend(there, from..from + taken);
                }
                last.rows += taken;
            }
            from += taken;
            end = run + taken as u64;
        }
    }
    Ok(whole)
}
