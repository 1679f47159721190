//! A file of records: eight bytes that say what it is, then records, each with its length in front, so that a reader needs
//! room for one of them.

use crate::{Cause, Fault, VERSION};

/// Longest record (bytes).
pub const FRAME_MAX: usize = 2048;

/// Where bytes come from.
pub trait Input {
    /// Fills all of it with the next bytes.
    ///
    /// # Errors
    /// [`Short`]: there are not as many left.
    fn read(&mut self, into: &mut [u8]) -> Result<(), Short>;
}

/// There are fewer bytes left than were asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Short;

/// Where bytes go.
pub trait Output {
    /// Takes all of them.
    fn write(&mut self, bytes: &[u8]);
}

/// Bytes in memory.
impl Input for &[u8] {
    fn read(&mut self, into: &mut [u8]) -> Result<(), Short> {
        let (head, rest) = self.split_at_checked(into.len()).ok_or(Short)?;
        into.copy_from_slice(head);
        *self = rest;
        Ok(())
    }
}

/// Bytes in memory.
#[cfg(feature = "explore")]
impl Output for alloc::vec::Vec<u8> {
    fn write(&mut self, bytes: &[u8]) {
        self.extend_from_slice(bytes);
    }
}

/// Reads a file record by record.
#[derive(Debug)]
pub struct Frames<'a, I> {
    input: &'a mut I,
    buffer: [u8; FRAME_MAX],
    /// Bytes of the last record.
    length: usize,
    count: u32,
}

impl<'a, I: Input> Frames<'a, I> {
    /// A file that begins like this.
    ///
    /// # Errors
    /// [`Fault`]: it does not, or is of another version.
    pub fn open(input: &'a mut I, magic: [u8; 7]) -> Result<Self, Fault> {
        let fault = |cause| Fault { place: 0, cause };
        let mut head = [0; 8];
        input.read(&mut head).map_err(|Short| fault(Cause::Short))?;
        let [start @ .., got] = head;
        if start != magic {
            return Err(fault(Cause::Magic));
        }
        if got != VERSION {
            return Err(fault(Cause::Version { got }));
        }
        Ok(Self { input, buffer: [0; FRAME_MAX], length: 0, count: 0 })
    }

    /// Records read so far.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The next record.
    ///
    /// # Errors
    /// [`Fault`]: the file ends before it does, or it is too long.
    pub fn read(&mut self) -> Result<&[u8], Fault> {
        let place = self.count;
        let short = |Short| Fault { place, cause: Cause::Short };
        let mut length = [0; 2];
        self.input.read(&mut length).map_err(short)?;
        let bytes = u16::from_le_bytes(length);
        let record = match self.buffer.get_mut(..usize::from(bytes)) {
            Some(record) if bytes > 0 => record,
            _ => return Err(Fault { place, cause: Cause::Length { bytes } }),
        };
        self.input.read(record).map_err(short)?;
        self.count = self.count.saturating_add(1);
        self.length = record.len();
        Ok(self.last())
    }

    /// The last record that was read; nothing before the first.
    pub fn last(&self) -> &[u8] {
        self.buffer.get(..self.length).unwrap_or_default()
    }

    /// The last record has been read, and says that so many were before it.
    ///
    /// # Errors
    /// [`Fault`]: there were not as many, or the file goes on.
    pub fn end(self, written: u32) -> Result<(), Fault> {
        let place = self.count;
        if place != written.saturating_add(1) {
            return Err(Fault { place, cause: Cause::Count { written } });
        }
        match self.input.read(&mut [0]) {
            Ok(()) => Err(Fault { place, cause: Cause::Trailing }),
            Err(Short) => Ok(()),
        }
    }
}

/// Begins a file.
pub(crate) fn begin(output: &mut impl Output, magic: [u8; 7]) {
    output.write(&magic);
    output.write(&[VERSION]);
}

/// Writes one record, of [`FRAME_MAX`] bytes at most.
pub(crate) fn write(output: &mut impl Output, record: &[u8]) {
    debug_assert!(record.len() <= FRAME_MAX);
    output.write(&(record.len() as u16).to_le_bytes());
    output.write(record);
}
