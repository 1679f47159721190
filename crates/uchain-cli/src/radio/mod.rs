//! `uchain radio`: what a log of losses says about a radio, and what a radio loses over a map.

mod args;
mod fit;
mod map;

use uchain_sim::registry::Registry;

use crate::exit::Failure;
pub(crate) use args::{EXAMPLES, Radio};

pub(crate) fn radio(registry: Registry, asked: &Radio) -> Result<(), Failure> {
    match asked {
        Radio::Fit(asked) => fit::fit(registry, asked),
        Radio::Map(asked) => map::map(registry, asked),
    }
}
