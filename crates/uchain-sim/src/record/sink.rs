//! Where what a recording says goes: into a file, over a socket, or into a list in memory.

use std::collections::BTreeMap;

use super::RecordError;

/// What describes the messages of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schema<'a> {
    /// The message's full name: `foxglove.Log`.
    pub name: &'a str,
    /// What `data` is written in: `protobuf` is a `FileDescriptorSet`.
    pub encoding: &'a str,
    /// The description.
    pub data: &'a [u8],
}

/// The number of a channel in the sink that gave it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Channel(pub u16);

/// Someone who takes what a recording says, message by message, in order. A run goes on when the sink has taken a
/// message: a sink that is slow, such as a socket whose peer reads slowly, slows the run down and loses nothing; one that
/// returns an error ends it.
///
/// [`McapWriter`](super::mcap::McapWriter) writes MCAP to anything that takes bytes, [`Messages`] keeps all in memory.
pub trait Sink {
    /// What a recording is of, under a name, before its first message.
    ///
    /// # Errors
    /// [`RecordError::Io`]: it cannot be taken.
    fn metadata(&mut self, name: &str, entries: &BTreeMap<String, String>) -> Result<(), RecordError>;

    /// A file that belongs to a recording, before its first message.
    ///
    /// # Errors
    /// [`RecordError::Io`]: it cannot be taken.
    fn attachment(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), RecordError>;

    /// A channel for messages of one kind; their bytes are protobuf. A topic is given once.
    ///
    /// # Errors
    /// [`RecordError::Io`]: it cannot be taken.
    fn channel(&mut self, topic: &str, schema: Option<Schema<'_>>) -> Result<Channel, RecordError>;

    /// A message at a simulated time (ns) on a channel of this sink. Times do not fall.
    ///
    /// # Errors
    /// [`RecordError::Io`]: it cannot be taken.
    fn message(&mut self, channel: Channel, time_ns: u64, message: &[u8]) -> Result<(), RecordError>;

    /// Hands on whatever is held back.
    ///
    /// # Errors
    /// [`RecordError::Io`]: it cannot be handed on.
    fn flush(&mut self) -> Result<(), RecordError>;
}

/// What a recording has said, one by one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Said {
    /// What it is of.
    Metadata {
        /// Its name.
        name: String,
        /// What it says.
        entries: BTreeMap<String, String>,
    },
    /// A file that belongs to it.
    Attachment {
        /// Its name.
        name: String,
        /// What is in it: `text/csv`.
        media_type: String,
        /// The file.
        data: Vec<u8>,
    },
    /// A channel; they are numbered from 0 in this order.
    Channel {
        /// Its topic.
        topic: String,
        /// Name, encoding and description of its messages.
        schema: Option<(String, String, Vec<u8>)>,
    },
    /// A message.
    Message {
        /// On which channel.
        channel: Channel,
        /// Simulated time (ns).
        time_ns: u64,
        /// The message in protobuf.
        data: Vec<u8>,
    },
    /// Whatever was held back was to be handed on.
    Flush,
}

/// All that a recording says, in memory and without a file format around it: some 35 kB per simulated second of a chain
/// of five.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::chain::{ChainTopics, Course}, record::{Messages, mcap::MessageRecorder}, run::run};
/// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=2".to_owned()]).unwrap();
/// let mut recorder = MessageRecorder::<_, ChainTopics>::start_in(Messages::default(), &course, 1).unwrap();
/// run(&course, 1, &mut recorder).unwrap();
/// let messages = recorder.into_sink();
/// let times_ns: Vec<u64> = messages.on("/frame").map(|(time_ns, _)| time_ns).collect();
/// assert_eq!((times_ns.len(), times_ns[0], times_ns[39]), (40, 50_000_000, 2_000_000_000));
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Messages {
    said: Vec<Said>,
    channels: u16,
}

impl Messages {
    /// All of it, in order.
    pub fn said(&self) -> &[Said] {
        &self.said
    }

    /// The topics, in the order of their channels.
    pub fn topics(&self) -> impl Iterator<Item = &str> {
        self.said.iter().filter_map(|said| match said {
            Said::Channel { topic, .. } => Some(topic.as_str()),
            _ => None,
        })
    }

    /// The messages of a topic, each with its simulated time (ns).
    pub fn on(&self, topic: &str) -> impl Iterator<Item = (u64, &[u8])> {
        let wanted = self.topics().position(|known| known == topic);
        self.said.iter().filter_map(move |said| match said {
            Said::Message { channel, time_ns, data } if wanted == Some(channel.0.into()) => {
                Some((*time_ns, data.as_slice()))
            }
            _ => None,
        })
    }

    /// Says all of it again, to another sink: an [`McapWriter`](super::mcap::McapWriter) comes to the bytes of the file.
    ///
    /// # Errors
    /// Those of the sink.
    pub fn repeat(&self, to: &mut dyn Sink) -> Result<(), RecordError> {
        let mut channels = Vec::new();
        for said in &self.said {
            match said {
                Said::Metadata { name, entries } => to.metadata(name, entries)?,
                Said::Attachment { name, media_type, data } => to.attachment(name, media_type, data)?,
                Said::Channel { topic, schema } => {
                    let schema =
                        schema.as_ref().map(|(name, encoding, data)| Schema { name, encoding, data });
                    channels.push(to.channel(topic, schema)?);
                }
                Said::Message { channel, time_ns, data } => {
                    // Messages came on channels that were given before them.
                    if let Some(&channel) = channels.get(usize::from(channel.0)) {
                        to.message(channel, *time_ns, data)?;
                    }
                }
                Said::Flush => to.flush()?,
            }
        }
        Ok(())
    }
}

impl Sink for Messages {
    fn metadata(&mut self, name: &str, entries: &BTreeMap<String, String>) -> Result<(), RecordError> {
        self.said.push(Said::Metadata { name: name.to_owned(), entries: entries.clone() });
        Ok(())
    }

    fn attachment(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), RecordError> {
        let (name, media_type) = (name.to_owned(), media_type.to_owned());
        self.said.push(Said::Attachment { name, media_type, data: data.to_owned() });
        Ok(())
    }

    fn channel(&mut self, topic: &str, schema: Option<Schema<'_>>) -> Result<Channel, RecordError> {
        let owned =
            |schema: Schema<'_>| (schema.name.to_owned(), schema.encoding.to_owned(), schema.data.to_owned());
        self.said.push(Said::Channel { topic: topic.to_owned(), schema: schema.map(owned) });
        let channel = Channel(self.channels);
        let next = self.channels.checked_add(1);
        self.channels = next.ok_or_else(|| std::io::Error::other("more than 65,535 channels"))?;
        Ok(channel)
    }

    fn message(&mut self, channel: Channel, time_ns: u64, message: &[u8]) -> Result<(), RecordError> {
        self.said.push(Said::Message { channel, time_ns, data: message.to_owned() });
        Ok(())
    }

    fn flush(&mut self) -> Result<(), RecordError> {
        self.said.push(Said::Flush);
        Ok(())
    }
}
