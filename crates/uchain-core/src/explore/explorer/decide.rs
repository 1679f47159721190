//! Where a robot flies from a node: its strategy's goal, as one straight flight.

use alloc::vec::Vec;

use super::{Explorer, Message, Purpose};
use crate::explore::{Candidate, Goal, NodeId, Point, SpentReport, Ssg, View};

/// One straight flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    pub(super) to: Point,
    pub(super) end: End,
    pub(super) purpose: Purpose,
    /// It is still at the node where this was decided, and may think again.
    pub(super) open: bool,
    /// The last command was to fly it, not to hold.
    pub(super) sent: bool,
}

/// What is at the end of a flight.
#[derive(Debug, Clone, Copy)]
pub(super) enum End {
    /// A place to scan, reached along these sectors.
    New([u16; 2]),
    /// A node.
    Known(NodeId),
}

impl Explorer {
    /// Where to fly from the node it is at (Kim 2021, Algorithm 2, lines 2–17); `None` to stay.
    pub(super) fn decide(
        &mut self,
        ssg: &mut Ssg,
        draw: &mut dyn FnMut() -> u32,
        said: &mut Vec<Message>,
    ) -> Option<Leg> {
        let node = self.here?;
        let here = ssg.slot(node)?;
        let params = ssg.params();
        let strategy = self.strategy.get_or_insert_with(|| params.strategy.make(params));
        // Every candidate that is refused spends an arc of this node.
        for _ in 0..=ssg.cones().count() {
            let mut view = View {
                ssg,
                robot: self.robot,
                here,
                pose: self.pose,
                mates: &self.mates,
                previous: self.hub,
                routes: &mut self.routes,
                draw,
            };
            let goal = if ssg.is_full() { Goal::Home } else { strategy.goal(&mut view) };
            match goal {
                Goal::Frontier(c) if !c.at.is_sound() || ssg.is_crowded(c.at) => {
                    spend(ssg, node, c.sectors, said);
                }
                Goal::Frontier(c) => {
                    self.hub = None;
                    return Some(toward(&c));
                }
                Goal::Node(hub) => {
                    self.hub = ssg.id(hub);
                    return self.step(ssg, here, hub, Purpose::Backtrack);
                }
                Goal::Home => {
                    self.hub = None;
                    let home = ssg.slot(self.home()?)?;
                    return self.step(ssg, here, home, Purpose::Home);
                }
            }
        }
        None
    }

    /// The first edge of the shortest way to a node; `None` if it is here or no way leads there.
    fn step(&mut self, ssg: &Ssg, here: usize, goal: usize, purpose: Purpose) -> Option<Leg> {
        // Mostly its strategy has just come by there.
        if !self.routes.knows(ssg.graph(), here, goal) {
            self.routes.search(ssg.graph(), here, |slot, _| slot == goal);
        }
        let next = self.routes.first_step(goal).filter(|&next| next != here)?;
        Some(Leg { to: ssg.at(next)?, end: End::Known(ssg.id(next)?), purpose, open: true, sent: false })
    }
}

fn toward(candidate: &Candidate) -> Leg {
    let (to, end) = (candidate.at, End::New(candidate.sectors));
    Leg { to, end, purpose: Purpose::Explore, open: true, sent: false }
}

/// Arcs are no frontiers any more, and all are told.
pub(super) fn spend(ssg: &mut Ssg, node: NodeId, sectors: [u16; 2], said: &mut Vec<Message>) {
    let spent = Message::Spent(SpentReport { node, sectors });
    // A store refuses nodes only.
    let _ = ssg.apply(&spent);
    said.push(spent);
}
