//! What flies on the drone, without std: the laws of two papers.
//!
//! [`chain`] is U-Chain: Laclau, Tempez, Ruffier, Natalizio, Mouret, "Signal-Based Self-Organization of a Chain of
//! UAVs for Subterranean Exploration", 2021. A drone feeds a [`chain::Node`] with a [`chain::Observation`] whenever
//! a sensor or the radio has something new, and flies the [`chain::Command`] it gets back. No position enters,
//! anywhere, and no heap is needed.
//!
//! `explore` (feature `alloc`) is CSSG: Kim, Eggleton, Wilkerson, Gadsden, "Cooperative Sensor-based Selective Graph
//! Exploration Strategy for a Team of Quadrotors", 2021. Its robots know their own *estimated* poses, their scans and
//! what the others say, and nothing else.
//!
//! [`flight`] is the PD law of Kim 2021, §7.1, that keeps a quadrotor in the air and takes it to where it is sent. It needs
//! no heap either.
//!
//! What a robot may know is in plain `f32` fields with the unit in the name. Equations are cited as in the papers.
//!
//! Conventions: x forward, y left, angles counter-clockwise; radio is a *loss* in dB, bigger is worse.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

mod bounded;
pub mod chain;
#[cfg(feature = "alloc")]
pub mod explore;
pub mod flight;
pub mod params;

pub use bounded::bounded;
