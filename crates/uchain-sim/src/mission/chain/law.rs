//! Whose law a chain flies by: the built-in node's, or one of a user's own.

use std::{fmt, sync::Arc};

use uchain_core::chain::{
    Brain, Command, Estimates, Explanation, Node, NodeParams, Observation, Packet, Role,
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

/// A brain that can be made for a UAV of a scenario: a chain of such brains is a mission.
pub trait Law: Brain + Sized + 'static {
    /// The brain of a UAV, by its id, before it has seen anything.
    fn of(course: &Course, uav: usize) -> Self;
}

/// The built-in brain.
impl Law for Node {
    fn of(course: &Course, uav: usize) -> Self {
        let role = if uav == 0 { Role::Head } else { Role::Relay };
        Self::new(role, course.node_params())
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
}
