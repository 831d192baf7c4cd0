//! The table of a study as Apache Parquet, with the feature `parquet`.

use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::axis::{Axis, Input};
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
            Axis::Number(_) | Axis::Listed(_) | Axis::Stated(_) => column::<DoubleType>(&mut group, of_axis.map(number))?,
        }
    }
    for (at, of) in study.columns.iter().enumerate() {
        let figures = rows.iter().map(|row| outcomes.figure(*row, at));
        match of.words() {
            Some(_) => column::<ByteArrayType>(&mut group, figures.map(|figure| of.word(figure?).map(ByteArray::from)))?,
            None => column::<DoubleType>(&mut group, figures)?,
        }
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
    for column in &study.columns {
        fields.push(if column.words().is_some() { text(column.name())? } else { number(column.name())? });
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

#[cfg(test)]
mod tests {
    use std::io::Write;

    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;
    use crate::params::files::Memory;

    fn study(text: &str) -> Study {
        let files = Memory([("s.toml".into(), text.as_bytes().to_vec())].into_iter().collect());
        super::super::plan_file::load("s.toml", &files).expect("is a plan")
    }

    /// The table as the crate reads it back: names, and the fields of each row.
    fn read(bytes: &[u8]) -> (Vec<String>, Vec<Vec<Field>>) {
        let mut file = tempfile::tempfile().expect("a file");
        file.write_all(bytes).expect("can be written");
        let reader = SerializedFileReader::new(file).expect("is a table");
        let names = reader.metadata().file_metadata().schema().get_fields().iter().map(|field| field.name().to_string()).collect();
        let rows = reader.get_row_iter(None).expect("has rows").map(|row| row.expect("a row").into_columns());
        (names, rows.map(|row| row.into_iter().map(|(_, field)| field).collect()).collect())
    }

    #[test]
    fn analytic_the_table_reads_back_with_names_types_and_what_is_missing() {
        let study = study(
            "samples = 9\nmeasures = [\"mass\", \"peak\"]\n[vary]\ncage_rod = [150, 150]\n[choose]\nbought.rod = [\"rod-carbon-3\"]\n",
        );
        let mut outcomes = Outcomes::none(9);
        outcomes.learn(2, Outcome::Figures(vec![Some(230.5), None]));
        outcomes.learn(7, Outcome::Refused("it is too \u{e9}troit".into()));
        let (names, rows) = read(&parquet(&study, &outcomes).expect("can be written"));
        assert_eq!(names, ["row", "rods.cage_rod_length_mm", "bought.rod", "mass", "peak", "refused"]);
        let text = |text: &str| Field::Str(text.into());
        let (rod, length) = (text("rod-carbon-3"), Field::Double(150.0));
        let known = vec![Field::Long(2), length.clone(), rod.clone(), Field::Double(230.5), Field::Null, Field::Null];
        assert_eq!(rows, [known, vec![Field::Long(7), length, rod, Field::Null, Field::Null, text("it is too \u{e9}troit")]]);
    }

    #[test]
    fn analytic_words_are_texts_and_a_row_without_a_strength_has_none() {
        let plan = "kind = \"recovery\"\nmeasures = [\"verdict\", \"weight\"]\neffects = [\"preload\"]\nstrengths = [5]\n[seeds]\nnothing = [1, 2]\none = [1, 2]\n";
        let study = study(plan);
        let mut outcomes = Outcomes::none(2);
        outcomes.learn(0, Outcome::Figures(vec![Some(3.0), None]));
        outcomes.learn(1, Outcome::Figures(vec![Some(0.0), Some(0.75)]));
        let (names, rows) = read(&parquet(&study, &outcomes).expect("can be written"));
        assert_eq!(names, ["row", "level", "law", "truth", "strength", "seed", "verdict", "weight", "refused"]);
        let text = |text: &str| Field::Str(text.into());
        assert_eq!(rows[0][3..8], [text("nothing"), Field::Null, Field::Double(1.0), text("nothing_missing"), Field::Null]);
        assert_eq!(rows[1][3..8], [text("preload"), Field::Double(5.0), Field::Double(1.0), text("named"), Field::Double(0.75)]);
    }
}
