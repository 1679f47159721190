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
}

impl From<PilotInput> for InputMessage {
    fn from(input: PilotInput) -> Self {
        Self { speed_mps: input.speed_mps, follow: number(&FOLLOWS, input.follow) }
    }
}

impl TryFrom<InputMessage> for PilotInput {
    type Error = String;

    fn try_from(message: InputMessage) -> Result<Self, String> {
        let input = Self { speed_mps: message.speed_mps, follow: word("follow", &FOLLOWS, message.follow)? };
        PilotStep::from(Asked { tick: 0, input }).check().map_err(|error| error.to_string())?;
        Ok(input)
    }
}
