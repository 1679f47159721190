//! Links that work one way only: who is deaf to a neighbour for a while.

use std::collections::BTreeMap;

use super::{Channel, Link, Received, Side};
use crate::{
    clock::time_s,
    radio::{Deaf, DeafSide},
};

#[derive(Debug)]
pub(super) struct OneWay<P> {
    inner: Box<dyn Channel<P>>,
    /// By receiver.
    deaf: BTreeMap<usize, Vec<Deaf>>,
}

impl<P> OneWay<P> {
    pub(super) fn new(inner: Box<dyn Channel<P>>, deaf: &[Deaf]) -> Self {
        let mut by_receiver: BTreeMap<usize, Vec<Deaf>> = BTreeMap::new();
        for deaf in deaf {
            by_receiver.entry(deaf.uav).or_default().push(*deaf);
        }
        Self { inner, deaf: by_receiver }
    }
}

impl<P: std::fmt::Debug> Channel<P> for OneWay<P> {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        let received = self.inner.transfer(link, tick, loss_db, payload);
        let Some(deaf) = self.deaf.get(&usize::from(link.to)) else { return received };
        let now_s = time_s(tick);
        let is_deaf = deaf.iter().any(|deaf| {
            let same_side = match deaf.side {
                DeafSide::Back => link.side == Some(Side::Back),
                DeafSide::Front => link.side == Some(Side::Front),
            };
            same_side && now_s >= deaf.start_s && deaf.stop_s.is_none_or(|stop_s| now_s < stop_s)
        });
        received.filter(|_| !is_deaf)
    }
}
