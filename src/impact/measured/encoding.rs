//! The encoding of a table's text.

use super::malformed::{Fault, SourcePosition};

/// Text without the mark of its encoding: ASCII, UTF-8, or an encoding that has the same commas and digits.
pub(super) fn plain(bytes: &[u8]) -> Result<&[u8], (SourcePosition, Fault)> {
    match utf_16(bytes) {
        Some(encoding) => Err((SourcePosition::Whole, Fault::Encoding { encoding })),
        None => Ok(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
    }
}

/// By its mark, or by the zero beside each of the first two letters.
fn utf_16(bytes: &[u8]) -> Option<&'static str> {
    let zero = bytes.first_chunk::<4>().map(|first| first.map(|byte| byte == 0));
    match (bytes, zero) {
        ([0xff, 0xfe, ..], _) => Some("UTF-16 (little-endian)"),
        ([0xfe, 0xff, ..], _) => Some("UTF-16 (big-endian)"),
        (_, Some([false, true, false, true])) => Some("UTF-16 (little-endian, without a mark)"),
        (_, Some([true, false, true, false])) => Some("UTF-16 (big-endian, without a mark)"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_utf_16_is_known_with_and_without_its_mark() {
        let bytes = |mark: &str, order: fn(u16) -> [u8; 2]| format!("{mark}trial,x").encode_utf16().flat_map(order).collect::<Vec<u8>>();
        for (mark, order, name) in [
            ("\u{feff}", u16::to_le_bytes as fn(u16) -> [u8; 2], "UTF-16 (little-endian)"),
            ("\u{feff}", u16::to_be_bytes, "UTF-16 (big-endian)"),
            ("", u16::to_le_bytes, "UTF-16 (little-endian, without a mark)"),
            ("", u16::to_be_bytes, "UTF-16 (big-endian, without a mark)"),
        ] {
            assert_eq!(plain(&bytes(mark, order)), Err((SourcePosition::Whole, Fault::Encoding { encoding: name })));
        }
        assert_eq!(plain("\u{feff}trial".as_bytes()), Ok(&b"trial"[..]));
        assert_eq!(plain(b"\0\0\0\0"), Ok(&b"\0\0\0\0"[..]));
    }
}
