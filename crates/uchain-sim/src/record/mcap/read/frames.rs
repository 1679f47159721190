//! The frames of a recording, checked one by one.

use std::io::Read;

use prost::Message as _;

use super::{
    End, ReadError,
    records::{Item, Records},
};
use crate::{
    clock::TICK_NS,
    record::mcap::{FRAME_TOPIC, PILOT_TOPIC, Recordable, schema},
};

/// The frames of a recording, in order.
pub struct Frames<R, F: Recordable> {
    records: Records<R>,
    /// Schema and channel of the frames, once they have been declared.
    schema: Option<u16>,
    channel: Option<u16>,
    /// Those of the pilot's inputs.
    input_schema: Option<u16>,
    input_channel: Option<u16>,
    message: F::Message,
    crew: Option<usize>,
    tick: u64,
    end: Option<End>,
}

impl<R, F: Recordable> std::fmt::Debug for Frames<R, F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Frames").field("tick", &self.tick).field("end", &self.end).finish_non_exhaustive()
    }
}

impl<R, F: Recordable> Frames<R, F> {
    /// Tick of the last frame that was read; 0 = none.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// How the file ended; `None` before [`Frames::read`] came there.
    pub fn end(&self) -> Option<End> {
        self.end
    }

    /// From here on, frames with another number of robots are refused.
    pub fn expect_crew(&mut self, count: usize) {
        self.crew = Some(count);
    }
}

impl<R: Read, F: Recordable> Frames<R, F> {
    pub(super) fn new(records: Records<R>) -> Self {
        let message = F::Message::default();
        Self {
            records,
            schema: None,
            channel: None,
            input_schema: None,
            input_channel: None,
            message,
            crew: None,
            tick: 0,
            end: None,
        }
    }

    /// Reads the next frame into `frame`; `false` at the end, and after an error.
    ///
    /// # Errors
    /// [`ReadError`]: from here on the file is not what was written.
    pub fn read(&mut self, frame: &mut F) -> Result<bool, ReadError> {
        if self.end.is_some() {
            return Ok(false);
        }
        let read = self.next(frame);
        if read.is_err() {
            self.end = Some(End::CutShort);
        }
        read
    }

    fn next(&mut self, frame: &mut F) -> Result<bool, ReadError> {
        let tick = self.tick;
        let refuse = |why| ReadError::Frame { tick, why };
        frame.take_input(None).map_err(refuse)?;
        let mut has_input = false;
        loop {
            match self.records.next()? {
                Item::Schema { id, name } => {
                    let own = name.strip_prefix(schema::PACKAGE).and_then(|name| name.strip_prefix('.'));
                    if own == Some(F::MESSAGE) {
                        self.schema = Some(id);
                    }
                    if own.is_some() && own == F::INPUT.map(|input| input.message) {
                        self.input_schema = Some(id);
                    }
                }
                Item::Channel { id, schema, topic } => {
                    if topic == FRAME_TOPIC && self.schema == Some(schema) {
                        self.channel = Some(id);
                    }
                    if topic == PILOT_TOPIC && self.input_schema == Some(schema) {
                        self.input_channel = Some(id);
                    }
                }
                Item::Message { channel, time_ns, data } => {
                    if self.input_channel == Some(channel) {
                        input_in_time(time_ns, tick, has_input).map_err(refuse)?;
                        frame.take_input(Some(data)).map_err(refuse)?;
                        has_input = true;
                    }
                    if self.channel != Some(channel) {
                        continue;
                    }
                    self.message.clear();
                    self.message.merge(data).map_err(|error| refuse(error.to_string()))?;
                    frame.take(&self.message).map_err(refuse)?;
                    let found = (frame.tick(), frame.crew());
                    let next = (self.tick + 1, *self.crew.get_or_insert(found.1));
                    let checked = check(found, time_ns, next, F::CREW);
                    checked.map_err(refuse)?;
                    self.tick = found.0;
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

/// A pilot asks for one thing, at the start of the tick after the last one.
fn input_in_time(time_ns: u64, tick: u64, has_input: bool) -> Result<(), String> {
    if has_input {
        return Err("two inputs of the pilot: expected one".to_owned());
    }
    if Some(time_ns) != tick.checked_mul(TICK_NS) {
        return Err(format!(
            "log_time = {time_ns} of the pilot's input: expected {tick} ticks of {TICK_NS} ns"
        ));
    }
    Ok(())
}

/// A frame is the next one, of as many UAVs or robots, at its time.
fn check(found: (u64, usize), time_ns: u64, (tick, count): (u64, usize), crew: &str) -> Result<(), String> {
    if found != (tick, count) {
        return Err(format!("tick {} with {} {crew}: expected tick {tick} with {count}", found.0, found.1));
    }
    if Some(time_ns) != tick.checked_mul(TICK_NS) {
        return Err(format!("log_time = {time_ns}: expected {tick} ticks of {TICK_NS} ns"));
    }
    Ok(())
}
