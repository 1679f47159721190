//! What a receiver shows of what it measured: off by a constant, in steps, and never better than so much.

use super::{Channel, Link, Received};
use crate::{
    radio::RadioParams,
    seed::{Seed, Source},
};

/// What becomes of a packet is decided before: a reading is of a packet that came in.
#[derive(Debug)]
pub(super) struct Reading<P> {
    inner: Box<dyn Channel<P>>,
    seed: Seed,
    offset_db: f32,
    /// Those of the first receivers (dB).
    offsets_db: Vec<f32>,
    quantum_db: f32,
    least_db: f32,
}

impl<P> Reading<P> {
    /// Around a channel; `None` where readings are exact.
    pub(super) fn is_asked_for(radio: &RadioParams) -> bool {
        radio.reading_offset_db > 0.0 || radio.quantum_db > 0.0 || radio.least_reading_db.is_some()
    }

    pub(super) fn new(inner: Box<dyn Channel<P>>, seed: Seed, receivers: u16, radio: &RadioParams) -> Self {
        let mut reading = Self {
            inner,
            seed,
            offset_db: radio.reading_offset_db,
            offsets_db: Vec::new(),
            quantum_db: radio.quantum_db,
            least_db: radio.least_reading_db.unwrap_or(f32::NEG_INFINITY),
        };
        reading.offsets_db = (0..receivers).map(|receiver| reading.drawn_db(receiver)).collect();
        reading
    }

    /// By how much a receiver reads too much (dB): the same for the whole run.
    fn drawn_db(&self, receiver: u16) -> f32 {
        if self.offset_db > 0.0 {
            self.offset_db * self.seed.stream(receiver.into(), Source::Reading).normal()
        } else {
            0.0
        }
    }

    fn read(&self, receiver: u16, loss_db: f32) -> f32 {
        let known_db = self.offsets_db.get(usize::from(receiver)).copied();
        let read_db = (loss_db + known_db.unwrap_or_else(|| self.drawn_db(receiver))).max(self.least_db);
        if self.quantum_db > 0.0 { self.quantum_db * (read_db / self.quantum_db).round() } else { read_db }
    }
}

impl<P: std::fmt::Debug> Channel<P> for Reading<P> {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        let received = self.inner.transfer(link, tick, loss_db, payload)?;
        Some(Received { loss_db: self.read(link.to, received.loss_db), ..received })
    }
}
