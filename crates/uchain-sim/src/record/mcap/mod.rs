//! Recordings: a run in one MCAP file, to look at in Foxglove or Rerun, to read back, to fly again.
//!
//! [`McapRecorder`] writes, [`Opened`] reads. mcap and foxglove live here only. What is said is made by [`MessageRecorder`]
//! and a mission's [`Topics`]; where it goes is up to a [`Sink`](crate::record::Sink). What is in the file:
//!
//! | where | what |
//! |---|---|
//! | metadata `uchain` | the whole scenario in TOML, seed, version, mathematics, place of the map; see [`About`] |
//! | attachment `walls.csv` | the walls, corner by corner |
//! | `/frame` | `Frame`, every bit, 20 per simulated second; `uchain.proto` |
//! | `/metrics` | `Moment`, one per decision; `uchain.proto` |
//! | `/pilot` | `PilotInput`, in a flight by hand whenever it changes; `pilot.proto` |
//! | `/tf` | `foxglove.FrameTransforms`: `scenario` → `map` → `uav_0`, `uav_1`, … |
//! | `/poses` | `foxglove.PosesInFrame`, all UAVs |
//! | `/tof/uav_0`, … | `foxglove.LaserScan`, the four beams |
//! | `/hits` | `foxglove.PointCloud`, where beams ended |
//! | `/map`, `/uavs`, `/links` | `foxglove.SceneUpdate`: walls and base once; bodies at every change; links, coloured by loss |
//! | `/points/walls`, `/points/uavs`, `/points/links` | `foxglove.PointCloud`: the same as points, for viewers that draw no lines |
//! | `/log` | `foxglove.Log`: take-offs, failures, contacts, links lost and found, overrides, invalid walls, launches |
//!
//! Of an exploration:
//!
//! | where | what |
//! |---|---|
//! | metadata `uchain`, attachment `walls.csv` | as above |
//! | `/frame` | `ExploreFrame`, every bit, 20 per simulated second; `uchain.proto` |
//! | `/metrics` | `Progress`, one per round; `uchain.proto` |
//! | `/tf`, `/poses` | `foxglove.FrameTransforms`, `foxglove.PosesInFrame`: `robot_0`, `robot_1`, … |
//! | `/map`, `/robots` | `foxglove.SceneUpdate`: walls and bodies, once |
//! | `/points/walls`, `/points/robots` | `foxglove.PointCloud`: the same as points |
//! | `/stars`, `/graph`, `/ways` | `foxglove.SceneUpdate`: stars with their frontiers at every change; new edges; ways round by round |
//! | `/log` | `foxglove.Log`: what each robot is about, contacts, the end |
//!
//! `log_time` is simulated time (ns). Foxglove's messages come ten times per simulated second, points five times. Chunks hold 64 KiB and
//! are not compressed: they compress to a third at best, and the compressors mcap knows are C libraries. Everything
//! is covered by a checksum.

pub(crate) mod about;
mod message;
mod out;
mod read;
mod recorder;
pub mod scene;
mod schema;
mod writer;

pub use about::{About, walls_from_csv, walls_to_csv};
pub use message::{Described, Recordable, alike, bounded, few, number, set, small, word};
pub use out::Out;
pub use read::{End, Frames, Opened, PlayError, ReadError};
pub use recorder::{McapRecorder, MessageRecorder, Topics};
pub use writer::McapWriter;

pub use crate::record::Channel;

/// Topic of the frames.
pub const FRAME_TOPIC: &str = "/frame";

/// Topic of what a pilot asked for.
pub const PILOT_TOPIC: &str = "/pilot";

/// Foxglove's messages come at every second tick: 10 per simulated second.
pub const SHOWN_TICKS: u64 = 2;

/// Points for viewers that draw no lines come at every fourth tick, 5 per simulated second: they are larger than what they
/// stand for.
pub const POINTS_TICKS: u64 = 4;
