//! The frames of a recording, checked one by one.

use std::io::Read;

use prost::Message as _;

use super::{
    End, ReadError,
    records::{Item, Records},
};
use crate::record::{
    Frame,
    mcap::{FRAME_TOPIC, TICK_NS, message::FrameMessage, schema},
};

/// The frames of a recording, in order.
pub struct Frames<R> {
    records: Records<R>,
    /// Schema and channel of the frames, once they have been declared.
    schema: Option<u16>,
    channel: Option<u16>,
    message: FrameMessage,
    uavs: Option<usize>,
    tick: u64,
    end: Option<End>,
}

impl<R> std::fmt::Debug for Frames<R> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Frames").field("tick", &self.tick).field("end", &self.end).finish_non_exhaustive()
    }
}

impl<R> Frames<R> {
    /// Tick of the last frame that was read; 0 = none.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// How the file ended; `None` before [`Frames::read`] came there.
    pub fn end(&self) -> Option<End> {
        self.end
    }

    pub(super) fn expect_uavs(&mut self, uavs: usize) {
        self.uavs = Some(uavs);
    }
}

impl<R: Read> Frames<R> {
    pub(super) fn new(records: Records<R>) -> Self {
        let message = FrameMessage::default();
        Self { records, schema: None, channel: None, message, uavs: None, tick: 0, end: None }
    }

    /// Reads the next frame into `frame`; `false` at the end, and after an error.
    ///
    /// # Errors
    /// [`ReadError`]: from here on the file is not what was written.
    pub fn read(&mut self, frame: &mut Frame) -> Result<bool, ReadError> {
        if self.end.is_some() {
            return Ok(false);
        }
        let read = self.next(frame);
        if read.is_err() {
            self.end = Some(End::CutShort);
        }
        read
    }

    fn next(&mut self, frame: &mut Frame) -> Result<bool, ReadError> {
        loop {
            match self.records.next()? {
                Item::Schema { id, name } => {
                    if name.strip_prefix(schema::PACKAGE) == Some(".Frame") {
                        self.schema = Some(id);
                    }
                }
                Item::Channel { id, schema, topic } => {
                    if topic == FRAME_TOPIC && self.schema == Some(schema) {
                        self.channel = Some(id);
                    }
                }
                Item::Message { channel, time_ns, data } => {
                    if self.channel != Some(channel) {
                        continue;
                    }
                    let refuse = |why| ReadError::Frame { tick: self.tick, why };
                    self.message.clear();
                    self.message.merge(data).map_err(|error| refuse(error.to_string()))?;
                    self.message.pour(frame).map_err(refuse)?;
                    let next = (self.tick + 1, *self.uavs.get_or_insert(frame.uavs.len()));
                    check(frame, time_ns, next).map_err(|why| ReadError::Frame { tick: self.tick, why })?;
                    self.tick = frame.tick;
                    return Ok(true);
                }
                Item::End(end) => {
                    self.end = Some(end);
                    return Ok(false);
                }
                Item::Metadata { name, .. } | Item::Attachment { name, .. } => {
                    let why = format!("{name:.40} stands among the frames");
                    return Err(ReadError::Damaged { byte: self.records.byte(), why });
                }
            }
        }
    }
}

/// A frame is the next one, of as many UAVs, at its time.
fn check(frame: &Frame, time_ns: u64, (tick, uavs): (u64, usize)) -> Result<(), String> {
    let found = (frame.tick, frame.uavs.len());
    if found != (tick, uavs) {
        return Err(format!("tick {} with {} UAVs: expected tick {tick} with {uavs}", found.0, found.1));
    }
    if Some(time_ns) != tick.checked_mul(TICK_NS) {
        return Err(format!("log_time = {time_ns}: expected {tick} ticks of {TICK_NS} ns"));
    }
    Ok(())
}
