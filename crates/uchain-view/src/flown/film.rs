//! The frames of a flight, in bounded memory.

use uchain_sim::record::Snapshot;

/// Most bytes of kept frames; beyond, every second one goes, and fewer come.
const MOST_BYTES: usize = 200 << 20;

/// Frames: every n-th, from the first on. What lies between is flown again.
#[derive(Debug)]
pub(super) struct Film<F> {
    frames: Vec<F>,
    every: u64,
    bytes: usize,
    pub(super) most_bytes: usize,
}

impl<F> Default for Film<F> {
    fn default() -> Self {
        Self { frames: Vec::new(), every: 1, bytes: 0, most_bytes: MOST_BYTES }
    }
}

impl<F: Snapshot> Film<F> {
    /// Whether a frame of this tick is kept.
    pub(super) fn wants(&self, tick: u64) -> bool {
        (tick - 1).is_multiple_of(self.every)
    }

    /// Keeps a frame that is so large.
    pub(super) fn push(&mut self, frame: F, bytes: usize) {
        self.bytes += bytes;
        self.frames.push(frame);
        if self.bytes > self.most_bytes {
            self.every *= 2;
            let every = self.every;
            self.frames.retain(|frame| (frame.tick() - 1).is_multiple_of(every));
            // They are all about as large.
            self.bytes /= 2;
        }
    }

    /// The frame of a tick, or the nearest kept one before it.
    pub(super) fn at(&self, tick: u64) -> Option<&F> {
        let index = tick.saturating_sub(1) / self.every;
        self.frames.get(usize::try_from(index).ok()?.min(self.frames.len().checked_sub(1)?))
    }

    /// Every how many ticks one is kept.
    pub(super) fn every(&self) -> u64 {
        self.every
    }
}

#[cfg(test)]
mod tests {
    use uchain_sim::mission::chain::Frame;

    use super::*;

    #[test]
    fn a_film_that_is_full_keeps_every_second_frame_and_finds_the_nearest_before() {
        let mut film = Film { most_bytes: 1000, ..Film::<Frame>::default() };
        for tick in 1..=5000 {
            if film.wants(tick) {
                film.push(Frame { tick, ..Frame::default() }, 10);
            }
            assert!(film.bytes <= 1000 && film.frames.len() <= 101, "{} frames", film.frames.len());
        }
        assert_eq!(film.every(), 64);
        for tick in 1..=5000 {
            let found = film.at(tick).unwrap().tick;
            assert!(found <= tick && tick - found < film.every(), "{found} for {tick}");
            assert_eq!(film.wants(tick), found == tick);
        }
        assert!(Film::<Frame>::default().at(1).is_none());
    }
}
