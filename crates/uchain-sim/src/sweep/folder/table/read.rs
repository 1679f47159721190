//! Reading a table that was written.

use std::{fs::File, path::Path};

use parquet::{
    column::reader::{ColumnReader, get_typed_column_reader},
    data_type::{ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type},
    errors::ParquetError,
    file::reader::{ChunkReader, FileReader as _, SerializedFileReader},
};

use super::{super::FolderError, GROUP_ROWS, Result, damaged};
use crate::{
    analyse::{Cell, Column, Kind},
    sweep::fly::caught,
};

/// A table that was written.
pub(in crate::sweep) struct Table<R: ChunkReader + 'static = File> {
    file: SerializedFileReader<R>,
    names: Vec<String>,
}

impl Table {
    pub(in crate::sweep) fn open(path: &Path) -> std::result::Result<Self, FolderError> {
        let file = File::open(path).map_err(FolderError::io(path, "read"))?;
        Self::of(file).map_err(|error| damaged(path, &error))
    }
}

impl<R: ChunkReader + 'static> Table<R> {
    /// Out of a file, or out of memory.
    pub(in crate::sweep) fn of(bytes: R) -> Result<Self> {
        let file = unpanicked(|| SerializedFileReader::new(bytes))?;
        let fields = file.metadata().file_metadata().schema().get_fields();
        let names = fields.iter().map(|field| field.name().to_owned()).collect();
        Ok(Self { file, names })
    }

    /// Number of row groups.
    pub(in crate::sweep) fn groups(&self) -> usize {
        self.file.num_row_groups()
    }

    /// One cell of a column of scalars.
    pub(in crate::sweep) fn cell(&self, column: &Column, row: u64) -> Result<Cell> {
        let mut first = 0;
        for group in 0..self.groups() {
            let rows = self.file.metadata().row_group(group).num_rows();
            let rows = u64::try_from(rows).unwrap_or(0);
            if row < first + rows {
                let cells = self.cells(column, group)?;
                return Ok(cells.into_iter().nth((row - first) as usize).unwrap_or(Cell::Absent));
            }
            first += rows;
        }
        Err(ParquetError::EOF(format!("it has {first} rows")))
    }

    /// The cells of a column in a row group.
    pub(in crate::sweep) fn cells(&self, column: &Column, group: usize) -> Result<Vec<Cell>> {
        let place = self.names.iter().position(|name| *name == column.name);
        let place = place.and_then(|field| self.leaf(field));
        let place =
            place.ok_or_else(|| ParquetError::General(format!("it has no column {}", column.name)))?;
        unpanicked(|| self.cells_of(column, place, group))
    }

    fn cells_of(&self, column: &Column, leaf: usize, group: usize) -> Result<Vec<Cell>> {
        let group = self.file.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0).min(GROUP_ROWS);
        let reader = group.get_column_reader(leaf)?;
        match (column.kind, &reader) {
            (Kind::Count, ColumnReader::Int64ColumnReader(_)) => read::<Int64Type>(reader, rows, Cell::Count),
            (Kind::Number, ColumnReader::DoubleColumnReader(_)) => {
                read::<DoubleType>(reader, rows, Cell::Number)
            }
            (Kind::Single, ColumnReader::FloatColumnReader(_)) => {
                read::<FloatType>(reader, rows, |number| Cell::Number(number.into()))
            }
            (Kind::Text, ColumnReader::ByteArrayColumnReader(_)) => {
                read::<ByteArrayType>(reader, rows, |text| text_of(&text))
            }
            (Kind::Numbers, ColumnReader::DoubleColumnReader(_)) => {
                read_lists::<DoubleType>(reader, rows, |number| number)
            }
            (Kind::Singles, ColumnReader::FloatColumnReader(_)) => {
                read_lists::<FloatType>(reader, rows, f64::from)
            }
            _ => Err(ParquetError::General(format!("its column {} is of another type", column.name))),
        }
    }

    /// The one leaf of this field.
    fn leaf(&self, field: usize) -> Option<usize> {
        let schema = self.file.metadata().file_metadata().schema_descr();
        (0..schema.num_columns()).find(|leaf| schema.get_column_root_idx(*leaf) == field)
    }
}

/// The crate panics at some headers that nobody wrote.
fn unpanicked<T>(read: impl FnOnce() -> Result<T>) -> Result<T> {
    caught(read).unwrap_or_else(|words| Err(ParquetError::General(words)))
}

fn text_of(bytes: &ByteArray) -> Cell {
    Cell::Text(String::from_utf8_lossy(bytes.data()).into_owned())
}

/// Levels as they are written: 0 no list, 1 a list without entries, 2 an absent entry, 3 an entry.
fn read_lists<T: DataType>(
    reader: ColumnReader,
    rows: usize,
    number: impl Fn(T::T) -> f64,
) -> Result<Vec<Cell>> {
    let (mut values, mut levels, mut repeats) = (Vec::new(), Vec::new(), Vec::new());
    let mut reader = get_typed_column_reader::<T>(reader);
    let (read, ..) = reader.read_records(rows, Some(&mut levels), Some(&mut repeats), &mut values)?;
    let mut values = values.into_iter().map(number);
    let mut cells: Vec<Cell> = Vec::with_capacity(rows);
    for (level, repeat) in levels.into_iter().zip(repeats) {
        if repeat == 0 {
            cells.push(if level == 0 { Cell::Absent } else { Cell::Numbers(Vec::new()) });
        }
        if let (true, Some(Cell::Numbers(list))) = (level > 1, cells.last_mut()) {
            list.push(if level == 2 { None } else { values.next() });
        }
    }
    if read != rows || cells.len() != rows {
        return Err(ParquetError::EOF("a column of lists is short".to_owned()));
    }
    Ok(cells)
}

fn read<T: DataType>(reader: ColumnReader, rows: usize, cell: impl Fn(T::T) -> Cell) -> Result<Vec<Cell>> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    let mut reader = get_typed_column_reader::<T>(reader);
    let (read, ..) = reader.read_records(rows, Some(&mut levels), None, &mut values)?;
    if read != rows {
        return Err(ParquetError::EOF("a column is short".to_owned()));
    }
    let mut values = values.into_iter();
    Ok(levels
        .iter()
        .map(|level| if *level == 0 { None } else { values.next() }.map_or(Cell::Absent, &cell))
        .collect())
}
