//! The chain of relays: one law per file, each with its Params, and the node that composes them.

mod center;
mod equalize;
mod kalman;
mod link;
mod node;
mod seam;
mod takeoff;

pub use center::{CenterParams, Centering, center};
pub use equalize::{EqualizeParams, equalize};
pub use kalman::{KalmanParams, ScalarKalman};
pub use link::{End, HeadGuard, LinkEnd, LinkParams, RelayGuard};
pub use node::{Node, NodeParams, Role};
pub use seam::{Command, Follow, Heard, Observation, Packet, Pilot, RadioSlot, Tof};
pub use takeoff::{Takeoff, TakeoffParams};
