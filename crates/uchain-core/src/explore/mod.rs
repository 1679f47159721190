//! Cooperative exploration by the Sensor-based Selective Graph (CSSG; Kim 2021, Algorithm 2).
//!
//! All that is known of the place is in an [`Ssg`]: the nodes that robots have scanned from, their stars, what is a
//! frontier, and which nodes are connected. It is fed with [`Message`]s alone. Every robot may keep a copy of its
//! own; where all robots hear everything, all copies are equal, and one may serve them all.
//!
//! What a robot decides is in an [`Explorer`]. One round, for every robot:
//!
//! 1. [`Explorer::perceive`]: where it is, and what it has scanned there. All robots, before any of them goes on.
//! 2. [`Explorer::announce`]: where it will fly. In index order: a robot has heard the targets before its own.
//! 3. [`Explorer::resolve`]: on which level, or that it holds, so that nobody meets. A holder of all targets may call
//!    [`rule`] once for all and hand the [`Ruling`]s to [`Explorer::follow_ruling`].
//!
//! The first two say something: whatever is in `said` goes to every robot in range, into [`Explorer::hear`] and
//! [`Ssg::apply`]. The speaker has taken it in already; taking it in again changes nothing.
//!
//! Which frontier, which hub: that is a [`Strategy`], from a [`View`] to a [`Goal`]. Its [`StrategyKind`] is a value of
//! [`ExploreParams`].

mod explorer;
mod levels;
mod params;
mod seam;
mod ssg;
mod strategy;

pub use explorer::Explorer;
pub use levels::{Ruling, closest_m, rule};
pub use params::ExploreParams;
pub use seam::{
    Command, Message, NodeId, NodeReport, Observation, Point, Pose, Purpose, SpentReport, Target,
};
pub use ssg::{Cones, Dijkstra, EdgeRule, Graph, Hub, Label, Refusal, Run, Sector, Ssg, Star, runs};
pub use strategy::{
    Candidate, CloneStrategy, Cssg, Goal, Mate, NearestFrontier, RandomFrontier, Strategy, StrategyKind,
    Taken, Utility, View,
};
