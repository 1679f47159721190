//! A run's numbers over time, and what happened in it: what programs that look into runs keep.

use super::Mission;
use crate::record::{Event, Recorder, table::Table};

/// Most events that a logbook keeps.
pub const EVENTS_MAX: usize = 100_000;

/// Which frames are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// All.
    Ticks,
    /// Those in which somebody decided.
    Decisions,
}

/// What a logbook holds in the end.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Log {
    /// Numbers over time: `frames`, if any were asked for, and what the mission has besides.
    pub tables: Vec<Table>,
    /// What happened, in order; the first [`EVENTS_MAX`].
    pub events: Vec<Event>,
}

impl Log {
    /// One event more, if there is room.
    pub(super) fn note(&mut self, events: &[Event]) {
        let room = EVENTS_MAX.saturating_sub(self.events.len());
        self.events.extend(events.iter().take(room).cloned());
    }
}

/// Keeps a run's numbers over time, and what happens in it.
pub trait Logbook<M: Mission>: Recorder<M::Frame> + Send {
    /// What has been kept so far, the tables aside.
    fn log(&self) -> &Log;

    /// All that was kept. What summed the run up may know more.
    fn close(self: Box<Self>, metrics: &M::Metrics) -> Log;
}

/// A graph of places, as it is in the end.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// A row for each node.
    pub nodes: Table,
    /// Pairs of rows of `nodes`.
    pub edges: Vec<[u32; 2]>,
    /// How far the two are apart (m).
    pub lengths_m: Vec<f32>,
}
