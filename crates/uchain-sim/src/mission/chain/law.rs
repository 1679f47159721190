//! Whose law a chain flies by: the built-in node's, or one of a user's own; and who else may level its relays.

use std::{fmt, ops::ControlFlow, sync::Arc};

use uchain_core::chain::{
    Brain, Command, Doing, Estimates, Explanation, Levelling, Node, NodeParams, Observation, Packet, Role,
};

use super::Course;

type Make = dyn Fn(usize, &NodeParams) -> Box<dyn Brain> + Send + Sync;

/// A law of one's own, for every UAV of a chain.
#[derive(Clone)]
pub struct OwnLaw(Arc<Make>);

impl OwnLaw {
    /// By what makes a brain.
    pub fn new<B: Brain + 'static>(make: impl Fn(usize, &NodeParams) -> B + Send + Sync + 'static) -> Self {
        Self(Arc::new(move |uav, params| Box::new(make(uav, params))))
    }
}

impl fmt::Debug for OwnLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnLaw").finish_non_exhaustive()
    }
}

/// A relay that asks for the forward speed that levels its two links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Its id.
    pub uav: usize,
    /// What it knows of its links.
    pub levelling: Levelling,
}

/// Levels the links of all built-in relays of a run, in place of [`equalize`](uchain_core::chain::equalize). All else, such
/// as filters, take-off, overrides and centering, is left to them. Unlike a [`Brain`] it sees all relays at once, and may end
/// the run.
pub trait Leveller: fmt::Debug + Send {
    /// The forward speeds of those that ask at the start of a tick (m/s), in their order; `level_mps` has as many zeros. What
    /// is not finite counts as 0. To break off ends the run at this very tick, with
    /// [`RecordError::Interrupted`](crate::record::RecordError::Interrupted): whoever breaks off has the reason.
    fn level(&mut self, tick: u64, asked: &[Asked], level_mps: &mut [f32]) -> ControlFlow<()>;
}

type MakeLeveller = dyn Fn(&Course) -> Box<dyn Leveller> + Send + Sync;

/// Makes the [`Leveller`] of each run.
#[derive(Clone)]
pub struct OwnLeveller(Arc<MakeLeveller>);

impl OwnLeveller {
    /// By what makes one.
    pub fn new<L: Leveller + 'static>(make: impl Fn(&Course) -> L + Send + Sync + 'static) -> Self {
        Self(Arc::new(move |course| Box::new(make(course))))
    }

    pub(super) fn make(&self, course: &Course) -> Box<dyn Leveller> {
        (self.0)(course)
    }
}

impl fmt::Debug for OwnLeveller {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnLeveller").finish_non_exhaustive()
    }
}

/// In place of a law that this program does not have: nobody is there to ask.
#[derive(Debug)]
pub(super) struct Nobody;

impl Leveller for Nobody {
    fn level(&mut self, _: u64, _: &[Asked], _: &mut [f32]) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

/// A brain that can be made for a UAV of a scenario: a chain of such brains is a mission.
pub trait Law: Brain + Sized + 'static {
    /// The brain of a UAV, by its id, before it has seen anything.
    fn of(course: &Course, uav: usize) -> Self;

    /// The first half of a decision, if it decides in halves: see [`Node::prepare`]. One that decides as a whole asks nobody.
    fn prepare(&mut self, _seen: &Observation) -> Option<Levelling> {
        None
    }

    /// The second half of a decision: see [`Node::conclude`]. One that decides as a whole does so here.
    fn conclude(&mut self, seen: &Observation, _level_mps: f32) -> Command {
        self.decide(seen)
    }
}

/// The built-in brain.
impl Law for Node {
    fn of(course: &Course, uav: usize) -> Self {
        let role = if uav == 0 { Role::Head } else { Role::Relay };
        Self::new(role, course.node_params())
    }

    fn prepare(&mut self, seen: &Observation) -> Option<Levelling> {
        Self::prepare(self, seen)
    }

    fn conclude(&mut self, seen: &Observation, level_mps: f32) -> Command {
        Self::conclude(self, seen, level_mps)
    }
}

/// The brain that a scenario asks for: the built-in one, or one of a user's own.
#[derive(Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "most are nodes, and a node in a box is decided by more slowly"
)]
pub enum AnyBrain {
    /// The built-in one.
    Node(Node),
    /// One of a user's own.
    Own(Box<dyn Brain>),
}

impl Law for AnyBrain {
    fn of(course: &Course, uav: usize) -> Self {
        match &course.law {
            None => Self::Node(Node::of(course, uav)),
            Some(OwnLaw(make)) => Self::Own(make(uav, &course.node_params())),
        }
    }

    fn prepare(&mut self, seen: &Observation) -> Option<Levelling> {
        match self {
            Self::Node(node) => node.prepare(seen),
            Self::Own(_) => None,
        }
    }

    fn conclude(&mut self, seen: &Observation, level_mps: f32) -> Command {
        match self {
            Self::Node(node) => node.conclude(seen, level_mps),
            Self::Own(own) => own.decide(seen),
        }
    }
}

impl Brain for AnyBrain {
    fn decide(&mut self, seen: &Observation) -> Command {
        match self {
            Self::Node(node) => node.decide(seen),
            Self::Own(own) => own.decide(seen),
        }
    }

    fn say(&self, seen: &Observation) -> Packet {
        match self {
            Self::Node(node) => node.say(seen),
            Self::Own(own) => own.say(seen),
        }
    }

    fn reach(&self) -> u16 {
        match self {
            Self::Node(node) => node.reach(),
            Self::Own(own) => own.reach(),
        }
    }

    fn estimates(&self) -> Estimates {
        match self {
            Self::Node(node) => node.estimates(),
            Self::Own(own) => own.estimates(),
        }
    }

    fn explain(&self, seen: &Observation) -> Option<Explanation> {
        match self {
            Self::Node(node) => node.explain(seen),
            Self::Own(own) => own.explain(seen),
        }
    }

    fn doing(&self, seen: &Observation) -> Option<Doing> {
        match self {
            Self::Node(node) => node.doing(seen),
            Self::Own(own) => own.doing(seen),
        }
    }
}
