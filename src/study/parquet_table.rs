//! The table of a study as Apache Parquet, with the feature `parquet`.

use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::axis::{Axis, Input};
use super::column::Column;
use super::outcomes::{Outcome, Outcomes};
use super::plan::Study;

/// The rows that are known, with the columns of the CSV table: whole numbers, numbers and texts; what a frame does not have is null.
///
/// # Errors
/// When the table cannot be written.
pub fn parquet(study: &Study, outcomes: &Outcomes) -> Result<Vec<u8>, ParquetError> {
    let rows: Vec<usize> = (0..study.rows()).filter(|row| outcomes.of(*row).is_some()).collect();
    let properties = Arc::new(WriterProperties::builder().set_created_by("flexframe".into()).build());
    let mut file = SerializedFileWriter::new(Vec::new(), Arc::new(schema(study)?), properties)?;
    let mut group = file.next_row_group()?;
    column::<Int64Type>(&mut group, rows.iter().map(|row| Some(*row as i64)))?;
    let inputs: Vec<Vec<Input>> = rows.iter().map(|row| study.inputs(*row)).collect();
    for (at, axis) in study.axes.iter().enumerate() {
        let of_axis = inputs.iter().map(|row| &row[at]);
        match axis {
            Axis::Name { .. } => {
                column::<ByteArrayType>(&mut group, of_axis.map(|input| Some(ByteArray::from(input.field().into_bytes()))))?
            }
            Axis::Number(_) | Axis::Listed(_) => column::<DoubleType>(&mut group, of_axis.map(number))?,
        }
    }
    for at in 0..study.columns.len() {
        column::<DoubleType>(&mut group, rows.iter().map(|row| outcomes.figure(*row, at)))?;
    }
    let refused = |row: &usize| match outcomes.of(*row) {
        Some(Outcome::Refused(why)) => Some(ByteArray::from(why.as_bytes().to_vec())),
        _ => None,
    };
    column::<ByteArrayType>(&mut group, rows.iter().map(refused))?;
    group.close()?;
    file.into_inner()
}

fn number(input: &Input) -> Option<f64> {
    if let Input::Number(value) = input { Some(*value) } else { None }
}

/// Every column may be null.
fn schema(study: &Study) -> Result<Type, ParquetError> {
    let field = |name: String, physical: Physical, converted: ConvertedType| {
        let builder = Type::primitive_type_builder(&name, physical).with_repetition(Repetition::OPTIONAL);
        builder.with_converted_type(converted).build().map(Arc::new)
    };
    let text = |name: String| field(name, Physical::BYTE_ARRAY, ConvertedType::UTF8);
    let number = |name: String| field(name, Physical::DOUBLE, ConvertedType::NONE);
    let mut fields = vec![field("row".into(), Physical::INT64, ConvertedType::NONE)?];
    for axis in &study.axes {
        fields.push(if matches!(axis, Axis::Name { .. }) { text(axis.key())? } else { number(axis.key())? });
    }
    for name in study.columns.iter().map(Column::name) {
        fields.push(number(name)?);
    }
    fields.push(text("refused".into())?);
    Type::group_type_builder("study").with_fields(fields).build()
}

/// The next column: the values that there are, and for each row whether there is one.
fn column<T: parquet::data_type::DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let all: Vec<Option<T::T>> = values.collect();
    let levels: Vec<i16> = all.iter().map(|value| i16::from(value.is_some())).collect();
    let known: Vec<T::T> = all.into_iter().flatten().collect();
    let missing = || ParquetError::General("the schema has too few columns".into());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<T>().write_batch(&known, Some(&levels), None)?;
    column.close()
}
