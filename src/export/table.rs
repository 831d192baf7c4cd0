//! A table as CSV.

use super::format::ExportError;

/// A table as the text of a CSV file (comma, quotes where needed, `\n`): the names of the columns, then the rows.
///
/// # Errors
/// When a row has not as many fields as there are columns; they name the file.
pub fn csv<Row: IntoIterator<Item: AsRef<[u8]>>>(
    file: &str,
    columns: impl IntoIterator<Item: AsRef<[u8]>>,
    rows: impl IntoIterator<Item = Row>,
) -> Result<String, ExportError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(columns).map_err(ExportError::of(file))?;
    for row in rows {
        table.write_record(row).map_err(ExportError::of(file))?;
    }
    let bytes = table.into_inner().map_err(|error| ExportError::of(file)(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A number as a field: an unknown one stays empty.
pub fn number(value: Option<f64>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}
