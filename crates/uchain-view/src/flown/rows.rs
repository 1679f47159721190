//! Numbers over time, in bounded memory.

/// Most numbers that are kept; beyond, every second row goes, and fewer come.
const MOST_NUMBERS: usize = 8 << 20;

/// Rows of numbers.
#[derive(Debug)]
pub(super) struct Rows {
    columns: Vec<String>,
    numbers: Vec<f32>,
    /// One of so many rows is kept.
    every: u64,
    seen: u64,
    /// How often rows have been thinned: what a page has kept is void then.
    generation: u32,
    most: usize,
}

/// Rows as a page gets them.
#[derive(Debug)]
pub(crate) struct Series {
    pub(crate) columns: Vec<String>,
    pub(crate) rows: usize,
    pub(crate) generation: u32,
    /// Row by row, little-endian.
    pub(crate) numbers: Vec<u8>,
}

impl Rows {
    pub(super) fn new(columns: Vec<String>) -> Self {
        Self { columns, numbers: Vec::new(), every: 1, seen: 0, generation: 0, most: MOST_NUMBERS }
    }

    /// One row more, if its turn has come; `fill` appends as many numbers as there are columns.
    pub(super) fn push(&mut self, fill: impl FnOnce(&mut Vec<f32>)) {
        let width = self.columns.len().max(1);
        let turn = self.seen.is_multiple_of(self.every);
        self.seen += 1;
        if !turn {
            return;
        }
        let wanted = self.numbers.len() + width;
        fill(&mut self.numbers);
        self.numbers.resize(wanted, f32::NAN);
        if self.numbers.len() > self.most {
            self.numbers = self.numbers.chunks(width).step_by(2).flatten().copied().collect();
            self.every *= 2;
            self.generation += 1;
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.numbers.len() / self.columns.len().max(1)
    }

    pub(super) fn generation(&self) -> u32 {
        self.generation
    }

    /// The rows from one on.
    pub(super) fn from(&self, row: usize) -> Series {
        let rest = self.numbers.get(row.saturating_mul(self.columns.len().max(1))..).unwrap_or_default();
        Series {
            columns: self.columns.clone(),
            rows: self.count(),
            generation: self.generation,
            numbers: rest.iter().flat_map(|number| number.to_le_bytes()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_are_too_many_are_thinned_and_stay_in_order() {
        let mut rows = Rows { most: 100, ..Rows::new(vec!["time_s".to_owned(), "x_m.0".to_owned()]) };
        for row in 0_u16..1000 {
            rows.push(|to| to.extend([f32::from(row), 0.0]));
            assert!(rows.numbers.len() <= 102);
        }
        let series = rows.from(0);
        let times: Vec<f32> = series
            .numbers
            .chunks(8)
            .map(|row| f32::from_le_bytes([row[0], row[1], row[2], row[3]]))
            .collect();
        assert_eq!(times.len(), series.rows);
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == rows.every as f32), "{times:?}");
        assert!(series.generation > 0 && times.len() > 20);
        assert!(rows.from(rows.count()).numbers.is_empty());
        assert!(rows.from(usize::MAX).numbers.is_empty());
    }
}
