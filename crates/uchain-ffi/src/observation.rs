//! The seam as C sees it: what a node is shown, and what it asks for.

use uchain_core::chain;

use crate::{
    Status,
    choice::{self, Follow},
};

/// All a chain node may know at one instant. Axes: x forward, y left, angles counter-clockwise. Fill it with zeros first:
/// then nothing is measured. What is not a finite number counts as not measured.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Observation {
    /// Distance front left, along the beam at +45° (m). A beam without a return reads `tof_range_m`; so does one that is
    /// negative or not finite. This and the other three count if `has_tof` is 1.
    pub tof_nw_m: f32,
    /// Distance front right, along the beam at -45° (m).
    pub tof_ne_m: f32,
    /// Distance rear left, along the beam at +135° (m).
    pub tof_sw_m: f32,
    /// Distance rear right, along the beam at -135° (m).
    pub tof_se_m: f32,
    /// Own forward ground speed by optic flow (m/s), negative backward. It counts if `has_ground_speed` is 1.
    pub ground_speed_mps: f32,
    /// Share of the own battery's charge that is left (0 to 1). It counts if `has_battery` is 1.
    pub battery: f32,
    /// Forward speed that the pilot asks for (m/s), negative backward. It counts if `has_pilot` is 1; only the head has a
    /// pilot.
    pub pilot_speed_mps: f32,
    /// Place in the chain (0 to 65,533): 0 leads it, larger ones are nearer to the base. It counts if `has_place` is 1; else the
    /// place is what it was.
    pub place: u16,
    /// Wall that the pilot chooses: one of `UCHAIN_FOLLOW_…`. It counts if `has_pilot` is 1.
    pub pilot_follow: u8,
    /// 1 if `place` is told, else 0.
    pub has_place: u8,
    /// 1 if there is a new set of distances: at the rate of the sensors, 10 Hz say. Else 0.
    pub has_tof: u8,
    /// 1 if a decision is due, every `equalize_decision_s`: what `uchain_hear` collected goes into it, and silence counts.
    /// Else 0.
    pub is_decision_due: u8,
    /// 1 if the ground speed was measured, else 0.
    pub has_ground_speed: u8,
    /// 1 if the battery's charge was measured, else 0.
    pub has_battery: u8,
    /// 1 if there is a pilot, else 0.
    pub has_pilot: u8,
}

/// All a chain node may ask of its body. Axes: x forward, y left, angles counter-clockwise.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
pub struct Command {
    /// Forward velocity (m/s), negative backward; at most `equalize_v_max_mps`.
    pub forward_mps: f32,
    /// Leftward velocity (m/s), negative to the right.
    pub lateral_mps: f32,
    /// Yaw rate, counter-clockwise seen from above (rad/s).
    pub yaw_rate_radps: f32,
    /// 1: take off if it stands on the ground, and stay in the air; 0: stay on the ground.
    pub airborne: u8,
}

impl Observation {
    /// Writes what the core is shown, without radio. In place: it is the largest thing on the stack, for it has room for all
    /// that may be heard.
    pub(crate) fn show(&self, seen: &mut chain::Observation) -> Result<(), Status> {
        let has = |byte| choice::switch(byte).ok_or(Status::BadChoice);
        let given = |byte, value: f32| has(byte).map(|has| (has && value.is_finite()).then_some(value));
        has(self.is_decision_due)?;
        seen.place = has(self.has_place)?.then_some(self.place);
        // The last two are the base's, and that of a relay that was told none.
        if seen.place.is_some_and(|place| place >= chain::Packet::BASE_PLACE - 1) {
            return Err(Status::OutOfRange);
        }
        seen.tof = has(self.has_tof)?.then_some(chain::Tof {
            nw_m: self.tof_nw_m,
            ne_m: self.tof_ne_m,
            sw_m: self.tof_sw_m,
            se_m: self.tof_se_m,
        });
        seen.ground_speed_mps = given(self.has_ground_speed, self.ground_speed_mps)?;
        seen.battery = given(self.has_battery, self.battery)?;
        if has(self.has_pilot)? {
            let follow = Follow::read(self.pilot_follow).ok_or(Status::BadChoice)?;
            seen.pilot = Some(chain::PilotInput { speed_mps: self.pilot_speed_mps, follow });
        }
        Ok(())
    }
}

impl Command {
    pub(crate) fn of(command: chain::Command) -> Self {
        let chain::Command { forward_mps, lateral_mps, yaw_rate_radps, airborne } = command;
        Self { forward_mps, lateral_mps, yaw_rate_radps, airborne: airborne.into() }
    }
}
