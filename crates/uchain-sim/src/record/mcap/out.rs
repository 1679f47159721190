//! mcap's writer, with messages typed by foxglove.

use std::{
    borrow::Cow,
    collections::BTreeMap,
    io::{self, Write},
};

use foxglove::Encode;
use mcap::{
    Attachment, McapError, WriteOptions, Writer,
    records::{MessageHeader, Metadata},
    write::NoSeek,
};
use prost::Message;

use crate::{
    clock::TICK_NS,
    map::Map,
    record::{
        RecordError,
        mcap::{
            about::{self, About},
            schema,
        },
    },
};

/// Target size of a chunk (bytes): what a run that is killed may lose.
const CHUNK_BYTES: u64 = 1 << 16;

/// The number of a channel.
#[derive(Debug, Clone, Copy)]
pub struct Channel(u16);

/// An MCAP file under way.
pub struct Out<W: Write> {
    /// Chunks are held in memory until they are full: what is in the file is whole, and nothing seeks.
    writer: Writer<NoSeek<W>>,
    /// Messages so far; a reader sees by it that none is missing.
    sequence: u32,
    buffer: Vec<u8>,
    own_schemas: Vec<u8>,
}

impl<W: Write> Out<W> {
    /// Begins a file: what a recording is of, and the walls. Messages of our own are described by `proto`.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn begin(to: W, about: &About, map: &Map, proto: &str) -> Result<Self, RecordError> {
        let mut out = Self::new(to, proto)?;
        out.metadata(about::METADATA, about.entries())?;
        out.attachment(about::WALLS, "text/csv", Cow::Owned(about::walls_to_csv(map).into_bytes()))?;
        Ok(out)
    }

    fn new(to: W, proto: &str) -> Result<Self, RecordError> {
        let options = WriteOptions::new()
            .library(concat!("uchain ", env!("CARGO_PKG_VERSION")))
            .compression(None)
            .chunk_size(Some(CHUNK_BYTES))
            .disable_seeking(true);
        let writer = options.create(NoSeek::new(to)).map_err(plain)?;
        Ok(Self { writer, sequence: 0, buffer: Vec::new(), own_schemas: schema::descriptors(proto) })
    }

    fn metadata(&mut self, name: &str, metadata: BTreeMap<String, String>) -> Result<(), RecordError> {
        self.writer.write_metadata(&Metadata { name: name.to_owned(), metadata }).map_err(plain)
    }

    fn attachment(&mut self, name: &str, media_type: &str, data: Cow<'_, [u8]>) -> Result<(), RecordError> {
        let (name, media_type) = (name.to_owned(), media_type.to_owned());
        self.writer.attach(&Attachment { log_time: 0, create_time: 0, name, media_type, data }).map_err(plain)
    }

    /// A channel of one of foxglove's messages.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn channel<M: Encode>(&mut self, topic: &str) -> Result<Channel, RecordError> {
        let schema = match M::get_schema() {
            Some(schema) => self.writer.add_schema(&schema.name, &schema.encoding, &schema.data),
            None => Ok(0),
        };
        self.add(topic, schema.map_err(plain)?)
    }

    /// A channel of one of our own messages.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn own_channel(&mut self, topic: &str, message: &str) -> Result<Channel, RecordError> {
        let name = format!("{}.{message}", schema::PACKAGE);
        let schema = self.writer.add_schema(&name, "protobuf", &self.own_schemas).map_err(plain)?;
        self.add(topic, schema)
    }

    fn add(&mut self, topic: &str, schema: u16) -> Result<Channel, RecordError> {
        self.writer.add_channel(schema, topic, "protobuf", &BTreeMap::new()).map(Channel).map_err(plain)
    }

    /// Writes a message.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn send(&mut self, channel: Channel, tick: u64, message: &impl Message) -> Result<(), RecordError> {
        self.write(channel, tick, |buffer| message.encode_raw(buffer))
    }

    /// Writes a message that encodes itself.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn write(
        &mut self,
        channel: Channel,
        tick: u64,
        encode: impl FnOnce(&mut Vec<u8>),
    ) -> Result<(), RecordError> {
        self.buffer.clear();
        encode(&mut self.buffer);
        let time_ns = tick.saturating_mul(TICK_NS);
        let header = MessageHeader {
            channel_id: channel.0,
            sequence: self.sequence,
            log_time: time_ns,
            publish_time: time_ns,
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, &self.buffer).map_err(plain)
    }

    /// Closes the chunk and hands all there is to the writer below.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.writer.flush().map_err(plain)
    }

    /// Ends the recording with its index and hands the writer back.
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

/// What the system said, or what mcap did.
fn plain(error: McapError) -> RecordError {
    match error {
        McapError::Io(error) => RecordError::Io(error),
        error => RecordError::Io(io::Error::other(error.to_string())),
    }
}
