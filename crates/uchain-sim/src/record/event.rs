//! What happened in a run, in words.

use crate::clock;

/// How grave an event is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gravity {
    /// As it should be.
    Info,
    /// It should not be, and the mission goes on.
    Warning,
    /// The mission suffers.
    Error,
}

impl Gravity {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// Something that happened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// Ticks since the start.
    pub tick: u64,
    /// How grave it is.
    pub gravity: Gravity,
    /// What it is, for programs: `took-off`.
    pub kind: &'static str,
    /// To whom it happened; `None` if to all.
    pub robot: Option<usize>,
    /// What it is, for people.
    pub text: String,
}

impl Event {
    /// Simulated time at the end of the tick (s).
    pub fn time_s(&self) -> f64 {
        clock::time_s(self.tick)
    }
}
