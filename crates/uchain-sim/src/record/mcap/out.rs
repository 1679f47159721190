//! Messages of foxglove's types and of our own, encoded and handed to a sink.

use foxglove::Encode;
use prost::Message;

use crate::{
    clock::TICK_NS,
    map::Map,
    record::{
        Channel, RecordError, Schema, Sink,
        mcap::{
            Described,
            about::{self, About},
            schema,
        },
    },
};

/// What encoding takes, kept from message to message.
pub(super) struct Encoding {
    buffer: Vec<u8>,
    own_schemas: Vec<u8>,
}

impl Encoding {
    /// For messages of our own that `proto` describes.
    pub(super) fn of(proto: &str) -> Self {
        Self { buffer: Vec::new(), own_schemas: schema::descriptors(schema::FILE, proto) }
    }
}

/// Encodes what a recording says, and hands it to wherever it goes.
pub struct Out<'s> {
    sink: &'s mut dyn Sink,
    encoding: &'s mut Encoding,
}

impl<'s> Out<'s> {
    pub(super) fn new(sink: &'s mut dyn Sink, encoding: &'s mut Encoding) -> Self {
        Self { sink, encoding }
    }

    /// What a recording is of, and the walls.
    pub(super) fn begin(&mut self, about: &About, map: &Map) -> Result<(), RecordError> {
        self.sink.metadata(about::METADATA, &about.entries())?;
        self.sink.attachment(about::WALLS, "text/csv", about::walls_to_csv(map).as_bytes())
    }

    /// A channel of one of foxglove's messages.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn channel<M: Encode>(&mut self, topic: &str) -> Result<Channel, RecordError> {
        let schema = M::get_schema();
        let schema = schema.as_ref();
        let schema = schema.map(|it| Schema { name: &it.name, encoding: &it.encoding, data: &it.data });
        self.sink.channel(topic, schema)
    }

    /// A channel of one of our own messages.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn own_channel(&mut self, topic: &str, message: &str) -> Result<Channel, RecordError> {
        let name = format!("{}.{message}", schema::PACKAGE);
        let schema = Schema { name: &name, encoding: "protobuf", data: &self.encoding.own_schemas };
        self.sink.channel(topic, Some(schema))
    }

    /// A channel of one of our own messages that brings a description of its own.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn described_channel(&mut self, topic: &str, described: &Described) -> Result<Channel, RecordError> {
        let name = format!("{}.{}", schema::PACKAGE, described.message);
        let data = schema::descriptors(described.file, described.proto);
        self.sink.channel(topic, Some(Schema { name: &name, encoding: "protobuf", data: &data }))
    }

    /// Says a message, at the end of a tick.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn send(&mut self, channel: Channel, tick: u64, message: &impl Message) -> Result<(), RecordError> {
        self.write(channel, tick, |buffer| message.encode_raw(buffer))
    }

    /// Says a message that encodes itself, at the end of a tick.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn write(
        &mut self,
        channel: Channel,
        tick: u64,
        encode: impl FnOnce(&mut Vec<u8>),
    ) -> Result<(), RecordError> {
        let buffer = &mut self.encoding.buffer;
        buffer.clear();
        encode(buffer);
        self.sink.message(channel, tick.saturating_mul(TICK_NS), buffer)
    }
}
