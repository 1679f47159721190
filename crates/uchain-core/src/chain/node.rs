//! A UAV of the chain: waits, takes off, and flies by the laws (Laclau 2021, Algorithm 1 and §4.3).

use super::{
    CenterParams, Centering, Command, End, EqualizeParams, Follow, HeadGuard, KalmanParams, LinkEnd,
    LinkParams, Observation, Packet, RadioSlot, RelayGuard, Signal, TOF_RANGE_M, Takeoff, TakeoffParams,
    center, equalize,
};
use crate::bounded;
use crate::seam::Brain;

/// A node's place in the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The explorer: flies as its pilot asks, as long as its back link holds.
    Head,
    /// Levels its two links.
    Relay,
}

/// The Params of every law a node flies by, and what it has to know of its sensors.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeParams {
    /// Filter of each link end.
    pub kalman: KalmanParams,
    /// Leveling of the two links.
    pub equalize: EqualizeParams,
    /// Staying in mid-tunnel.
    pub center: CenterParams,
    /// Leaving the ground.
    pub takeoff: TakeoffParams,
    /// Lost and bad links.
    pub link: LinkParams,
    /// What a ToF sensor reads that sees nothing (m).
    pub tof_range_m: f32,
}

impl Default for NodeParams {
    fn default() -> Self {
        Self {
            kalman: KalmanParams::default(),
            equalize: EqualizeParams::default(),
            center: CenterParams::default(),
            takeoff: TakeoffParams::default(),
            link: LinkParams::default(),
            tof_range_m: TOF_RANGE_M,
        }
    }
}

/// The brain of one UAV.
///
/// ```
/// use uchain_core::{chain::{Node, NodeParams, Observation, PilotInput, RadioSlot, Role}, seam::Brain};
/// let mut head = Node::new(Role::Head, NodeParams::default());
/// let pilot = PilotInput { speed_mps: 0.2, ..PilotInput::default() };
/// let seen = Observation { radio: Some(RadioSlot::default()), pilot: Some(pilot), ..Observation::default() };
/// assert!(head.decide(&seen).airborne); // the head takes off at its first decision
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    role: Role,
    params: NodeParams,
    airborne: bool,
    /// Decisions in the air: counted, for sums of periods would drift.
    flown: u32,
    takeoff: Takeoff,
    back: LinkEnd,
    front: LinkEnd,
    head_guard: HeadGuard,
    relay_guard: RelayGuard,
    centering: Centering,
    forward_mps: f32,
    follow: Follow,
    imbalance_db: f32,
}

impl Node {
    /// A node on the ground.
    pub fn new(role: Role, params: NodeParams) -> Self {
        Self {
            role,
            params,
            airborne: false,
            flown: 0,
            takeoff: Takeoff::default(),
            back: LinkEnd::new(End::Front),
            front: LinkEnd::new(End::Rear),
            head_guard: HeadGuard::default(),
            relay_guard: RelayGuard::default(),
            centering: Centering::default(),
            forward_mps: 0.0,
            follow: Follow::Centre,
            imbalance_db: 0.0,
        }
    }

    /// What it tells its neighbours, given its present ground speed.
    pub fn say(&self, ground_speed_mps: f32) -> Packet {
        Packet {
            ground_speed_mps,
            flown_s: self.flown_s(),
            follow: self.follow,
            imbalance_db: self.imbalance_db,
            is_base: false,
        }
    }

    /// For how long it has been in the air (s).
    fn flown_s(&self) -> f32 {
        self.flown as f32 * self.params.equalize.decision_s
    }

    /// Filtered loss of the link toward the base (dB); `None` before its first packet.
    pub fn back_loss_db(&self) -> Option<f32> {
        self.back.loss_db()
    }

    /// Loss of the last packet over the link toward the base, as measured (dB); `None` before its first packet.
    pub fn back_raw_db(&self) -> Option<f32> {
        self.back.signal_db(Signal::Raw)
    }

    /// Filtered loss of the link toward the head (dB); `None` before its first packet.
    pub fn front_loss_db(&self) -> Option<f32> {
        self.front.loss_db()
    }

