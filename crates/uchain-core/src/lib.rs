//! The laws that fly on the drone, without std: U-Chain (Laclau 2021) without a heap, and exploration by CSSG (Kim 2021)
//! with one.
//!
//! A robot is a loop of three words: *sense, decide, command*. What a robot may know at one instant is an
//! [`Observation`](chain::Observation) of plain numbers, what it asks of its body a [`Command`](chain::Command), and a
//! [`Brain`](chain::Brain) is what lies between. No position enters, anywhere in [`chain`]: radio is the sensor. The same
//! code flies in the simulator of the crate `uchain-sim`, which calls it as a drone does.
//!
//! # A relay, from the ground to the middle
//!
//! ```
//! use uchain_core::chain::{BASE_ID, Brain, Heard, Node, NodeParams, Observation, Packet, Role};
//!
//! let mut relay = Node::new(Role::Relay, NodeParams::default());
//! // What stands in for the world: a straight tunnel, the head 9 m deep, the base at 0 m, 5 dB a metre.
//! let loss_db = |length_m: f32| 35.0 + 5.0 * length_m;
//! let (mut at_m, mut speed_mps) = (0.0_f32, 0.0);
//!
//! for _ in 0..5 * 120 {
//!     // Sense: a decision is due five times a second, with the packets heard since the last one. A loss is a received
//!     // power in dBm with its sign changed.
//!     let head = Packet { place: 0, flown_s: 60.0, ..Packet::default() };
//!     let heard = [
//!         Heard { from: 0, loss_db: loss_db(9.0 - at_m), packet: head },
//!         Heard { from: BASE_ID, loss_db: loss_db(at_m), packet: Packet::BASE },
//!     ];
//!     let seen = Observation {
//!         place: Some(1),
//!         radio: Some(heard.into_iter().collect()),
//!         ground_speed_mps: Some(speed_mps),
//!         ..Observation::default()
//!     };
//!     // Decide: it takes off because the link is too weak without it, and levels its two links.
//!     let command = relay.decide(&seen);
//!     // Command: a body velocity, for the flight controller.
//!     speed_mps = command.forward_mps;
//!     at_m += speed_mps / 5.0;
//! }
//! assert!((at_m - 4.5).abs() < 0.3, "in the middle: {at_m} m");
//! ```
//!
//! The project's `examples/embedded_node.rs` is the same loop with ToF sensors and the radio's other direction.
//!
//! # Modules
//!
//! | module | what it is | heap |
//! |---|---|---|
//! | [`chain`] | U-Chain: Kalman filter of a link, equalization law (Eq. 12), centering (Eq. 20 and 21), take-off, overrides; [`chain::Node`] composes them | no |
//! | [`flight`] | the PD law that keeps a quadrotor in the air (Kim 2021, §7.1) | no |
//! | `explore` | CSSG: stars, frontiers, hubs, targets, levels, graph, strategies. Robots know their own *estimated* poses, their scans and what the others say | yes: feature `alloc` |
//! | [`wire`] | packets as bytes, 30 at most, and back | no |
//! | [`mod@params`] | how a law declares its tunables: default, range and meaning in one place, [`params!`] | no |
//!
//! # Features
//!
//! None is on by default.
//!
//! | feature | what it brings |
//! |---|---|
//! | `alloc` | the module `explore`, and boxed brains |
//! | `serde` | Params can be read from a file, and what crosses the seams, such as an [`Observation`](chain::Observation), be recorded |
//! | `schema` | what such a file may hold, as JSON Schema; for hosts only |
//!
//! # Conventions
//!
//! Units are in the names (`_m`, `_mps`, `_db`, `_rad`). x forward, y left, angles counter-clockwise. Radio is a *loss* in
//! dB, bigger is worse. Absence is `None`, never a number that means something else. Equations are cited as in the papers:
//!
//! - Laclau, Tempez, Ruffier, Natalizio, Mouret, "Signal-Based Self-Organization of a Chain of UAVs for Subterranean
//!   Exploration", Frontiers in Robotics and AI, 2021.
//! - Kim, Eggleton, Wilkerson, Gadsden, "Cooperative Sensor-based Selective Graph Exploration Strategy for a Team of
//!   Quadrotors", Journal of Intelligent & Robotic Systems, 2021.
//!
//! # Determinism
//!
//! The same observations in the same order give the same commands, bit for bit: arithmetic is `f32`, every function beyond
//! the basic four comes from the crate `libm`, nothing asks a clock, and what is random is drawn from bits that the caller
//! gives. No input panics: what is not finite counts as not heard or not measured.
//!
//! # Limits
//!
//! One chain in one tunnel: there are no junctions. Eq. 12 is proved for a loss that is continuous and grows with distance;
//! around corners it works in practice, within the bounds that the project's `docs/limits.md` tells. A UAV takes in
//! [`chain::HEARD_MAX`] packets per decision.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

mod bounded;
pub mod chain;
#[cfg(feature = "alloc")]
pub mod explore;
pub mod flight;
pub mod params;
pub mod wire;

pub use bounded::bounded;
use bounded::{larger, smaller};

/// The programs of the guide are compiled and run with those of this documentation.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/guide/firmware.md")]
struct FirmwareGuide;
