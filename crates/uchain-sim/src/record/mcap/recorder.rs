//! Writes a recording while a run flies.

use std::io::Write;

use super::{About, Channel, FRAME_TOPIC, Out, Recordable};
use crate::{
    map::Map,
    record::{RecordError, Recorder},
};

/// What a mission shows in its recordings beside its frames: topics in Foxglove's messages, and metrics.
pub trait Topics: Sized + Send {
    /// What the mission is flown in.
    type Scene;
    /// Its frames.
    type Frame: Recordable;

    /// Declares the topics, and writes what stands before the first tick.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    fn start<W: Write>(scene: &Self::Scene, out: &mut Out<W>) -> Result<Self, RecordError>;

    /// Writes what was sensed at the start of the tick, before the tick's own frame.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    fn sensed<W: Write>(&mut self, _frame: &Self::Frame, _out: &mut Out<W>) -> Result<(), RecordError> {
        Ok(())
    }

    /// Writes what is to be seen at the end of the tick.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    fn show<W: Write>(&mut self, frame: &Self::Frame, out: &mut Out<W>) -> Result<(), RecordError>;
}

/// Records every frame of a run in MCAP.
///
/// What is written reaches the writer below chunk by chunk: a run that is killed loses at most the last 64 KiB.
/// Recording changes no bit of a run.
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
pub struct McapRecorder<W: Write, T: Topics> {
    out: Out<W>,
    channel: Channel,
    message: <T::Frame as Recordable>::Message,
    topics: T,
}

impl<W: Write, T: Topics> std::fmt::Debug for McapRecorder<W, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("McapRecorder").finish_non_exhaustive()
    }
}

impl<W: Write, T: Topics> McapRecorder<W, T> {
    /// Begins a recording: what it is of, the walls, all that stands before the first tick. That has reached `to` when
    /// this returns; from here on `to` always holds a readable file.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn begin(to: W, about: &About, map: &Map, scene: &T::Scene) -> Result<Self, RecordError> {
        let mut out = Out::begin(to, about, map, T::Frame::PROTO)?;
        let channel = out.own_channel(FRAME_TOPIC, T::Frame::MESSAGE)?;
        let topics = T::start(scene, &mut out)?;
        out.flush()?;
        Ok(Self { out, channel, message: <T::Frame as Recordable>::Message::default(), topics })
    }

    /// Ends the recording with its index and hands the writer back. Without this the file is readable as well, but
    /// counts as cut short.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn finish(self) -> Result<W, RecordError> {
        self.out.finish()
    }
}

impl<W: Write, T: Topics> Recorder<T::Frame> for McapRecorder<W, T> {
    fn frame(&mut self, frame: &T::Frame) -> Result<(), RecordError> {
        use crate::record::Snapshot as _;
        self.topics.sensed(frame, &mut self.out)?;
        frame.fill(&mut self.message);
        self.out.send(self.channel, frame.tick(), &self.message)?;
        self.topics.show(frame, &mut self.out)
    }
}
