//! Pages with a checksum each: the parquet crate checks them where it reads, but leaves them out where it writes.

use parquet::{
    column::page::{CompressedPage, PageWriteSpec, PageWriter},
    errors::ParquetError,
    file::writer::{SerializedPageWriter, TrackedWrite},
};

use super::Result;

/// A number of 32 bits in the next field of a structure of Thrift's compact protocol.
const NEXT_I32: u8 = 0x15;
/// A step to the next field but one, and so on.
const STEP: u8 = 0x10;

/// The pages of a column, one after another.
pub(super) struct Pages<'a>(pub(super) &'a mut Vec<u8>);

impl PageWriter for Pages<'_> {
    fn write_page(&mut self, page: CompressedPage) -> Result<PageWriteSpec> {
        let (length, crc) = (page.data().len(), crc32fast::hash(page.data()));
        let mut sink = TrackedWrite::new(Vec::new());
        let mut spec = SerializedPageWriter::new(&mut sink).write_page(page)?;
        let written = sink.into_inner()?;
        let (header, data) = written
            .len()
            .checked_sub(length)
            .and_then(|end| written.split_at_checked(end))
            .ok_or_else(|| unknown_form("it is cut short"))?;
        let checked = with_crc(header, crc)?;
        let more = checked.len() - header.len();
        spec.offset = self.0.len() as u64;
        spec.compressed_size += more;
        spec.uncompressed_size += more;
        spec.bytes_written += more as u64;
        self.0.extend(checked);
        self.0.extend(data);
        Ok(spec)
    }

    fn close(&mut self) -> Result<()> {
        Ok(())
    }
}

/// Puts a checksum into a page's header, whose fields are 1: type, 2 and 3: lengths, 4: checksum (optional), 5 and more:
/// what the type asks for.
fn with_crc(header: &[u8], crc: u32) -> Result<Vec<u8>> {
    let mut rest = header;
    for field in 1..=3 {
        rest = match rest.split_first() {
            Some((&NEXT_I32, number)) => {
                let end = number.iter().position(|byte| byte & 0x80 == 0);
                end.and_then(|end| number.get(end + 1..)).ok_or_else(|| unknown_form("it is cut short"))?
            }
            _ => return Err(unknown_form(&format!("field {field} is not the next"))),
        };
    }
    let (next, after) = rest.split_first().ok_or_else(|| unknown_form("it is cut short"))?;
    if *next < 2 * STEP {
        return Err(unknown_form("it has a checksum already"));
    }
    let mut checked = header.get(..header.len() - rest.len()).unwrap_or_default().to_vec();
    checked.push(NEXT_I32);
    checked.extend(folded(crc.cast_signed()));
    checked.push(next - STEP);
    checked.extend(after);
    Ok(checked)
}

/// A signed number as Thrift writes it: the sign in the lowest bit, low seven bits first.
pub(super) fn folded(number: i32) -> Vec<u8> {
    let mut rest = ((number << 1) ^ (number >> 31)) as u32;
    let mut bytes = Vec::new();
    while rest >= 0x80 {
        bytes.push(rest as u8 | 0x80);
        rest >>= 7;
    }
    bytes.push(rest as u8);
    bytes
}

/// Another version of the crate might write another header.
fn unknown_form(why: &str) -> ParquetError {
    ParquetError::General(format!("the header of a page has no place for a checksum: {why}"))
}
