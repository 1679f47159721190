//! Messages of our own: the way from a frame to one and back, bit for bit, and checks of what is read.

use crate::record::Snapshot;

/// One of our own messages, and what describes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Described {
    /// Its name.
    pub message: &'static str,
    /// Name of the file that describes it: one that no other description of the recording has.
    pub file: &'static str,
    /// That file, in the language of protobuf, package `uchain`.
    pub proto: &'static str,
}

/// A frame that can be recorded: a message of its own at every tick.
pub trait Recordable: Snapshot {
    /// What is in the file. It stands for one frame after the other, so that its lists are allocated once.
    type Message: prost::Message + Default;
    /// What describes its messages: a file in the language of protobuf, package `uchain`.
    const PROTO: &'static str;
    /// The message's name in that file.
    const MESSAGE: &'static str;
    /// Takes a message's values.
    ///
    /// # Errors
    /// In words: lists of unlike length, a number outside of what a simulation can come to.
    fn take(&mut self, message: &Self::Message) -> Result<(), String>;

    /// Fills a message with its values.
    fn fill(&self, message: &mut Self::Message);

    /// What the inputs of a pilot are recorded as, where there is one: a message before the frame of the first tick that an
    /// input was flown in. A flight without inputs has no trace of them.
    const INPUT: Option<Described> = None;

    /// What the pilot asked for anew at the start of the frame's tick, if he did, as the message that
    /// [`Recordable::INPUT`] describes.
    fn input(&self) -> Option<impl prost::Message> {
        None::<()>
    }

    /// Takes an input from its message, or takes none. [`Recordable::take`] leaves it as it is.
    ///
    /// # Errors
    /// In words: what no pilot may ask for.
    fn take_input(&mut self, _message: Option<&[u8]>) -> Result<(), String> {
        Ok(())
    }
}

/// Most contacts of one body: two a tick, all day long. Those of all bodies can be added up.
const MOST_CONTACTS: u32 = 4_000_000;

/// Replaces what a list holds.
pub fn set<T>(list: &mut Vec<T>, values: impl Iterator<Item = T>) {
    list.clear();
    list.extend(values);
}

/// Whether lists have as many entries as another one, `of`.
///
/// # Errors
/// In words, with both lengths.
pub fn alike(wanted: usize, of: &str, lengths: &[(&str, usize)]) -> Result<(), String> {
    match lengths.iter().find(|(_, length)| *length != wanted) {
        Some((name, length)) => Err(format!("{name} has {length} entries: expected {wanted}, as {of} has")),
        None => Ok(()),
    }
}

/// Walls lie within [`FARTHEST_M`](crate::map::FARTHEST_M), and nothing else in a run is larger.
///
/// # Errors
/// In words, with the numbers.
pub fn bounded(lists: &[(&str, &[f32])]) -> Result<(), String> {
    let most = 10.0 * crate::map::FARTHEST_M;
    for (name, list) in lists {
        if let Some(value) = list.iter().find(|value| value.is_nan() || value.abs() > most) {
            return Err(format!("{name} = {value}: expected a number within ±{most}"));
        }
    }
    Ok(())
}

/// Whether contacts are no more than a run can have.
///
/// # Errors
/// In words, with the number.
pub fn few(lists: &[(&str, &[u32])]) -> Result<(), String> {
    for (name, list) in lists {
        if let Some(count) = list.iter().find(|count| **count > MOST_CONTACTS) {
            return Err(format!("{name} = {count}: expected at most {MOST_CONTACTS}"));
        }
    }
    Ok(())
}

/// The number of a word.
pub fn number<T: Copy + PartialEq>(words: &[T], word: T) -> u32 {
    words.iter().position(|known| *known == word).unwrap_or_default() as u32
}

/// The word of a number.
///
/// # Errors
/// In words, with the numbers.
pub fn word<T: Copy>(name: &str, words: &[T], number: u32) -> Result<T, String> {
    let known = usize::try_from(number).ok().and_then(|number| words.get(number));
    known.copied().ok_or_else(|| format!("{name} = {number}: expected less than {}", words.len()))
}

/// A number of at most 16 bits.
///
/// # Errors
/// In words, with the number.
pub fn small(name: &str, number: u32) -> Result<u16, String> {
    u16::try_from(number).map_err(|_| format!("{name} = {number}: expected at most {}", u16::MAX))
}
