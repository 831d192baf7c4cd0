//! The line of a table on which a row stands.

/// What begins a remark.
pub(super) const REMARK: u8 = b'#';

/// Lines of a table, counted as an editor does.
///
/// The reader's own place of a row lies before what parts it from the row above: the rest of a line end, blank lines and remarks.
pub(super) struct RowLines<'a> {
    bytes: &'a [u8],
    counted: usize,
    line: u64,
    has_remarks: bool,
}

impl<'a> RowLines<'a> {
    /// Of a table without its byte order mark.
    pub fn of(bytes: &'a [u8], has_remarks: bool) -> Self {
        Self { bytes, counted: 0, line: 1, has_remarks }
    }

    /// The line of the row that the reader places here, from 1; rows are asked for in their order.
    pub fn at(&mut self, position: Option<&csv::Position>) -> u64 {
        let from = position.map_or(0, |position| position.byte() as usize).min(self.bytes.len());
        let begin = self.begin(from).max(self.counted);
        self.line += ends(&self.bytes[self.counted..begin]);
        self.counted = begin;
        self.line
    }

    /// Where the first row at or behind a place begins.
    fn begin(&self, from: usize) -> usize {
        let mut at = from;
        while let Some(byte) = self.bytes.get(at) {
            match byte {
                b'\r' | b'\n' => at += 1,
                &REMARK if self.has_remarks => at += self.bytes[at..].iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(1),
                _ => break,
            }
        }
        at
    }
}

/// How many lines end here; a carriage return with a line feed behind it is one end.
fn ends(bytes: &[u8]) -> u64 {
    let ends = |(at, byte): &(usize, &u8)| **byte == b'\n' || **byte == b'\r' && bytes.get(at + 1) != Some(&b'\n');
    bytes.iter().enumerate().filter(ends).count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_rows_stand_on_the_lines_of_an_editor() {
        for ends in ["\n", "\r\n"] {
            let text = ["a,b", "1,2", "", "# remark", "3,4", "", "", "5,6"].join(ends);
            assert_eq!(lines(&text), [2, 5, 8], "{ends:?}");
        }
        assert_eq!(lines("a,b\r1,2\r3,4"), [2, 3]);
    }

    fn lines(text: &str) -> Vec<u64> {
        let mut reader = csv::ReaderBuilder::new().comment(Some(REMARK)).from_reader(text.as_bytes());
        let (mut row, mut found) = (csv::ByteRecord::new(), RowLines::of(text.as_bytes(), true));
        std::iter::from_fn(|| reader.read_byte_record(&mut row).expect("reads").then(|| found.at(row.position()))).collect()
    }
}
