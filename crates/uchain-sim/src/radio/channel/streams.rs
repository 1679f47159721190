//! Random numbers of every link.

use super::Link;
use crate::seed::{Seed, Source, Stream};

/// Of neighbours in a chain each link has a stream that goes on from packet to packet. Of any other two it has one that is
/// opened anew at every tick, a function of seed, ends and tick: it takes no memory, however many hear each other, and
/// nobody's draws depend on who was asked before.
#[derive(Debug)]
pub(super) struct LinkStreams {
    seed: Seed,
    /// Of a link to the back, to the front, and of two that are no neighbours.
    sources: [Source; 3],
    /// By receiver.
    sides: Vec<[Stream; 2]>,
    /// That of the last pair that was asked for.
    pair: Stream,
}

impl LinkStreams {
    pub(super) fn new(seed: Seed, receivers: u16, sources: [Source; 3]) -> Self {
        let mut streams = Self {
            seed,
            sources,
            sides: Vec::with_capacity(receivers.into()),
            pair: seed.link_stream(0, 0, sources[2], 0),
        };
        streams.make_room(receivers.into());
        streams
    }

    fn make_room(&mut self, receivers: usize) {
        let [back, front, _] = self.sources;
        let new = self.sides.len()..receivers;
        self.sides.extend(new.map(|i| [back, front].map(|source| self.seed.stream(i as u32, source))));
    }

    pub(super) fn of(&mut self, link: Link, tick: u64) -> &mut Stream {
        let Some(side) = link.side else {
            self.pair = self.seed.link_stream(link.from, link.to, self.sources[2], tick);
            return &mut self.pair;
        };
        let receiver = usize::from(link.to);
        if receiver >= self.sides.len() {
            self.make_room(receiver + 1);
        }
        &mut self.sides[receiver][side as usize]
    }
}
