//! A swarm simulator in which radio is the sensor that matters: the world around [`uchain_core`], that is tunnels and
//! buildings, sensors, radio, contacts, missions, and what is seen of them.
//!
//! # Fly a mission
//!
//! ```
//! use uchain_libm as _; // the same bits on every system
//! use uchain_sim::{config::builtin, mission::chain::Course, run::run};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A scenario is TOML: one that comes along, with a key written over it. `Source::find` reads a file.
//! let corner = builtin("corner").ok_or("corner comes along")?;
//! let course = Course::read(&corner, &["radio.sigma_db=2".to_owned()])?;
//! // A run is a function of the course and a seed. Nobody (`()`) watches its frames here.
//! let summary = run(&course, 1, &mut ())?;
//! assert_eq!(summary.verdict.outcome().word(), "completed");
//! assert_eq!(summary.links.len(), 3);
//! assert_eq!(run(&course, 1, &mut ())?, summary);
//!
//! // A mistake is answered with its place and the nearest name.
//! let error = Course::read(&corner, &["radio.sigma=2".to_owned()]).unwrap_err();
//! assert!(error.to_string().contains("did you mean 'sigma_db'?"));
//! # Ok(())
//! # }
//! ```
//!
//! [`sweep::Sweep`] flies thousands of runs on all processors, in memory or into a folder; `examples/` of the project has
//! whole programs, each of which is run by the project's tests.
//!
//! # Answers of one's own
//!
//! | question | trait | gets into a scenario by |
//! |---|---|---|
//! | how does a UAV of a chain decide | [`uchain_core::chain::Brain`] | [`ChainExtensions`](mission::chain::ChainExtensions) |
//! | what does a link lose between two places | [`radio::RadioModel`] | both of them |
//! | where does an explorer fly next | [`uchain_core::explore::Strategy`] | [`SiteExtensions`](mission::explore::SiteExtensions) |
//! | what is flown, and when is it over | [`mission::Mission`] | a line in a [`registry::Registry`] |
//! | who steers the head | [`pilot::Pilot`] | an argument of [`run::run_with`] |
//! | who watches the frames | [`record::Recorder`] | an argument of [`run::run`] |
//! | where do the bytes of a recording go | `record::Sink` | an argument of a recorder |
//!
//! # Modules
//!
//! One tick is five words: *sense, decide, act, advance, record*. Read [`mission`] first, and then one of its missions. No
//! module imports one that imports it:
//!
//! | module | what it is |
//! |---|---|
//! | [`clock`], [`seed`] | ticks of 0.05 s; one seed, and an independent stream of random numbers for every use of chance |
//! | [`map`] | walls, what is inside rock, distances along the tunnel; map files |
//! | [`pilot`] | who steers: a script, another thread, a function, nobody |
//! | [`world`] | bodies, how they move, what they touch: the only one that moves anything |
//! | [`sense`], [`radio`] | what robots measure and hear |
//! | [`config`], [`scene`] | scenarios: keys, presets, mistakes, help; laid out in their map |
//! | [`record`] | frames and who watches them; MCAP recordings |
//! | [`analyse`] | digest, optimum of a chain, statistics, verdicts |
//! | [`mission`] | a chain, an exploration, one's own |
//! | `log` | the node alone, fed with the log of a real flight |
//! | `radio_fit` | logs of losses: exponent, shadowing, noise, with intervals |
//! | [`radio_map`] | losses from one place to all others, and along a tunnel |
//! | [`run`], [`registry`], `replay`, [`mod@sweep`] | one run, runs of whatever mission, recordings flown again, many runs |
//! | `draw` | pictures |
//! | [`mathematics`] | whose `exp` and `sin` the program computes with |
//!
//! # Features
//!
//! All but the last are on by default. None changes a bit of a run.
//!
//! | feature | what it brings |
//! |---|---|
//! | `maps` | ROS `map_server` and MovingAI maps, PNG and PNM pictures |
//! | `draw` | pictures: the module `draw` |
//! | `record` | recordings as MCAP files: `record::mcap` and `replay` |
//! | `sweep` | the module `sweep`, and the table it leaves (Parquet) |
//! | `log` | the module `log`: logs of real flights, decided again |
//! | `fit` | the module `radio_fit`: the radio that a log of losses tells of |
//! | `schema` | JSON Schema of scenarios, and help on every key |
//! | `oracles` | slow ways that the project's tests compare with; no promise is made of them |
//!
//! # Determinism
//!
//! The same scenario, seed and inputs give the same bits: in debug and release, on one thread or many, whoever watches.
//! [`analyse::Digest`] is a hash of them all, and the project's tests hold runs to it. One thing is up to the program:
//! rapier and parry ask the system's `exp`, `sin` and `log`, whose last bits depend on C library and processor. The line
//! `use uchain_libm as _;` brings a program its own. Linking this crate changes none of them; [`mathematics`] tells whether
//! the program did.
//!
//! # Errors
//!
//! No scenario, map, recording or table panics: each has an error with file, line and key or place
//! ([`config::ConfigError`], [`map::MapError`], `record::mcap::ReadError`, `sweep::DesignError`). How a run went is no
//! error but an [`analyse::Outcome`].
//!
//! # Limits
//!
//! Two dimensions, white noise, no interference between radios, clocks that agree, contacts that break nothing, downwash
//! that is counted and not felt: the project's `docs/limits.md` has all of it, and what each may cost a study.

#[cfg(test)]
use uchain_libm as _;

/// The vectors of our signatures: a program that uses this one has the same version.
pub use glam;

pub mod analyse;
pub mod clock;
pub mod config;
#[cfg(feature = "draw")]
pub mod draw;
#[cfg(feature = "log")]
pub mod log;
pub mod map;
pub mod mathematics;
pub mod mission;
pub mod pilot;
pub mod radio;
#[cfg(feature = "fit")]
pub mod radio_fit;
pub mod radio_map;
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
