//! From bytes to checked records. mcap's state machine cuts the file up and checks the two long checksums; chunks,
//! and everything with a length in it, are taken apart here, where no number is believed before it is checked.

use std::{collections::BTreeMap, io::Read, ops::Range};

use mcap::{
    McapError,
    records::op,
    sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions},
};
use uchain_core::bounded;

use super::{ReadError, bytes::Bytes};

/// Longest record that is read (bytes): room for a million walls.
pub(super) const MOST_RECORD_BYTES: usize = 1 << 26;
/// Bytes asked of the file at a time. What a damaged length promises takes no memory before it is there.
const READ_BYTES: usize = 1 << 16;
/// Opcode and length.
const HEADER_BYTES: u64 = 9;
/// The longest record whose inside mcap's state machine checks by itself.
const FOOTER_BYTES: u64 = 20;
/// From here on opcodes are free for anybody's own records.
const PRIVATE: u8 = 0x80;

/// How a file ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// With its index: the run that wrote it came to an end.
    Whole,
    /// In the middle: the run was killed, or is still flying; or the power went before the last bytes came to the disk,
    /// and the file ends in zeros.
    CutShort,
}

/// One record that a recording is made of.
pub(super) enum Item<'a> {
    Schema { id: u16, name: &'a str },
    Channel { id: u16, schema: u16, topic: &'a str },
    Message { channel: u16, time_ns: u64, data: &'a [u8] },
    Metadata { name: &'a str, entries: BTreeMap<String, String> },
    Attachment { name: &'a str, data: &'a [u8] },
    End(End),
}

/// The records of an MCAP file, in order, those within chunks included.
pub(super) struct Records<R> {
    input: R,
    reader: LinearReader,
    /// The present record of the file, and its opcode.
    record: Vec<u8>,
    opcode: u8,
    /// Where it begins, and where the next one does.
    at: u64,
    next_at: u64,
    /// If it is a chunk: where in it the next record begins.
    in_chunk: Option<usize>,
    /// Number of the next message.
    sequence: u32,
    data_ended: bool,
    /// Bytes read so far, and how many of them, at the end, are zeros.
    length: u64,
    zeros: u64,
    /// What is known to be a recording of ours is damaged where another file is somebody else's.
    is_ours: bool,
    end: Option<End>,
}

impl<R: Read> Records<R> {
    pub(super) fn new(input: R) -> Self {
        let options = LinearReaderOptions::default()
            .with_emit_chunks(true)
            .with_check_finishes_after_end_magic(true)
            .with_validate_data_section_crc(true)
            .with_validate_summary_section_crc(true)
            .with_record_length_limit(MOST_RECORD_BYTES);
        Self {
            input,
            reader: LinearReader::new_with_options(options),
            record: Vec::new(),
            opcode: 0,
            at: 0,
            next_at: mcap::MAGIC.len() as u64,
            in_chunk: None,
            sequence: 0,
            data_ended: false,
            length: 0,
            zeros: 0,
            is_ours: false,
            end: None,
        }
    }

    /// From here on the file is a recording of ours.
    pub(super) fn are_ours(&mut self) {
        self.is_ours = true;
    }

    /// Where the present record begins in the file (bytes).
    pub(super) fn byte(&self) -> u64 {
        self.at
    }

    /// Bytes read so far.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    fn damaged(&self, why: impl Into<String>) -> ReadError {
        ReadError::Damaged { byte: self.at, why: why.into() }
    }

    /// A record that others may write, and we do not.
    fn strange(&self, why: impl Into<String>) -> ReadError {
        let why = why.into();
        if self.is_ours { self.damaged(why) } else { ReadError::NotOurs { why } }
    }

    /// The next record; [`Item::End`] over and over at the end. Nothing is to be asked after an error.
    pub(super) fn next(&mut self) -> Result<Item<'_>, ReadError> {
        let mut found = match self.find() {
            Ok(found) => found,
            Err(error) => {
                self.unless_cut(error)?;
                None
            }
        };
        // Records within a chunk are what was written: the chunk's checksum says so. Others may be half zeros.
        let alone = found.clone().filter(|_| self.opcode != op::CHUNK);
        if let Some(error) = alone.and_then(|(opcode, body)| self.item(opcode, body).err()) {
            self.unless_cut(error)?;
            found = None;
        }
        match found {
            Some((opcode, body)) => self.item(opcode, body),
            None => Ok(Item::End(self.end.unwrap_or(End::CutShort))),
        }
    }

    /// An error is none if all that is left of the file is zeros: where the power goes while a file grows, some file
    /// systems leave it as long as it was to become, and what was not on the disk yet reads as zeros. It was cut short.
    /// Reads the file to its end.
    pub(super) fn unless_cut(&mut self, error: ReadError) -> Result<(), ReadError> {
        if matches!(error, ReadError::Io(_)) {
            return Err(error);
        }
        let mut bytes = vec![0; READ_BYTES];
        loop {
            let read = self.input.read(&mut bytes)?;
            if read == 0 {
                break;
            }
            self.zeros = zeros_at_end(self.zeros, bytes.get(..read).unwrap_or_default());
            self.length += read as u64;
        }
        let from = self.length - self.zeros;
        // A damaged header may hide a record as long as a footer behind it.
        let latest = match error {
            ReadError::NotMcap => 0,
            _ => self.next_at + HEADER_BYTES + FOOTER_BYTES,
        };
        if self.zeros > 0 && from <= latest {
            self.end = Some(End::CutShort);
            return Ok(());
        }
        Err(error)
    }

    /// Opcode and place of the next record that says something; `None` at the end.
    fn find(&mut self) -> Result<Option<(u8, Range<usize>)>, ReadError> {
        loop {
            if self.end.is_some() {
                return Ok(None);
            }
            let Some(from) = self.in_chunk else {
                self.load()?;
                continue;
            };
            // Within a chunk, or at the one record that stands alone.
            let (opcode, body, next) = match self.opcode {
                op::CHUNK => {
                    let rest = self.record.get(from..).unwrap_or_default();
                    if rest.is_empty() {
                        self.in_chunk = None;
                        continue;
                    }
                    let mut bytes = Bytes(rest);
                    let cut = || self.damaged("a record in the chunk is longer than the chunk");
                    let (opcode, length) = bytes.u8().zip(bytes.u64()).ok_or_else(cut)?;
                    let body = bytes.take(length).ok_or_else(cut)?;
                    let body_at = from + HEADER_BYTES as usize;
                    (opcode, body_at..body_at + body.len(), Some(body_at + body.len()))
                }
                opcode => (opcode, 0..self.record.len(), None),
            };
            self.in_chunk = next;
            if self.is_item(opcode)? {
                return Ok(Some((opcode, body)));
            }
        }
    }

    /// Reads the next record of the file.
    fn load(&mut self) -> Result<(), ReadError> {
        loop {
            let wanted = match self.reader.next_event() {
                None => {
                    self.end = Some(End::Whole);
                    return Ok(());
                }
                Some(Ok(LinearReadEvent::Record { opcode, data })) => {
                    self.record.clear();
                    self.record.extend_from_slice(data);
                    self.opcode = opcode;
                    self.at = self.next_at;
                    self.next_at += HEADER_BYTES + data.len() as u64;
                    self.in_chunk = Some(0);
                    break;
                }
                Some(Ok(LinearReadEvent::ReadRequest(wanted))) => bounded(wanted, 1, READ_BYTES),
                Some(Err(McapError::UnexpectedEof)) => {
                    self.end = Some(End::CutShort);
                    return Ok(());
                }
                Some(Err(error)) => return Err(self.refuse(error)),
            };
            let room = self.reader.insert(wanted);
            let read = self.input.read(room)?;
            self.zeros = zeros_at_end(self.zeros, room.get(..read).unwrap_or_default());
            self.reader.notify_read(read);
            self.length += read as u64;
        }
        if self.opcode == op::CHUNK { self.open_chunk() } else { Ok(()) }
    }

    fn refuse(&self, error: McapError) -> ReadError {
        let (byte, most) = (self.next_at, MOST_RECORD_BYTES as u64);
        match error {
            McapError::BadMagic if self.at == 0 => ReadError::NotMcap,
            McapError::RecordTooLarge { len, .. } => ReadError::TooLarge { byte, bytes: len, most },
            McapError::Io(error) => ReadError::Io(error),
            McapError::BadDataCrc { saved, calculated } | McapError::BadSummaryCrc { saved, calculated } => {
                let why =
                    format!("all that is before it has the checksum {calculated:08x}: expected {saved:08x}");
                ReadError::Damaged { byte, why }
            }
            error => ReadError::Damaged { byte, why: error.to_string() },
        }
    }

    /// Checks a chunk as a whole, before anything in it is believed.
    fn open_chunk(&mut self) -> Result<(), ReadError> {
        let mut bytes = Bytes(&self.record);
        let mut header = || {
            let _times = (bytes.u64()?, bytes.u64()?);
            let (length, crc) = (bytes.u64()?, bytes.u32()?);
            let (compression, packed) = (bytes.text()?, bytes.u64()?);
            Some((length, crc, compression, packed))
        };
        let (length, crc, compression, packed) =
            header().ok_or_else(|| self.damaged("the header of a chunk is cut off"))?;
        if !compression.is_empty() {
            let compression = compression.chars().take(16).collect();
            return Err(ReadError::Compressed { byte: self.at, compression });
        }
        let records = bytes.0.len() as u64;
        if length != records || packed != records {
            return Err(self.damaged(format!("a chunk of {records} bytes says it has {length} and {packed}")));
        }
        let found = crc32fast::hash(bytes.0);
        if crc == 0 && found != 0 && !self.is_ours {
            return Err(self.strange("its chunks have no checksums"));
        }
        if found != crc {
            return Err(self.damaged(format!("a chunk has the checksum {found:08x}: expected {crc:08x}")));
        }
        self.in_chunk = Some(self.record.len() - bytes.0.len());
        Ok(())
    }

    /// Whether a record is one that says something; an error for one that should not be where it is.
    fn is_item(&mut self, opcode: u8) -> Result<bool, ReadError> {
        let in_chunk = self.opcode == op::CHUNK;
        Ok(match opcode {
            // After the data, they are there again for an index.
            op::SCHEMA | op::CHANNEL if in_chunk || self.data_ended => in_chunk,
            op::MESSAGE if in_chunk => true,
            // No checksum covers them there, so we do not write them there.
            op::SCHEMA | op::CHANNEL | op::MESSAGE if !self.data_ended => {
                return Err(self.strange("messages or their schemas stand outside of chunks"));
            }
            op::METADATA | op::ATTACHMENT if !in_chunk && !self.data_ended => true,
            op::HEADER | op::MESSAGE_INDEX if !in_chunk && !self.data_ended => false,
            op::DATA_END if !in_chunk && !self.data_ended => {
                self.data_ended = true;
                false
            }
            op::CHUNK_INDEX
            | op::ATTACHMENT_INDEX
            | op::STATISTICS
            | op::METADATA_INDEX
            | op::SUMMARY_OFFSET
            | op::FOOTER
                if self.data_ended =>
            {
                false
            }
            PRIVATE.. => {
                return Err(
                    self.strange(format!("a record of kind 0x{opcode:02x} is nobody's but its writer's"))
                );
            }
            _ => return Err(self.damaged(format!("a record of kind 0x{opcode:02x} has no place here"))),
        })
    }

    fn item(&mut self, opcode: u8, body: Range<usize>) -> Result<Item<'_>, ReadError> {
        let whole = self.record.get(body).unwrap_or_default();
        let expected = self.sequence;
        let mut bytes = Bytes(whole);
        let mut item = || {
            Some(match opcode {
                op::SCHEMA => Item::Schema { id: bytes.u16()?, name: bytes.text()? },
                op::CHANNEL => Item::Channel { id: bytes.u16()?, schema: bytes.u16()?, topic: bytes.text()? },
                op::METADATA => Item::Metadata { name: bytes.text()?, entries: bytes.map()? },
                op::MESSAGE => {
                    let (channel, sequence) = (bytes.u16()?, bytes.u32()?);
                    let (time_ns, _published) = (bytes.u64()?, bytes.u64()?);
                    if sequence != expected {
                        return None;
                    }
                    self.sequence = sequence.wrapping_add(1);
                    Item::Message { channel, time_ns, data: bytes.0 }
                }
                _ => {
                    let _times = (bytes.u64()?, bytes.u64()?);
                    let (name, _media_type) = (bytes.text()?, bytes.text()?);
                    let length = bytes.u64()?;
                    let data = bytes.take(length)?;
                    let checked = whole.get(..whole.len().checked_sub(4)?)?;
                    let (crc, found) = (bytes.u32()?, crc32fast::hash(checked));
                    // Others may leave the checksum out.
                    let is_unchecked = crc == 0 && !self.is_ours;
                    if !(crc == found || is_unchecked) || !bytes.0.is_empty() {
                        return None;
                    }
                    Item::Attachment { name, data }
                }
            })
        };
        let found = item();
        found.ok_or_else(|| {
            let why = format!("the record of kind 0x{opcode:02x} is not whole, or not the next one");
            ReadError::Damaged { byte: self.at, why }
        })
    }
}

/// Zeros at the end of all that was read, after so many before.
fn zeros_at_end(before: u64, read: &[u8]) -> u64 {
    let zeros = read.iter().rev().take_while(|byte| **byte == 0).count();
    zeros as u64 + if zeros == read.len() { before } else { 0 }
}
