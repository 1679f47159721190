//! What a node believes, for telemetry.

use uchain_core::chain::{self, Brain as _, LinkEstimate};

use crate::{
    Node, Observation, Status, UCHAIN_NO_PLACE,
    choice::{Follow, Override, Role, Stage, Walls},
    node::{Inner, inner},
    pointer,
};

/// What a node believes, and why it asks for what it asks: for telemetry, nothing in a flight depends on it. NaN: not known
/// yet.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Explanation {
    /// Filtered loss of the link toward the base (dB).
    pub back_filtered_db: f32,
    /// Variance of that estimate (dB²).
    pub back_variance_db2: f32,
    /// Loss of the last packet from there, as measured (dB).
    pub back_raw_db: f32,
    /// For how long nothing has been heard from there (s).
    pub back_silent_s: f32,
    /// Filtered loss of the link toward the head (dB).
    pub front_filtered_db: f32,
    /// Variance of that estimate (dB²).
    pub front_variance_db2: f32,
    /// Loss of the last packet from there, as measured (dB).
    pub front_raw_db: f32,
    /// For how long nothing has been heard from there (s).
    pub front_silent_s: f32,
    /// Loss of the front link minus that of the back link (dB): what it levels.
    pub imbalance_db: f32,
    /// Forward speed that its law, or its pilot, wishes (m/s).
    pub wish_mps: f32,
    /// Forward speed by its laws and overrides, before it slows down near walls (m/s); NaN while it cannot fly freely.
    pub allowed_mps: f32,
    /// Share of its forward speed that its distances to the walls leave it (0 to 1).
    pub speed_share: f32,
    /// Its place in the chain, 0 leads it; `UCHAIN_NO_PLACE` if it was never told.
    pub place: u16,
    /// What it is in the chain: one of `UCHAIN_ROLE_…`.
    pub role: u8,
    /// What it is doing: one of `UCHAIN_STAGE_…`.
    pub stage: u8,
    /// What its wish was overridden by: one of `UCHAIN_OVERRIDE_…`.
    pub overridden: u8,
    /// The wall choice it flies by: one of `UCHAIN_FOLLOW_…`.
    pub follow: u8,
    /// The walls that its centering steers by, given the distances of the observation: one of `UCHAIN_WALLS_…`.
    pub walls: u8,
}

/// What a node believes after `uchain_step` with this observation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_explain(
    node: *const Node,
    observation: *const Observation,
    explanation: *mut Explanation,
) -> Status {
    // SAFETY: as C was asked.
    let (node, observation, explanation) =
        unsafe { (inner(node), pointer::read(observation), pointer::write(explanation)) };
    match (node, observation, explanation) {
        (Ok(node), Ok(observation), Ok(into)) => match node.explain(observation) {
            Ok(explanation) => {
                *into = explanation;
                Status::Ok
            }
            Err(status) => status,
        },
        (Err(status), ..) | (_, Err(status), _) | (.., Err(status)) => status,
    }
}

impl Inner {
    fn explain(&self, observation: &Observation) -> Result<Explanation, Status> {
        let mut seen = chain::Observation::default();
        observation.show(&mut seen)?;
        // A node explains itself whatever it sees.
        let why = self.node.explain(&seen).ok_or(Status::NotInitialised)?;
        let LinkEstimate { filtered_db, raw_db, silent_s } = why.estimates.back;
        let front = why.estimates.front;
        Ok(Explanation {
            back_filtered_db: number(filtered_db),
            back_variance_db2: number(why.back_variance_db2),
            back_raw_db: number(raw_db),
            back_silent_s: number(silent_s),
            front_filtered_db: number(front.filtered_db),
            front_variance_db2: number(why.front_variance_db2),
            front_raw_db: number(front.raw_db),
            front_silent_s: number(front.silent_s),
            imbalance_db: number(why.imbalance_db),
            wish_mps: why.wish_mps,
            allowed_mps: number(why.estimates.allowed_mps),
            speed_share: why.speed_share,
            place: why.place.unwrap_or(UCHAIN_NO_PLACE),
            role: Role::of(why.role),
            stage: Stage::of(why.stage),
            overridden: Override::of(why.overridden),
            follow: Follow::of(why.follow),
            walls: Walls::of(why.walls),
        })
    }
}

fn number(known: Option<f32>) -> f32 {
    known.unwrap_or(f32::NAN)
}
