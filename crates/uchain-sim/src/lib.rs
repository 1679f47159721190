//! The world around [`uchain_core`]: tunnels, sensors, radio, physics, missions and what is seen of them.
//!
//! One tick is five words: sense, decide, act, advance, record; read [`mission`] first, and then one of its missions.
//!
//! The same scenario and seed give the same bits everywhere, but for what rapier and parry ask of the program's `exp`,
//! `sin` and `log`. Linking this crate changes none of them; a program that wants equal bits brings its own with one
//! line, `use uchain_libm as _;`. [`mathematics`] tells whether it did.

#[cfg(test)]
use uchain_libm as _;

pub mod analyse;
pub mod clock;
pub mod config;
#[cfg(feature = "draw")]
pub mod draw;
pub mod map;
pub mod mathematics;
pub mod mission;
pub mod radio;
pub mod record;
pub mod registry;
#[cfg(feature = "record")]
pub mod replay;
pub mod run;
pub mod scene;
pub mod seed;
pub mod sense;
#[cfg(feature = "sweep")]
pub mod sweep;
pub mod world;
