//! The cells of one column, side by side: many rows need little more room than their numbers.

use std::ops::Range;

use crate::analyse::{Cell, Kind};

/// The cells of one column in some rows. Numbers are finite; one that is absent is NaN here.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Values {
    /// Whole numbers.
    Counts(Vec<Option<i64>>),
    /// Numbers, 64 bits.
    Numbers(Vec<f64>),
    /// Numbers, 32 bits.
    Singles(Vec<f32>),
    /// Words.
    Texts(Texts),
    /// Lists of numbers, 64 bits.
    NumberLists(Lists<f64>),
    /// Lists of numbers, 32 bits.
    SingleLists(Lists<f32>),
}

/// Words one after another.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Texts {
    rows: Rows,
    text: String,
}

/// Lists one after another. An entry that is absent is NaN.
#[derive(Debug, Clone, Default)]
pub struct Lists<T> {
    rows: Rows,
    entries: Vec<T>,
}

/// Where what belongs to a row ends, and whether there is anything.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Rows(Vec<(usize, bool)>);

impl Rows {
    fn at(&self, row: usize) -> Option<Range<usize>> {
        let (end, is_there) = *self.0.get(row)?;
        is_there.then(|| self.start(row)..end)
    }

    fn start(&self, row: usize) -> usize {
        row.checked_sub(1).and_then(|before| self.0.get(before)).map_or(0, |(end, _)| *end)
    }

    fn end(&self) -> usize {
        self.start(self.0.len())
    }

    /// Appends rows of another one; says what belongs to them.
    fn extend(&mut self, other: &Self, rows: Range<usize>) -> Range<usize> {
        let (here, there) = (self.end(), other.start(rows.start));
        let taken = other.0.get(rows.clone()).unwrap_or_default();
        self.0.extend(taken.iter().map(|(end, is_there)| (here + end - there, *is_there)));
        there..other.start(rows.end)
    }
}

impl Texts {
    /// The words of a row, if it has any.
    pub fn get(&self, row: usize) -> Option<&str> {
        self.text.get(self.rows.at(row)?)
    }

    /// The words of every row.
    pub fn iter(&self) -> impl Iterator<Item = Option<&str>> {
        (0..self.rows.0.len()).map(|row| self.get(row))
    }

    fn push(&mut self, text: Option<&str>) {
        self.text.push_str(text.unwrap_or_default());
        self.rows.0.push((self.text.len(), text.is_some()));
    }
}

impl<T: Copy> Lists<T> {
    /// The list of a row, if it has one.
    pub fn get(&self, row: usize) -> Option<&[T]> {
        self.entries.get(self.rows.at(row)?)
    }

    /// The list of every row.
    pub fn iter(&self) -> impl Iterator<Item = Option<&[T]>> {
        (0..self.rows.0.len()).map(|row| self.get(row))
    }

    fn push(&mut self, cell: &Cell, absent: T, entry: impl Fn(f64) -> T) {
        let list = if let Cell::Numbers(list) = cell { Some(list) } else { None };
        self.entries.extend(list.into_iter().flatten().map(|number| number.map_or(absent, &entry)));
        self.rows.0.push((self.entries.len(), list.is_some()));
    }

    fn extend(&mut self, other: &Self, rows: Range<usize>) {
        let entries = self.rows.extend(&other.rows, rows);
        self.entries.extend_from_slice(other.entries.get(entries).unwrap_or_default());
    }
}

impl Values {
    pub(super) fn of(kind: Kind) -> Self {
        match kind {
            Kind::Count => Self::Counts(Vec::new()),
            Kind::Number => Self::Numbers(Vec::new()),
            Kind::Single => Self::Singles(Vec::new()),
            Kind::Text => Self::Texts(Texts::default()),
            Kind::Numbers => Self::NumberLists(Lists { rows: Rows::default(), entries: Vec::new() }),
            Kind::Singles => Self::SingleLists(Lists { rows: Rows::default(), entries: Vec::new() }),
        }
    }

