//! What a chain node may know and ask: plain numbers, no position.

/// Range of the authors' ToF sensor (m), VL53L1x (Laclau 2021, §6.2).
pub const TOF_RANGE_M: f32 = 2.0;

/// Distances along the four diagonal ToF beams (m); a beam without a return reads its range limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tof {
    /// Front left, +45°.
    pub nw_m: f32,
    /// Front right, −45°.
    pub ne_m: f32,
    /// Rear left, +135°.
    pub sw_m: f32,
    /// Rear right, −135°.
    pub se_m: f32,
}

/// Which wall to follow; the pilot's choice, repeated down the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Follow {
    /// Keep to the middle (Laclau 2021, Eq. 20).
    #[default]
    Centre,
    /// Keep the left wall (Eq. 21).
    Left,
    /// Keep the right wall (Eq. 21).
    Right,
}

/// What a neighbour says of itself in a packet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Packet {
    /// Its forward ground speed by optic flow (m/s); 0 from the base.
    pub ground_speed_mps: f32,
    /// For how long it has been in the air (s); 0 from the base.
    pub flown_s: f32,
    /// The wall choice it flies by.
    pub follow: Follow,
    /// Largest imbalance of two links from here to the head, by the relays' own estimates (dB).
    pub imbalance_db: f32,
    /// The sender is the base station, which stands still.
    pub is_base: bool,
}

impl Packet {
    /// What the base station says.
    pub const BASE: Self = Self {
        ground_speed_mps: 0.0,
        flown_s: 0.0,
        follow: Follow::Centre,
        imbalance_db: 0.0,
        is_base: true,
    };
}

/// One packet as received.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heard {
    /// Measured loss of the link (dB), bigger is worse: the negated RSSI reading in dBm.
    pub loss_db: f32,
    /// What the sender said.
    pub packet: Packet,
}

/// What the radio brought in one decision period; `None` = nothing heard from that side.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadioSlot {
    /// From the neighbour toward the base.
    pub back: Option<Heard>,
    /// From the neighbour toward the head.
    pub front: Option<Heard>,
}

/// What the pilot of the head asks for: a speed and a wall, nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PilotInput {
    /// Forward speed, negative backward (m/s).
    pub speed_mps: f32,
    /// Wall to follow.
    pub follow: Follow,
}

/// All a chain node may know at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Observation {
    /// A new set of distances, at the ToF rate; `None` in between.
    pub tof: Option<Tof>,
    /// A decision is due, with what the radio brought since the last one; `None` in between.
    pub radio: Option<RadioSlot>,
    /// Own forward ground speed by optic flow (m/s).
    pub ground_speed_mps: f32,
    /// The pilot's wish; only the head has a pilot.
    pub pilot: Option<PilotInput>,
}

/// All a chain node may ask of its body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Command {
    /// Forward velocity (m/s).
    pub forward_mps: f32,
    /// Leftward velocity (m/s).
    pub lateral_mps: f32,
    /// Yaw rate, counter-clockwise (rad/s).
    pub yaw_rate_radps: f32,
    /// In the air, or asking to be.
    pub airborne: bool,
}
