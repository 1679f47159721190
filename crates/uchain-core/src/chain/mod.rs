//! The chain of relays: one law per file, each with its Params, and the node that composes them.

mod center;
mod doing;
mod equalize;
mod explain;
mod guard;
mod kalman;
mod link;
mod node;
mod seam;
mod takeoff;

pub use center::{CenterLaw, CenterParams, Centering, Walls, center};
pub use doing::{Doing, LaunchHold, PendingLaunch, WallSide};
pub use equalize::{EqualizeParams, SpeedLaw, equalize};
pub use explain::{Explanation, Stage};
pub use guard::{HeadGuard, Override, RelayGuard};
pub use kalman::{KalmanParams, ScalarKalman};
pub use link::{End, Gap, LinkEnd, LinkParams, Signal};
pub use node::{Levelling, Node, NodeParams, Role};
pub use seam::{
    BASE_ID, Brain, Command, Estimates, Follow, HEARD_MAX, Heard, LinkEstimate, Observation, Packet,
    PilotInput, RadioSlot, TOF_RANGE_M, Tof,
};
pub use takeoff::{Launch, Takeoff, TakeoffParams};
