//! mcap's writer as a sink.

use std::{
    borrow::Cow,
    collections::BTreeMap,
    io::{self, Write},
};

use mcap::{
    Attachment, McapError, WriteOptions, Writer,
    records::{MessageHeader, Metadata},
    write::NoSeek,
};

use crate::record::{Channel, RecordError, Schema, Sink};

/// Target size of a chunk (bytes): what a run that is killed may lose.
const CHUNK_BYTES: u64 = 1 << 16;

/// An MCAP file under way, to anything that takes bytes: a file, a `Vec`, a `TcpStream`. Chunks are held in memory until
/// they are full, 64 KiB: what has been written is whole, and nothing seeks. Whoever reads a stream while it is written is
/// behind by a chunk at most.
pub struct McapWriter<W: Write> {
    writer: Writer<NoSeek<W>>,
    /// Messages so far; a reader sees by it that none is missing.
    sequence: u32,
}

impl<W: Write> std::fmt::Debug for McapWriter<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("McapWriter").field("sequence", &self.sequence).finish_non_exhaustive()
    }
}

impl<W: Write> McapWriter<W> {
    /// Begins a file.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn begin(to: W) -> Result<Self, RecordError> {
        let options = WriteOptions::new()
            .library(concat!("uchain ", env!("CARGO_PKG_VERSION")))
            .compression(None)
            .chunk_size(Some(CHUNK_BYTES))
            .disable_seeking(true);
        let writer = options.create(NoSeek::new(to)).map_err(plain)?;
        Ok(Self { writer, sequence: 0 })
    }

    /// Ends the file with its index and hands back what it was written to. Without this it is readable as well, but
    /// counts as cut short.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn finish(mut self) -> Result<W, RecordError> {
        self.writer.finish().map_err(plain)?;
        let mut to = self.writer.into_inner().into_inner();
        to.flush()?;
        Ok(to)
    }
}

impl<W: Write> Sink for McapWriter<W> {
    fn metadata(&mut self, name: &str, entries: &BTreeMap<String, String>) -> Result<(), RecordError> {
        let (name, metadata) = (name.to_owned(), entries.clone());
        self.writer.write_metadata(&Metadata { name, metadata }).map_err(plain)
    }

    fn attachment(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), RecordError> {
        let (name, media_type, data) = (name.to_owned(), media_type.to_owned(), Cow::Borrowed(data));
        self.writer.attach(&Attachment { log_time: 0, create_time: 0, name, media_type, data }).map_err(plain)
    }

    fn channel(&mut self, topic: &str, schema: Option<Schema<'_>>) -> Result<Channel, RecordError> {
        let schema = match schema {
            Some(Schema { name, encoding, data }) => self.writer.add_schema(name, encoding, data),
            None => Ok(0),
        };
        let added = self.writer.add_channel(schema.map_err(plain)?, topic, "protobuf", &BTreeMap::new());
        added.map(Channel).map_err(plain)
    }

    fn message(&mut self, channel: Channel, time_ns: u64, message: &[u8]) -> Result<(), RecordError> {
        let header = MessageHeader {
            channel_id: channel.0,
            sequence: self.sequence,
            log_time: time_ns,
            publish_time: time_ns,
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, message).map_err(plain)
    }

    fn flush(&mut self) -> Result<(), RecordError> {
        self.writer.flush().map_err(plain)
    }
}

/// What the system said, or what mcap did.
fn plain(error: McapError) -> RecordError {
    match error {
        McapError::Io(error) => RecordError::Io(error),
        error => RecordError::Io(io::Error::other(error.to_string())),
    }
}
