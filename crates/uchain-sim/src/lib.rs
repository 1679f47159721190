//! The world around [`uchain_core`]: tunnels, sensors, radio, physics, missions and what is seen of them.
//!
//! One tick is five words: sense, decide, act, advance, record; read [`sim`] first, a chain's, and [`explore`], an
//! exploration's.

// Brings the program its own exp, sin and log, for what rapier and parry ask of the system.
use uchain_libm as _;

pub mod analyse;
pub mod config;
#[cfg(feature = "draw")]
pub mod draw;
pub mod explore;
pub mod map;
pub mod mission;
#[cfg(feature = "paper")]
pub mod paper;
pub mod radio;
pub mod record;
#[cfg(feature = "record")]
pub mod replay;
pub mod run;
pub mod seed;
pub mod sense;
pub mod sim;
#[cfg(feature = "sweep")]
pub mod sweep;
pub mod world;
