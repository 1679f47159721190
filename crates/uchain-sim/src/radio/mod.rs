//! Radio in two questions: how much a link loses ([`RadioModel`]), and what is heard over it ([`Channel`]).
//!
//! A model knows no time: the optimum, a plan and a run ask the same one, but for what the seed of a run adds to it. A channel belongs to one run; noise, random
//! losses and planned faults are channels around each other. No law asks a model, and no optimum a channel.

mod around;
mod budget;
mod channel;
mod disc;
mod faults;
mod model;
mod models;
mod packets;
mod params;
mod path_loss;

pub use around::Shadowed;
pub(crate) use around::around;
pub use budget::{BudgetError, Budgeted, LinkBudget, Threshold};
pub use channel::{Channel, Link, Received, Side, channel};
pub use disc::Disc;
pub use faults::{Dead, Deaf, DeafSide, FaultConfig};
pub(crate) use model::finite_db;
pub use model::{Antenna, MakeRadio, NO_LINK_DB, RadioError, RadioKind, RadioModel};
pub use models::{LossTable, MultiWall, Slopes, TableError, Visibility};
pub use packets::PacketParams;
pub use params::{Detour, Fading, RadioParams, Shadowing};
pub use path_loss::PathLoss;
