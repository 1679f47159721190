//! The chain of relays: one law per file, each with its Params, and the node that composes them.

mod center;
mod equalize;
mod guard;
mod kalman;
mod link;
mod node;
mod seam;
mod takeoff;

pub use center::{CenterLaw, CenterParams, Centering, center};
pub use equalize::{EqualizeParams, SpeedLaw, equalize};
pub use guard::{HeadGuard, RelayGuard};
pub use kalman::{KalmanParams, ScalarKalman};
pub use link::{End, Gap, LinkEnd, LinkParams, Signal};
pub use node::{Node, NodeParams, Role};
pub use seam::{Command, Follow, Heard, Observation, Packet, PilotInput, RadioSlot, TOF_RANGE_M, Tof};
pub use takeoff::{Launch, Takeoff, TakeoffParams};
