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
        let row = row.into_iter().map(|field| without_formula(field.as_ref()));
        table.write_record(row).map_err(ExportError::of(file))?;
    }
    let bytes = table.into_inner().map_err(|error| ExportError::of(file)(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A field of one line that no spreadsheet computes: a text that begins like a formula gets an apostrophe in front. Numbers stay numbers.
fn without_formula(field: &[u8]) -> Vec<u8> {
    let begins = field.len() > 1 && matches!(field[0], b'=' | b'+' | b'-' | b'@' | b'\t' | b'\r');
    let is_number = || std::str::from_utf8(field).is_ok_and(|text| text.parse::<f64>().is_ok());
    let mark: &[u8] = if begins && !is_number() { b"'" } else { b"" };
    let line = field.iter().map(|byte| if matches!(byte, b'\n' | b'\r') { b' ' } else { *byte });
    mark.iter().copied().chain(line).collect()
}

/// A number as a field; an unknown one is empty.
pub fn number(value: Option<f64>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_no_text_of_a_table_is_a_formula() {
        let fields = ["=1+1", "+49", "-1.5e-3", "-", "@SUM(A1)", "-2+3", "\t=1", "\r=1", "a=b", "-inf", "", "=\"a\",b"];
        let text = csv("t.csv", fields.map(|_| "name"), [fields]).expect("can be written");
        let row = text.split_once('\n').expect("two lines").1;
        assert_eq!(row, "'=1+1,+49,-1.5e-3,-,'@SUM(A1),'-2+3,'\t=1,' =1,a=b,-inf,,\"'=\"\"a\"\",b\"\n");
    }
}
