//! Our own messages, as `uchain.proto` has them, and the way from a frame to one and back, bit for bit.

mod chain;
mod explore;

pub(super) use chain::{FrameMessage, MetricsMessage};
pub(super) use explore::{ExploreFrameMessage, ExploreMetricsMessage};

use crate::{
    analyse::Compare,
    record::{ExploreFrame, Frame},
};

/// A frame that can be recorded: a message of its own at every tick.
pub trait Recordable: Default + Clone + Compare {
    /// What is in the file. It stands for one frame after the other, so that its lists are allocated once.
    type Message: prost::Message + Default;
    /// Its name in `uchain.proto`.
    const MESSAGE: &'static str;
    /// What flies.
    const CREW: &'static str;

    /// Takes a message's values.
    ///
    /// # Errors
    /// In words: lists of unlike length, a number outside of what a simulation can come to.
    fn take(&mut self, message: &Self::Message) -> Result<(), String>;

    /// Tick and number of those that fly.
    fn count(&self) -> (u64, usize);
}

impl Recordable for Frame {
    type Message = FrameMessage;
    const MESSAGE: &'static str = "Frame";
    const CREW: &'static str = "UAVs";

    fn take(&mut self, message: &FrameMessage) -> Result<(), String> {
        message.pour(self)
    }

    fn count(&self) -> (u64, usize) {
        (self.tick, self.uavs.len())
    }
}

impl Recordable for ExploreFrame {
    type Message = ExploreFrameMessage;
    const MESSAGE: &'static str = "ExploreFrame";
    const CREW: &'static str = "robots";

    fn take(&mut self, message: &ExploreFrameMessage) -> Result<(), String> {
        message.pour(self)
    }

    fn count(&self) -> (u64, usize) {
        (self.tick, self.robots.len())
    }
}

/// Most contacts of one body: two a tick, all day long. Those of all bodies can be added up.
const MOST_CONTACTS: u32 = 4_000_000;

/// Replaces what a list holds.
fn set<T>(list: &mut Vec<T>, values: impl Iterator<Item = T>) {
    list.clear();
    list.extend(values);
}

fn alike(wanted: usize, of: &str, lengths: &[(&str, usize)]) -> Result<(), String> {
    match lengths.iter().find(|(_, length)| *length != wanted) {
        Some((name, length)) => Err(format!("{name} has {length} entries: expected {wanted}, as {of} has")),
        None => Ok(()),
    }
}

/// Walls lie within [`FARTHEST_M`](crate::map::FARTHEST_M), and nothing else in a run is larger.
fn bounded(lists: &[(&str, &[f32])]) -> Result<(), String> {
    let most = 10.0 * crate::map::FARTHEST_M;
    for (name, list) in lists {
        if let Some(value) = list.iter().find(|value| value.is_nan() || value.abs() > most) {
            return Err(format!("{name} = {value}: expected a number within ±{most}"));
        }
    }
    Ok(())
}

fn few(lists: &[(&str, &[u32])]) -> Result<(), String> {
    for (name, list) in lists {
        if let Some(count) = list.iter().find(|count| **count > MOST_CONTACTS) {
            return Err(format!("{name} = {count}: expected at most {MOST_CONTACTS}"));
        }
    }
    Ok(())
}

/// The number of a word.
fn number<T: Copy + PartialEq>(words: &[T], word: T) -> u32 {
    words.iter().position(|known| *known == word).unwrap_or_default() as u32
}

/// The word of a number.
fn word<T: Copy>(name: &str, words: &[T], number: u32) -> Result<T, String> {
    let known = usize::try_from(number).ok().and_then(|number| words.get(number));
    known.copied().ok_or_else(|| format!("{name} = {number}: expected less than {}", words.len()))
}

fn small(name: &str, number: u32) -> Result<u16, String> {
    u16::try_from(number).map_err(|_| format!("{name} = {number}: expected at most {}", u16::MAX))
}
