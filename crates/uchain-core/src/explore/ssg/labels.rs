//! What a new node changes: labels, which only go from 1 to 0, and connections, which are only added.

use alloc::vec::Vec;

use super::{EdgeRule, Label, Node, Sector, Ssg};
use crate::explore::{NodeId, NodeReport};

/// Test points of an arc that no other star covers: its mid-point, and those of its ends that count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Open(u8);

impl Open {
    const NONE: Self = Self(0);
    const MIDDLE: Self = Self(0b010);

    /// The mid-point, and the beginning and the end if they count.
    fn with_ends([beginning, end]: [bool; 2]) -> Self {
        Self(Self::MIDDLE.0 | u8::from(beginning) | u8::from(end) << 2)
    }

    /// Which half sectors of sector k are still open: its beginning, middle and end are 2k, 2k + 1 and 2k + 2.
    fn halves(self, k: usize) -> impl Iterator<Item = usize> {
        (0..3).filter(move |i| self.0 & (1 << i) != 0).map(move |i| 2 * k + i)
    }

    fn without(self, k: usize, half: usize) -> Self {
        Self(self.0 & !(1 << (half - 2 * k)))
    }
}

impl Ssg {
    /// A new node with its labels as reported, no other star being looked at; its slot.
    pub(super) fn insert(&mut self, report: &NodeReport) -> usize {
        let slot = self.nodes.len();
        let mut frontiers = 0;
        for (k, sector) in report.sectors.iter().enumerate() {
            let sector = sector.believed(self.params.r_s_m);
            let frontier = sector.label == Label::Frontier;
            frontiers += u16::from(frontier);
            self.open.push(if frontier { self.tested(&report.sectors, k) } else { Open::NONE });
            self.sectors.push(sector);
        }
        if let Some(hubs) = self.hubs.get_mut(usize::from(report.id.robot)) {
            *hubs += u32::from(frontiers > 0);
        }
        self.nodes.push(Node { id: report.id, at: report.at, flown_from: report.flown_from, frontiers });
        self.slots.insert(report.id, slot as u32);
        self.grid.push(report.at);
        self.graph.push(u64::from(report.id.robot) << 32 | u64::from(report.id.number));
        slot
    }

    /// The test points of a frontier arc: its mid-point, and its ends where there is a wide gap (Kim 2021, §4.1).
    fn tested(&self, sectors: &[Sector], k: usize) -> Open {
        let (n, r_s_m) = (self.cones.count(), self.params.r_s_m);
        let is_wide = |beside: usize| {
            // A frontier reaches R_s.
            let gap_m = sectors.get(beside % n).map_or(0.0, |sector| r_s_m - sector.believed(r_s_m).r_m);
            self.params.arc_ends && gap_m >= self.params.arc_gap_share * r_s_m
        };
        Open::with_ends([is_wide(k + n - 1), is_wide(k + 1)])
    }

    /// Looks at all arcs that a new star may cover, and at the new arcs with all stars that may cover them (Kim 2021,
    /// §4.1). Returns the nodes of which a label changed.
    pub(super) fn retest(&mut self, slot: usize) -> Vec<usize> {
        let Some(at) = self.at(slot) else { return Vec::new() };
        let mut near = core::mem::take(&mut self.near);
        near.clear();
        // An arc ends at most R_s from its node, and a star at most R_s from its own.
        near.extend(self.grid.within(at, 2.0 * self.params.r_s_m).map(|other| other as u32));
        let mut changed = Vec::new();
        for other in near.iter().map(|&other| other as usize).filter(|&other| other != slot) {
            self.cover(slot, other);
            if self.cover(other, slot) {
                changed.push(other);
            }
        }
        self.near = near;
        changed
    }

