//! A state for every link: never more than there are pairs of numbers.

use std::collections::BTreeMap;

use super::Link;

#[derive(Debug)]
pub(super) struct PerLink<S> {
    /// By receiver, of its neighbours behind and in front.
    sides: Vec<[S; 2]>,
    /// By sender and receiver.
    pairs: BTreeMap<(u16, u16), S>,
}

impl<S: Default> PerLink<S> {
    /// Room for so many receivers.
    pub(super) fn new(receivers: u16) -> Self {
        let mut sides = Vec::new();
        sides.resize_with(receivers.into(), Default::default);
        Self { sides, pairs: BTreeMap::new() }
    }

    pub(super) fn of(&mut self, link: Link) -> &mut S {
        let Some(side) = link.side else {
            return self.pairs.entry((link.from, link.to)).or_default();
        };
        let receiver = usize::from(link.to);
        if receiver >= self.sides.len() {
            self.sides.resize_with(receiver + 1, Default::default);
        }
        &mut self.sides[receiver][side as usize]
    }
}
