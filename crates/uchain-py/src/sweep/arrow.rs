//! Tables by the Arrow interface: ours for every data frame, and those of others as designs.

use std::sync::Arc;

use arrow_array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, ListArray, RecordBatch, RecordBatchReader,
    StringArray,
    cast::AsArray,
    types::{
        Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
        UInt32Type, UInt64Type,
    },
};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use pyo3::{exceptions::PyTypeError, prelude::*};
use pyo3_arrow::{PyRecordBatchReader, input::AnyRecordBatch};
use uchain_sim::{
    analyse::{Column, Kind},
    sweep::table::{Table, Values},
};

use super::design::{Texts, plain};

/// The columns of a table.
pub(super) fn schema(columns: &[Column]) -> SchemaRef {
    let list = |of: DataType| DataType::List(Arc::new(Field::new("item", of, true)));
    let field = |column: &Column| {
        let kind = match column.kind {
            Kind::Count => DataType::Int64,
            Kind::Number => DataType::Float64,
            Kind::Single => DataType::Float32,
            Kind::Text => DataType::Utf8,
            Kind::Numbers => list(DataType::Float64),
            Kind::Singles => list(DataType::Float32),
        };
        Field::new(&column.name, kind, true)
    };
    Arc::new(Schema::new(columns.iter().map(field).collect::<Vec<_>>()))
}

/// A table batch by batch: each is made when it is asked for.
struct Batches {
    table: Arc<Table>,
    schema: SchemaRef,
    next: usize,
}

impl Iterator for Batches {
    type Item = Result<RecordBatch, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        let block = self.table.blocks().get(self.next)?;
        self.next += 1;
        let arrays = block.values().iter().map(array).collect();
        Some(RecordBatch::try_new(self.schema.clone(), arrays))
    }
}

impl RecordBatchReader for Batches {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }
}

/// A stream of a table's batches.
pub(super) fn stream(table: &Arc<Table>) -> PyRecordBatchReader {
    let schema = schema(table.columns());
    PyRecordBatchReader::new(Box::new(Batches { table: table.clone(), schema, next: 0 }))
}

/// What is absent is NaN there, and null here.
fn array(values: &Values) -> ArrayRef {
    let number = |number: &f64| (!number.is_nan()).then_some(*number);
    let single = |number: &f32| (!number.is_nan()).then_some(*number);
    match values {
        Values::Counts(counts) => Arc::new(counts.iter().copied().collect::<Int64Array>()),
        Values::Numbers(numbers) => Arc::new(numbers.iter().map(number).collect::<Float64Array>()),
        Values::Singles(numbers) => {
            Arc::new(numbers.iter().map(single).collect::<arrow_array::Float32Array>())
        }
        Values::Texts(texts) => Arc::new(texts.iter().collect::<StringArray>()),
        Values::NumberLists(lists) => {
            let lists = lists.iter().map(|list| list.map(|list| list.iter().map(number)));
            Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(lists))
        }
        Values::SingleLists(lists) => {
            let lists = lists.iter().map(|list| list.map(|list| list.iter().map(single)));
            Arc::new(ListArray::from_iter_primitive::<Float32Type, _, _>(lists))
        }
        // There are no others.
        _ => Arc::new(arrow_array::NullArray::new(0)),
    }
}

/// Somebody's table as a design.
pub(super) fn texts(table: &Bound<'_, PyAny>) -> PyResult<Texts> {
    let reader = table.extract::<AnyRecordBatch>()?.into_reader()?;
    let schema = reader.schema();
    let mut texts = Texts::default();
    for field in schema.fields() {
        texts.keys.push(field.name().clone());
        texts.columns.push(Vec::new());
    }
    for batch in reader {
        let batch = batch.map_err(|error| PyTypeError::new_err(format!("design: {error}")))?;
        for (place, (field, column)) in schema.fields().iter().zip(batch.columns()).enumerate() {
            let cell = cells(column).ok_or_else(|| {
                PyTypeError::new_err(format!(
                    "design: {} is a column of {}; expected numbers, words, or true and false",
                    field.name(),
                    column.data_type()
                ))
            })?;
            for row in 0..column.len() {
                let text = if column.is_null(row) { String::new() } else { cell(row) };
                texts.push(place, text)?;
            }
        }
    }
    Ok(texts)
}

/// How to write a cell of an array, if that can be told.
fn cells(array: &ArrayRef) -> Option<Box<dyn Fn(usize) -> String + '_>> {
    macro_rules! numbers {
        ($kind:ty) => {{
            let array = array.as_primitive_opt::<$kind>()?;
            Some(Box::new(move |row| toml::Value::from(array.value(row)).to_string()))
        }};
    }
    let word = |text: &str| plain(&toml::Value::from(text).to_string());
    match array.data_type() {
        DataType::Int8 => numbers!(Int8Type),
        DataType::Int16 => {
            let array = array.as_primitive_opt::<Int16Type>()?;
            Some(Box::new(move |row| array.value(row).to_string()))
        }
        DataType::Int32 => numbers!(Int32Type),
        DataType::Int64 => numbers!(Int64Type),
        DataType::UInt8 => numbers!(UInt8Type),
        DataType::UInt16 => {
            let array = array.as_primitive_opt::<UInt16Type>()?;
            Some(Box::new(move |row| array.value(row).to_string()))
        }
        DataType::UInt32 => numbers!(UInt32Type),
        DataType::UInt64 => {
            let array = array.as_primitive_opt::<UInt64Type>()?;
            Some(Box::new(move |row| array.value(row).to_string()))
        }
        DataType::Float32 => numbers!(Float32Type),
        DataType::Float64 => numbers!(Float64Type),
        DataType::Boolean => {
            let array: &BooleanArray = array.as_boolean_opt()?;
            Some(Box::new(move |row| array.value(row).to_string()))
        }
        DataType::Utf8 => {
            let array = array.as_string_opt::<i32>()?;
            Some(Box::new(move |row| word(array.value(row))))
        }
        DataType::LargeUtf8 => {
            let array = array.as_string_opt::<i64>()?;
            Some(Box::new(move |row| word(array.value(row))))
        }
        DataType::Utf8View => {
            let array = array.as_string_view_opt()?;
            Some(Box::new(move |row| word(array.value(row))))
        }
        // Nothing but absent cells.
        DataType::Null => Some(Box::new(|_| String::new())),
        _ => None,
    }
}