    /// Makes room for so many more rows, without what belongs to them.
    pub(super) fn reserve(&mut self, rows: usize) {
        match self {
            Self::Counts(counts) => counts.reserve_exact(rows),
            Self::Numbers(numbers) => numbers.reserve_exact(rows),
            Self::Singles(singles) => singles.reserve_exact(rows),
            Self::Texts(texts) => texts.rows.0.reserve_exact(rows),
            Self::NumberLists(lists) => lists.rows.0.reserve_exact(rows),
            Self::SingleLists(lists) => lists.rows.0.reserve_exact(rows),
        }
    }

    /// Appends a cell; one that is of another kind is absent.
    pub(super) fn push(&mut self, cell: &Cell) {
        match self {
            Self::Counts(counts) => {
                counts.push(if let Cell::Count(count) = cell { Some(*count) } else { None });
            }
            Self::Numbers(numbers) => numbers.push(cell.number().unwrap_or(f64::NAN)),
            Self::Singles(singles) => singles.push(cell.number().map_or(f32::NAN, |number| number as f32)),
            Self::Texts(texts) => texts.push(cell.text()),
            Self::NumberLists(lists) => lists.push(cell, f64::NAN, |number| number),
            Self::SingleLists(lists) => lists.push(cell, f32::NAN, |number| number as f32),
        }
    }

    /// Appends rows of another column of its kind.
    pub(super) fn extend(&mut self, other: &Self, rows: Range<usize>) {
        match (self, other) {
            (Self::Counts(here), Self::Counts(there)) => here.extend(there.get(rows).unwrap_or_default()),
            (Self::Numbers(here), Self::Numbers(there)) => here.extend(there.get(rows).unwrap_or_default()),
            (Self::Singles(here), Self::Singles(there)) => here.extend(there.get(rows).unwrap_or_default()),
            (Self::Texts(here), Self::Texts(there)) => {
                let text = here.rows.extend(&there.rows, rows);
                here.text.push_str(there.text.get(text).unwrap_or_default());
            }
            (Self::NumberLists(here), Self::NumberLists(there)) => here.extend(there, rows),
            (Self::SingleLists(here), Self::SingleLists(there)) => here.extend(there, rows),
            // Tables of one sweep have the same columns.
            _ => {}
        }
    }

    /// The cell of a row.
    pub fn cell(&self, row: usize) -> Cell {
        let list = |entries: &mut dyn Iterator<Item = f64>| Cell::list(entries);
        match self {
            Self::Counts(counts) => counts.get(row).copied().flatten().map_or(Cell::Absent, Cell::Count),
            Self::Numbers(numbers) => numbers.get(row).copied().into(),
            Self::Singles(singles) => singles.get(row).copied().into(),
            Self::Texts(texts) => texts.get(row).into(),
            Self::NumberLists(lists) => {
                lists.get(row).map_or(Cell::Absent, |entries| list(&mut entries.iter().copied()))
            }
            Self::SingleLists(lists) => lists
                .get(row)
                .map_or(Cell::Absent, |entries| list(&mut entries.iter().map(|n| f64::from(*n)))),
        }
    }
}

/// Bit for bit.
impl PartialEq for Values {
    fn eq(&self, other: &Self) -> bool {
        let same = |one: &[f64], other: &[f64]| {
            one.iter().map(|n| n.to_bits()).eq(other.iter().map(|n| n.to_bits()))
        };
        let singles = |one: &[f32], other: &[f32]| {
            one.iter().map(|n| n.to_bits()).eq(other.iter().map(|n| n.to_bits()))
        };
        match (self, other) {
            (Self::Counts(one), Self::Counts(other)) => one == other,
            (Self::Numbers(one), Self::Numbers(other)) => same(one, other),
            (Self::Singles(one), Self::Singles(other)) => singles(one, other),
            (Self::Texts(one), Self::Texts(other)) => one == other,
            (Self::NumberLists(one), Self::NumberLists(other)) => {
                one.rows == other.rows && same(&one.entries, &other.entries)
            }
            (Self::SingleLists(one), Self::SingleLists(other)) => {
                one.rows == other.rows && singles(&one.entries, &other.entries)
            }
            _ => false,
        }
    }
}
