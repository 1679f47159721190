//! Packets arrive late; of those that arrive together the newest counts.

use std::collections::VecDeque;

use super::{Channel, Link, Received, per_link::PerLink};

/// Packets under way and when they are due (tick).
type UnderWay<P> = VecDeque<(u64, Received<P>)>;

#[derive(Debug)]
pub(super) struct Delayed<P> {
    inner: Box<dyn Channel<P>>,
    delay_ticks: u64,
    under_way: PerLink<UnderWay<P>>,
}

impl<P> Delayed<P> {
    pub(super) fn new(inner: Box<dyn Channel<P>>, receivers: u16, delay_ticks: u32) -> Self {
        Self { inner, delay_ticks: delay_ticks.into(), under_way: PerLink::new(receivers) }
    }
}

impl<P: std::fmt::Debug + Send> Channel<P> for Delayed<P> {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        let under_way = self.under_way.of(link);
        if let Some(received) = self.inner.transfer(link, tick, loss_db, payload) {
            under_way.push_back((tick + self.delay_ticks, received));
        }
        let mut newest = None;
        while under_way.front().is_some_and(|(due, _)| *due <= tick) {
            newest = under_way.pop_front().map(|(_, received)| received);
        }
        newest
    }
}
