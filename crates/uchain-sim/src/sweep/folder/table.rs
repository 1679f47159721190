//! `runs.parquet`: the only place that knows Parquet. The table is flat and written row by row, so the crate's arrow half
//! would only copy what is in rows already; it stays out.

use std::{fs::File, io::Write, path::Path, sync::Arc};

use parquet::{
    basic::{LogicalType, Repetition, Type as Physical},
    column::{
        reader::{ColumnReader, get_typed_column_reader},
        writer::ColumnWriterImpl,
    },
    data_type::{ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type},
    errors::ParquetError,
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        reader::{FileReader as _, SerializedFileReader},
        writer::{SerializedColumnWriter, SerializedFileWriter},
    },
    schema::types::{ColumnPath, Type, TypePtr},
};

use super::FolderError;
use crate::sweep::{Cell, Column, Kind};

/// Rows of a row group, and entries of lists in it: they bound the memory of writers and readers.
const GROUP_ROWS: usize = 16_384;
const GROUP_ENTRIES: usize = 1 << 20;

type Result<T> = std::result::Result<T, ParquetError>;

fn field(column: &Column) -> Result<TypePtr> {
    let leaf = |name: &str, physical: Physical, logical: Option<LogicalType>| {
        let builder = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        builder.with_logical_type(logical).build().map(Arc::new)
    };
    let list = |physical: Physical| {
        let element = leaf("element", physical, None)?;
        let repeated = Type::group_type_builder("list")
            .with_repetition(Repetition::REPEATED)
            .with_fields(vec![element])
            .build()?;
        let outer = Type::group_type_builder(&column.name).with_repetition(Repetition::OPTIONAL);
        outer
            .with_logical_type(Some(LogicalType::List))
            .with_fields(vec![Arc::new(repeated)])
            .build()
            .map(Arc::new)
    };
    match column.kind {
        Kind::Count => leaf(&column.name, Physical::INT64, None),
        Kind::Number => leaf(&column.name, Physical::DOUBLE, None),
        Kind::Single => leaf(&column.name, Physical::FLOAT, None),
        Kind::Text => leaf(&column.name, Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Kind::Numbers => list(Physical::DOUBLE),
        Kind::Singles => list(Physical::FLOAT),
    }
}

/// Writes a table, a row group at a time.
pub(super) struct Writer<W: Write + Send> {
    file: SerializedFileWriter<W>,
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    entries: usize,
}

impl<W: Write + Send> Writer<W> {
    /// With names and values in the file's metadata.
    pub(super) fn start(out: W, columns: Vec<Column>, metadata: Vec<(&str, String)>) -> Result<Self> {
        let fields = columns.iter().map(field).collect::<Result<Vec<_>>>()?;
        let schema = Type::group_type_builder("runs").with_fields(fields).build()?;
        let metadata =
            metadata.into_iter().map(|(key, value)| KeyValue::new(key.to_owned(), value)).collect();
        let properties = WriterProperties::builder()
            .set_created_by(format!("uchain {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(metadata))
            // Every digest is another one: a dictionary of them is only longer.
            .set_column_dictionary_enabled(ColumnPath::from("digest"), false)
            .build();
        let file = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
        Ok(Self { file, columns, rows: Vec::new(), entries: 0 })
    }

    pub(super) fn row(&mut self, row: Vec<Cell>) -> Result<()> {
        let lists = row.iter().map(|cell| if let Cell::Numbers(list) = cell { list.len() } else { 0 });
        self.entries += lists.sum::<usize>();
        self.rows.push(row);
        let is_full = self.rows.len() >= GROUP_ROWS || self.entries >= GROUP_ENTRIES;
        if is_full { self.group() } else { Ok(()) }
    }

    pub(super) fn finish(mut self) -> Result<()> {
        if !self.rows.is_empty() {
            self.group()?;
        }
        self.file.finish().map(drop)
    }

    fn group(&mut self) -> Result<()> {
        let rows = std::mem::take(&mut self.rows);
        self.entries = 0;
        let mut group = self.file.next_row_group()?;
        for (index, column) in self.columns.iter().enumerate() {
            let Some(mut writer) = group.next_column()? else { break };
            let cells = || rows.iter().map(|row| row.get(index).unwrap_or(&Cell::Absent));
            match column.kind {
                Kind::Count => scalars::<Int64Type>(&mut writer, cells().map(count)),
                Kind::Number => scalars::<DoubleType>(&mut writer, cells().map(Cell::number)),
                Kind::Single => scalars::<FloatType>(&mut writer, cells().map(|c| Some(c.number()? as f32))),
                Kind::Text => scalars::<ByteArrayType>(&mut writer, cells().map(|c| Some(c.text()?.into()))),
                Kind::Numbers => lists::<DoubleType>(writer.typed(), cells(), |number| number),
                Kind::Singles => lists::<FloatType>(writer.typed(), cells(), |number| number as f32),
            }?;
            writer.close()?;
        }
        group.close().map(drop)
    }
}

fn count(cell: &Cell) -> Option<i64> {
    if let Cell::Count(count) = cell { Some(*count) } else { None }
}

fn scalars<T: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<()> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    for cell in cells {
        levels.push(i16::from(cell.is_some()));
        values.extend(cell);
    }
    writer.typed::<T>().write_batch(&values, Some(&levels), None).map(drop)
}

/// Levels: 0 no list, 1 a list without entries, 2 an absent entry, 3 an entry.
fn lists<'c, T: DataType>(
    writer: &mut ColumnWriterImpl<'_, T>,
    cells: impl Iterator<Item = &'c Cell>,
    value: impl Fn(f64) -> T::T,
) -> Result<()> {
    let (mut values, mut levels, mut repeats) = (Vec::new(), Vec::new(), Vec::new());
    for cell in cells {
        let Cell::Numbers(list) = cell else {
            levels.push(0);
            repeats.push(0);
            continue;
        };
        if list.is_empty() {
            levels.push(1);
            repeats.push(0);
        }
        for (place, entry) in list.iter().enumerate() {
            levels.push(if entry.is_some() { 3 } else { 2 });
            repeats.push(i16::from(place > 0));
            values.extend(entry.map(&value));
        }
    }
    writer.write_batch(&values, Some(&levels), Some(&repeats)).map(drop)
}

/// A table that was written.
pub(super) struct Table {
    file: SerializedFileReader<File>,
    names: Vec<String>,
}

impl Table {
    pub(super) fn open(path: &Path) -> std::result::Result<Self, FolderError> {
        let file = File::open(path).map_err(FolderError::io(path, "read"))?;
        let file = SerializedFileReader::new(file).map_err(|error| damaged(path, &error))?;
        let fields = file.metadata().file_metadata().schema().get_fields();
        let names = fields.iter().map(|field| field.name().to_owned()).collect();
        Ok(Self { file, names })
    }

    /// Number of row groups.
    pub(super) fn groups(&self) -> usize {
        self.file.num_row_groups()
    }

    /// One cell of a column of scalars.
    pub(super) fn cell(&self, column: &Column, row: u64) -> Result<Cell> {
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

    /// The cells of a column of scalars in a row group.
    pub(super) fn cells(&self, column: &Column, group: usize) -> Result<Vec<Cell>> {
        let place = self.names.iter().position(|name| *name == column.name);
        let place = place.and_then(|field| self.leaf(field));
        let place =
            place.ok_or_else(|| ParquetError::General(format!("it has no column {}", column.name)))?;
        let group = self.file.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0).min(GROUP_ROWS);
        let reader = group.get_column_reader(place)?;
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
            _ => Err(ParquetError::General(format!("its column {} is of another type", column.name))),
        }
    }

    /// The leaf that is this field, a scalar.
    fn leaf(&self, field: usize) -> Option<usize> {
        let schema = self.file.metadata().file_metadata().schema_descr();
        (0..schema.num_columns()).find(|leaf| schema.get_column_root_idx(*leaf) == field)
    }
}

fn text_of(bytes: &ByteArray) -> Cell {
    Cell::Text(String::from_utf8_lossy(bytes.data()).into_owned())
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

/// For `map_err`.
pub(super) fn damaged(path: &Path, error: &ParquetError) -> FolderError {
    let remedy = "remove it and fly the sweep again";
    FolderError::Damaged { file: path.to_owned(), why: error.to_string(), remedy }
}

/// For `map_err`: the system's own words, if it was the system.
pub(super) fn cannot_write(path: &Path, error: ParquetError) -> FolderError {
    let cause = match error {
        ParquetError::External(cause) => match cause.downcast::<std::io::Error>() {
            Ok(cause) => *cause,
            Err(cause) => std::io::Error::other(cause),
        },
        other => std::io::Error::other(other),
    };
    FolderError::io(path, "write")(cause)
}
