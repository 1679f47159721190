//! Makes a recording while a run flies.

use std::io::Write;

use super::{About, FRAME_TOPIC, McapWriter, Out, PILOT_TOPIC, Recordable, out::Encoding};
use crate::{
    map::Map,
    record::{Channel, RecordError, Recorder, Sink, Snapshot as _},
};

/// What a mission shows in its recordings beside its frames: topics in Foxglove's messages, and metrics. Where they go is
/// not its concern.
pub trait Topics: Sized + Send {
    /// What the mission is flown in.
    type Scene;
    /// Its frames.
    type Frame: Recordable;

    /// Declares the topics, and says what stands before the first tick.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    fn start(scene: &Self::Scene, out: &mut Out<'_>) -> Result<Self, RecordError>;

    /// Says what was sensed at the start of the tick, before the tick's own frame.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    fn sensed(&mut self, _frame: &Self::Frame, _out: &mut Out<'_>) -> Result<(), RecordError> {
        Ok(())
    }

    /// Says what is to be seen at the end of the tick.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    fn show(&mut self, frame: &Self::Frame, out: &mut Out<'_>) -> Result<(), RecordError>;
}

/// Says every frame of a run to a [`Sink`], and what its mission shows besides. Recording changes no bit of a run.
pub struct MessageRecorder<S, T: Topics> {
    sink: S,
    encoding: Encoding,
    channel: Channel,
    /// Where the pilot's inputs go, once there has been one.
    pilot: Option<Channel>,
    message: <T::Frame as Recordable>::Message,
    topics: T,
}

/// Records every frame of a run in MCAP, to anything that takes bytes: a file, a `Vec`, a `TcpStream`.
///
/// What is written reaches the writer below chunk by chunk: a run that is killed loses at most the last 64 KiB. The run
/// waits for the writer: a peer that reads slowly slows it down, one that goes away ends it with an error.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::chain::{Course, McapRecorder}, replay::Recording, run::run};
/// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=2".to_owned()]).unwrap();
/// let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
/// let summary = run(&course, 1, &mut recorder).unwrap();
/// let file = recorder.finish().unwrap();
///
/// let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
/// let course = recording.scene().unwrap();
/// assert_eq!(recording.summary(&course, &mut ()).unwrap(), summary);
/// ```
pub type McapRecorder<W, T> = MessageRecorder<McapWriter<W>, T>;

impl<S, T: Topics> std::fmt::Debug for MessageRecorder<S, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MessageRecorder").finish_non_exhaustive()
    }
}

impl<S: Sink, T: Topics> MessageRecorder<S, T> {
    /// Begins a recording: what it is of, the walls, all that stands before the first tick. The sink has been asked to
    /// hand that on when this returns.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn begin_in(mut sink: S, about: &About, map: &Map, scene: &T::Scene) -> Result<Self, RecordError> {
        let mut encoding = Encoding::of(T::Frame::PROTO);
        let mut out = Out::new(&mut sink, &mut encoding);
        out.begin(about, map)?;
        let channel = out.own_channel(FRAME_TOPIC, T::Frame::MESSAGE)?;
        let topics = T::start(scene, &mut out)?;
        sink.flush()?;
        let message = <T::Frame as Recordable>::Message::default();
        Ok(Self { sink, encoding, channel, pilot: None, message, topics })
    }

    /// Hands the sink back, as it is by now.
    pub fn into_sink(self) -> S {
        self.sink
    }
}

impl<W: Write, T: Topics> McapRecorder<W, T> {
    /// Begins a recording: what it is of, the walls, all that stands before the first tick. That has reached `to` when
    /// this returns; from here on `to` always holds a readable file.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn begin(to: W, about: &About, map: &Map, scene: &T::Scene) -> Result<Self, RecordError> {
        Self::begin_in(McapWriter::begin(to)?, about, map, scene)
    }

    /// Ends the recording with its index and hands the writer back. Without this the file is readable as well, but
    /// counts as cut short.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn finish(self) -> Result<W, RecordError> {
        self.sink.finish()
    }
}

impl<S: Sink, T: Topics> Recorder<T::Frame> for MessageRecorder<S, T> {
    fn frame(&mut self, frame: &T::Frame) -> Result<(), RecordError> {
        let Self { sink, encoding, channel, pilot, message, topics } = self;
        let mut out = Out::new(sink, encoding);
        if let (Some(described), Some(input)) = (T::Frame::INPUT, frame.input()) {
            let channel = match *pilot {
                Some(channel) => channel,
                None => *pilot.insert(out.described_channel(PILOT_TOPIC, &described)?),
            };
            out.send(channel, frame.tick().saturating_sub(1), &input)?;
        }
        topics.sensed(frame, &mut out)?;
        frame.fill(message);
        out.send(*channel, frame.tick(), message)?;
        topics.show(frame, &mut out)
    }
}
