//! Writing the table.

use std::{io::Write, sync::Arc};

use bytes::Bytes;
use parquet::{
    basic::{LogicalType, Repetition, Type as Physical},
    column::writer::{ColumnWriter, get_column_writer, get_typed_column_writer_mut},
    data_type::{ByteArrayType, DataType, DoubleType, FloatType, Int64Type},
    file::{metadata::KeyValue, properties::WriterProperties, writer::SerializedFileWriter},
    schema::types::{ColumnPath, Type, TypePtr},
};

use super::{GROUP_ENTRIES, GROUP_ROWS, Result, pages::Pages};
use crate::analyse::{Cell, Column, Kind};

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
pub(in crate::sweep) struct Writer<W: Write + Send> {
    file: SerializedFileWriter<W>,
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    entries: usize,
}

impl<W: Write + Send> Writer<W> {
    /// With names and values in the file's metadata.
    pub(in crate::sweep) fn start(
        out: W,
        columns: Vec<Column>,
        metadata: Vec<(&str, String)>,
    ) -> Result<Self> {
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

    pub(in crate::sweep) fn row(&mut self, row: Vec<Cell>) -> Result<()> {
        let lists = row.iter().map(|cell| if let Cell::Numbers(list) = cell { list.len() } else { 0 });
        self.entries += lists.sum::<usize>();
        self.rows.push(row);
        let is_full = self.rows.len() >= GROUP_ROWS || self.entries >= GROUP_ENTRIES;
        if is_full { self.group() } else { Ok(()) }
    }

    pub(in crate::sweep) fn finish(mut self) -> Result<()> {
        if !self.rows.is_empty() {
            self.group()?;
        }
        self.file.finish().map(drop)
    }

    fn group(&mut self) -> Result<()> {
        let rows = std::mem::take(&mut self.rows);
        self.entries = 0;
        // Every column is one leaf of the schema.
        let leaves = self.file.schema_descr().columns().to_vec();
        let properties = self.file.properties().clone();
        let mut group = self.file.next_row_group()?;
        for (index, (column, leaf)) in self.columns.iter().zip(leaves).enumerate() {
            let mut pages = Vec::new();
            let to = Box::new(Pages(&mut pages));
            let mut writer = get_column_writer(leaf, properties.clone(), to);
            let cells = || rows.iter().map(|row| row.get(index).unwrap_or(&Cell::Absent));
            match column.kind {
                Kind::Count => scalars::<Int64Type>(&mut writer, cells().map(count)),
                Kind::Number => scalars::<DoubleType>(&mut writer, cells().map(Cell::number)),
                Kind::Single => scalars::<FloatType>(&mut writer, cells().map(|c| Some(c.number()? as f32))),
                Kind::Text => scalars::<ByteArrayType>(&mut writer, cells().map(|c| Some(c.text()?.into()))),
                Kind::Numbers => lists::<DoubleType>(&mut writer, cells(), |number| number),
                Kind::Singles => lists::<FloatType>(&mut writer, cells(), |number| number as f32),
            }?;
            let closed = writer.close()?;
            group.append_column(&Bytes::from(pages), closed)?;
        }
        group.close().map(drop)
    }
}

fn count(cell: &Cell) -> Option<i64> {
    if let Cell::Count(count) = cell { Some(*count) } else { None }
}

fn scalars<T: DataType>(
    writer: &mut ColumnWriter<'_>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<()> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    for cell in cells {
        levels.push(i16::from(cell.is_some()));
        values.extend(cell);
    }
    get_typed_column_writer_mut::<T>(writer).write_batch(&values, Some(&levels), None).map(drop)
}

/// Levels: 0 no list, 1 a list without entries, 2 an absent entry, 3 an entry.
fn lists<'c, T: DataType>(
    writer: &mut ColumnWriter<'_>,
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
    get_typed_column_writer_mut::<T>(writer).write_batch(&values, Some(&levels), Some(&repeats)).map(drop)
}