    /// How long it has heard nothing from the base's side (s); `None` before its first packet from there.
    pub fn back_silent_s(&self) -> Option<f32> {
        self.back.silent_s()
    }

    /// How long it has heard nothing from the head's side (s); `None` before its first packet from there.
    pub fn front_silent_s(&self) -> Option<f32> {
        self.front.silent_s()
    }

    /// Forward speed by its laws and overrides, before it slows down near walls (m/s); `None` on the ground, and until it
    /// has risen and hovered.
    pub fn allowed_mps(&self) -> Option<f32> {
        self.has_settled().then_some(self.forward_mps)
    }

    fn has_settled(&self) -> bool {
        let settled_s = self.params.takeoff.rise_s + self.params.takeoff.hover_s;
        self.airborne && self.flown_s() >= settled_s
    }

    /// One decision period on the ground.
    fn wait(&mut self, radio: &RadioSlot) {
        let p = &self.params;
        let period_s = p.equalize.decision_s;
        self.front.hear(radio.front.as_ref(), None, period_s, &p.kalman, &p.link);
        self.airborne = match self.role {
            Role::Head => true,
            // Silence is no news: it neither launches nor counts against a launch.
            Role::Relay => {
                radio.front.is_some()
                    && self.front.signal_db(p.takeoff.launch_signal).is_some_and(|loss_db| {
                        self.takeoff.due(loss_db, &self.front.neighbour(), period_s, &p.takeoff)
                    })
            }
        };
    }

    /// One decision period in the air: filter both links, then choose a forward speed.
    fn fly(&mut self, radio: &RadioSlot, seen: &Observation) {
        let p = &self.params;
        let period_s = p.equalize.decision_s;
        let own_mps = if seen.ground_speed_mps.is_finite() { seen.ground_speed_mps } else { 0.0 };
        self.back.hear(radio.back.as_ref(), Some(own_mps), period_s, &p.kalman, &p.link);
        self.front.hear(radio.front.as_ref(), Some(own_mps), period_s, &p.kalman, &p.link);
        self.flown = self.flown.saturating_add(1);
        let wish_mps = match self.role {
            Role::Head => {
                let pilot = seen.pilot.unwrap_or_default();
                self.follow = pilot.follow;
                let speed_mps = pilot.speed_mps;
                let wish_mps = if speed_mps.is_finite() { speed_mps } else { 0.0 };
                self.head_guard.limit(wish_mps, &self.back, &p.link)
            }
            Role::Relay => {
                let ahead = self.front.neighbour();
                self.follow = ahead.follow;
                let both = self.back.signal_db(p.link.signal).zip(self.front.signal_db(p.link.signal));
                let own_db = both.map_or(0.0, |(back_db, front_db)| (back_db - front_db).abs());
                self.imbalance_db = own_db.max(ahead.imbalance_db);
                let wish_mps =
                    both.map_or(0.0, |(back_db, front_db)| equalize(back_db, front_db, &p.equalize));
                self.relay_guard.limit(wish_mps, &self.back, &self.front, &p.link)
            }
        };
        self.forward_mps = bounded(wish_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
    }

    fn command(&self) -> Command {
        if !self.has_settled() {
            return Command { airborne: self.airborne, ..Command::default() };
        }
        let c = &self.centering;
        Command {
            forward_mps: self.forward_mps * c.speed_share,
            lateral_mps: c.lateral_mps,
            yaw_rate_radps: c.yaw_rate_radps,
            airborne: true,
        }
    }
}

impl Brain for Node {
    type Observation = Observation;
    type Command = Command;

    fn decide(&mut self, seen: &Observation) -> Command {
        if let Some(radio) = &seen.radio {
            if self.airborne {
                self.fly(radio, seen);
            } else {
                self.wait(radio);
            }
        }
        if let Some(tof) = &seen.tof {
            let p = &self.params;
            self.centering = center(tof, p.tof_range_m, self.forward_mps < 0.0, self.follow, &p.center);
        }
        self.command()
    }
}
