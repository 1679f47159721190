//! What the pilot of a flight by hand asked for, as a message.

use uchain_core::chain::{Follow, PilotInput};

use crate::{
    mission::chain::PilotStep,
    pilot::Asked,
    record::mcap::{Described, number, word},
};

/// What describes it.
pub(super) const INPUT: Described =
    Described { message: "PilotInput", file: "pilot.proto", proto: include_str!("pilot.proto") };

/// Words by their numbers in `pilot.proto`.
const FOLLOWS: [Follow; 3] = [Follow::Centre, Follow::Left, Follow::Right];

/// `uchain.PilotInput`.
#[derive(Clone, Copy, PartialEq, prost::Message)]
pub(super) struct InputMessage {
    #[prost(float, tag = "1")]
    speed_mps: f32,
    #[prost(uint32, tag = "2")]
    follow: u32,
    #[prost(uint32, tag = "3")]
    leader: u32,
    #[prost(bool, tag = "4")]
    is_held: bool,
}

impl InputMessage {
    /// What was asked for anew, and who leads the chain; `None` where there is nothing to say: nothing new, and it is UAV 0.
    pub(super) fn of(input: Option<PilotInput>, leader: usize) -> Option<Self> {
        if input.is_none() && leader == 0 {
            return None;
        }
        let PilotInput { speed_mps, follow } = input.unwrap_or_default();
        let follow = number(&FOLLOWS, follow);
        Some(Self { speed_mps, follow, leader: leader as u32, is_held: input.is_none() })
    }

    /// What was asked for anew, and who leads the chain.
    pub(super) fn taken(self) -> Result<(Option<PilotInput>, usize), String> {
        let leader = self.leader as usize;
        if self.is_held {
            return Ok((None, leader));
        }
        let input = PilotInput { speed_mps: self.speed_mps, follow: word("follow", &FOLLOWS, self.follow)? };
        PilotStep::from(Asked { tick: 0, input }).check().map_err(|error| error.to_string())?;
        Ok((Some(input), leader))
    }
}