    /// Closes the open test points of one node that lie in another's star; whether a label changed.
    fn cover(&mut self, node: usize, by: usize) -> bool {
        if !self.is_hub(node) {
            return false;
        }
        let mut changed = false;
        for k in 0..self.cones.count() {
            let i = node * self.cones.count() + k;
            let Some(&open) = self.open.get(i).filter(|&&open| open != Open::NONE) else { continue };
            let (Some(at), Some(star)) = (self.at(node), self.star(by)) else { continue };
            let covered = |half: &usize| {
                let point = self.cones.point(at, *half, self.params.r_s_m);
                star.holds(point, self.params.cover_margin_m)
            };
            let left = open.halves(k).filter(covered).fold(open, |left, half| left.without(k, half));
            if let Some(open) = self.open.get_mut(i) {
                *open = left;
            }
            if left == Open::NONE {
                changed |= self.spend(node, k);
            }
        }
        changed
    }

    /// A frontier arc is none any more; whether it was one.
    pub(super) fn spend(&mut self, slot: usize, k: usize) -> bool {
        let n = self.cones.count();
        let (Some(node), true) = (self.nodes.get_mut(slot), k < n) else { return false };
        let Some(sector) = self.sectors.get_mut(slot * n + k).filter(|s| s.label == Label::Frontier) else {
            return false;
        };
        sector.label = Label::Free;
        if let Some(open) = self.open.get_mut(slot * n + k) {
            *open = Open::NONE;
        }
        if let Some(freed) = &mut self.freed {
            freed.push((slot as u32, k as u16));
        }
        node.frontiers = node.frontiers.saturating_sub(1);
        if let Some(hubs) = self.hubs.get_mut(usize::from(node.id.robot)).filter(|_| node.frontiers == 0) {
            *hubs = hubs.saturating_sub(1);
        }
        true
    }

    /// Arcs that a robot has flown along or found to lead nowhere new.
    pub(super) fn spend_all(&mut self, slot: usize, sectors: [u16; 2]) {
        for k in sectors {
            self.spend(slot, usize::from(k));
        }
        self.connect_freed(slot);
    }

    /// Connects a new node: with the one it was flown from, with those that were flown from it and came before, and
    /// by the rule (Kim 2021, Algorithm 3).
    pub(super) fn connect(&mut self, slot: usize, flown_from: Option<NodeId>) {
        let Some(id) = self.id(slot) else { return };
        match flown_from.map(|from| (from, self.slot(from))) {
            Some((_, Some(from))) => self.link(from, slot),
            Some((from, None)) => self.orphans.push((slot as u32, from)),
            None => {}
        }
        let mut orphans = core::mem::take(&mut self.orphans);
        orphans.retain(|&(orphan, from)| {
            if from == id {
                self.link(slot, orphan as usize);
            }
            from != id
        });
        self.orphans = orphans;
        self.connect_near(slot);
    }

    /// By Eq. 8 as printed a label that became 0 may connect a node; by the other rule labels do not matter.
    pub(super) fn connect_freed(&mut self, slot: usize) {
        if self.params.edges == EdgeRule::Eq8 {
            self.connect_near(slot);
        }
    }

    fn connect_near(&mut self, slot: usize) {
        let Some(at) = self.at(slot) else { return };
        let mut near = core::mem::take(&mut self.near);
        near.clear();
        near.extend(self.grid.within(at, self.params.r_s_m).map(|other| other as u32));
        for other in near.iter().map(|&other| other as usize) {
            if self.sees(slot, other) {
                self.link(slot, other);
            }
        }
        self.near = near;
    }

    /// Whether two nodes are connected by the rule.
    fn sees(&self, a: usize, b: usize) -> bool {
        let (Some(star_a), Some(star_b)) = (self.star(a), self.star(b)) else { return false };
        let d_m = star_a.at.distance_m(star_b.at);
        let (to_b, to_a) = (star_a.facing(star_b.at), star_b.facing(star_a.at));
        let free = to_b.label == Label::Free && to_a.label == Label::Free;
        d_m < to_b.r_m && d_m < to_a.r_m && (self.params.edges == EdgeRule::Visible || free)
    }

    fn link(&mut self, a: usize, b: usize) {
        let place = |slot| self.at(slot).unwrap_or_default();
        let length_m = place(a).distance_m(place(b));
        self.graph.link(a, b, length_m);
    }
}
