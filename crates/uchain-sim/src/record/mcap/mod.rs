//! Recordings: a run in one MCAP file, to look at in Foxglove or Rerun, to read back, to fly again.
//!
//! [`McapRecorder`] writes, [`Recording`] reads. mcap and foxglove live here only. What is in the file:
//!
//! | where | what |
//! |---|---|
//! | metadata `uchain` | the whole scenario in TOML, seed, version, mathematics, place of the map; see [`About`] |
//! | attachment `walls.csv` | the walls, corner by corner |
//! | `/frame` | [`Frame`](crate::record::Frame), every bit, 20 per simulated second; `uchain.proto` |
//! | `/metrics` | [`Moment`](crate::record::Moment), one per decision; `uchain.proto` |
//! | `/tf` | `foxglove.FrameTransforms`: `scenario` → `map` → `uav_0`, `uav_1`, … |
//! | `/poses` | `foxglove.PosesInFrame`, all UAVs |
//! | `/tof/uav_0`, … | `foxglove.LaserScan`, the four beams |
//! | `/hits` | `foxglove.PointCloud`, where beams ended |
//! | `/map`, `/uavs`, `/links` | `foxglove.SceneUpdate`: walls and base once; bodies at every change; links, coloured by loss |
//! | `/log` | `foxglove.Log`: take-offs, failures, contacts, links lost and found |
//!
//! Of an exploration ([`ExploreRecorder`]):
//!
//! | where | what |
//! |---|---|
//! | metadata `uchain`, attachment `walls.csv` | as above |
//! | `/frame` | [`ExploreFrame`](crate::record::ExploreFrame), every bit, 20 per simulated second; `uchain.proto` |
//! | `/metrics` | [`Progress`](crate::record::Progress), one per round; `uchain.proto` |
//! | `/tf`, `/poses` | `foxglove.FrameTransforms`, `foxglove.PosesInFrame`: `robot_0`, `robot_1`, … |
//! | `/map`, `/robots` | `foxglove.SceneUpdate`: walls and bodies, once |
//! | `/stars`, `/graph`, `/ways` | `foxglove.SceneUpdate`: stars with their frontiers at every change; new edges; ways round by round |
//! | `/log` | `foxglove.Log`: what each robot is about, contacts, the end |
//!
//! `log_time` is simulated time (ns). Foxglove's messages come ten times per simulated second. Chunks hold 64 KiB and
//! are not compressed: they compress to a third at best, and the compressors mcap knows are C libraries. Everything
//! is covered by a checksum.

mod about;
mod message;
mod read;
mod schema;
#[cfg(test)]
mod tests;
mod write;

pub use about::About;
pub use message::Recordable;
pub use read::{AnyRecording, End, Frames, PlayError, ReadError, Recording};
pub use write::{ExploreRecorder, McapRecorder};

/// Topic of `uchain.Frame`.
const FRAME_TOPIC: &str = "/frame";
