//! A UAV of the chain: waits, takes off, and flies by the laws (Laclau 2021, Algorithm 1 and §4.3).

use super::{
    Brain, CenterParams, Centering, Command, End, EqualizeParams, Estimates, Explanation, Follow, HeadGuard,
    KalmanParams, LinkEnd, LinkEstimate, LinkParams, Observation, Packet, RadioSlot, RelayGuard, Signal,
    Stage, TOF_RANGE_M, Takeoff, TakeoffParams, center, center::walls_of, equalize,
};
use crate::bounded;

/// What a node does in the chain.
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

/// The brain of one UAV. Whoever has place 0 of the chain is its head: what a node was made as holds until it is told its
/// place ([`Observation::place`]). A relay that was told none yet believes to be the last one before the base.
///
/// ```
/// use uchain_core::chain::{Brain, Node, NodeParams, Observation, PilotInput, RadioSlot, Role};
/// let mut head = Node::new(Role::Head, NodeParams::default());
/// let pilot = PilotInput { speed_mps: 0.2, ..PilotInput::default() };
/// let seen = Observation { radio: Some(RadioSlot::default()), pilot: Some(pilot), ..Observation::default() };
/// assert!(head.decide(&seen).airborne); // the head takes off at its first decision
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its place in the chain, as far as it knows.
    place: u16,
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
    /// The largest imbalance from here to the head (dB).
    worst_imbalance_db: f32,
}

/// What the pilot asks for (m/s).
fn piloted_mps(seen: &Observation) -> f32 {
    let speed_mps = seen.pilot.unwrap_or_default().speed_mps;
    if speed_mps.is_finite() { speed_mps } else { 0.0 }
}

/// What an end knows of its link.
fn estimate(end: &LinkEnd) -> LinkEstimate {
    LinkEstimate { filtered_db: end.loss_db(), raw_db: end.signal_db(Signal::Raw), silent_s: end.silent_s() }
}

impl Node {
    /// The place of a relay that was told none: the last one before the base.
    const LAST: u16 = Packet::BASE_PLACE - 1;

    /// A node on the ground.
    pub fn new(role: Role, params: NodeParams) -> Self {
        Self {
            place: if role == Role::Head { 0 } else { Self::LAST },
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
            worst_imbalance_db: 0.0,
        }
    }

    /// What it is in the chain: whoever leads it is the head.
    pub fn role(&self) -> Role {
        if self.place == 0 { Role::Head } else { Role::Relay }
    }

    /// For how long it has been in the air (s).
    fn flown_s(&self) -> f32 {
        self.flown as f32 * self.params.equalize.decision_s
    }

    fn has_settled(&self) -> bool {
        let settled_s = self.params.takeoff.rise_s + self.params.takeoff.hover_s;
        self.airborne && self.flown_s() >= settled_s
    }

    /// One decision period on the ground.
    fn wait(&mut self, radio: &RadioSlot) {
        let p = &self.params;
        let period_s = p.equalize.decision_s;
        let front = radio.front(self.place);
        self.front.hear(front, None, period_s, &p.kalman, &p.link);
        self.airborne = match self.role() {
            Role::Head => true,
            // Silence is no news: it neither launches nor counts against a launch.
            Role::Relay => {
                front.is_some()
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
        let own_mps = seen.ground_speed_mps.filter(|speed_mps| speed_mps.is_finite()).unwrap_or(0.0);
        self.back.hear(radio.back(self.place), Some(own_mps), period_s, &p.kalman, &p.link);
        self.front.hear(radio.front(self.place), Some(own_mps), period_s, &p.kalman, &p.link);
        self.flown = self.flown.saturating_add(1);
        let wish_mps = match self.role() {
            Role::Head => {
                self.follow = seen.pilot.unwrap_or_default().follow;
                self.head_guard.limit(piloted_mps(seen), &self.back, &p.link)
            }
            Role::Relay => {
                let ahead = self.front.neighbour();
                self.follow = ahead.follow;
                let own_db = self.imbalance_db().map_or(0.0, f32::abs);
                self.worst_imbalance_db = own_db.max(ahead.imbalance_db);
                self.relay_guard.limit(self.level_mps(), &self.back, &self.front, &p.link)
            }
        };
        self.forward_mps = bounded(wish_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
    }

    /// Losses of its two links by the signal it decides on, the one toward the base first (dB); `None` until it has heard
    /// both.
    fn both_db(&self) -> Option<(f32, f32)> {
        let signal = self.params.link.signal;
        self.back.signal_db(signal).zip(self.front.signal_db(signal))
    }

    /// Loss of the front link minus that of the back link (dB).
    fn imbalance_db(&self) -> Option<f32> {
        self.both_db().map(|(back_db, front_db)| front_db - back_db)
    }

    /// What levels its two links (m/s); it stays until it has heard both.
    fn level_mps(&self) -> f32 {
        self.both_db().map_or(0.0, |(back_db, front_db)| equalize(back_db, front_db, &self.params.equalize))
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
    fn decide(&mut self, seen: &Observation) -> Command {
        if let Some(place) = seen.place {
            self.place = place;
        }
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

    fn say(&self, seen: &Observation) -> Packet {
        Packet {
            place: seen.place.unwrap_or(self.place),
            ground_speed_mps: seen.ground_speed_mps.unwrap_or(0.0),
            flown_s: self.flown_s(),
            follow: self.follow,
            imbalance_db: self.worst_imbalance_db,
            is_base: false,
            battery: seen.battery,
            own: [0; 8],
        }
    }

    fn estimates(&self) -> Estimates {
        Estimates {
            back: estimate(&self.back),
            front: estimate(&self.front),
            allowed_mps: self.has_settled().then_some(self.forward_mps),
        }
    }

    fn explain(&self, seen: &Observation) -> Option<Explanation> {
        let p = &self.params;
        let (wish_mps, reason) = match self.role() {
            Role::Head => (piloted_mps(seen), self.head_guard.reason(&self.back, &p.link)),
            Role::Relay => (self.level_mps(), self.relay_guard.reason(&self.back, &self.front, &p.link)),
        };
        let is_flying = self.has_settled();
        let wish_mps = bounded(wish_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
        Some(Explanation {
            role: self.role(),
            place: (self.place != Self::LAST).then_some(self.place),
            stage: match (self.airborne, is_flying) {
                (false, _) => Stage::Waiting,
                (true, false) => Stage::Rising,
                (true, true) => Stage::Flying,
            },
            estimates: self.estimates(),
            imbalance_db: self.imbalance_db(),
            wish_mps,
            // A head whose pilot asks for no more than it is allowed is overridden by nothing.
            overridden: reason.filter(|_| is_flying && self.forward_mps != wish_mps),
            follow: self.follow,
            walls: seen.tof.and_then(|tof| {
                walls_of(&tof, p.tof_range_m, self.forward_mps < 0.0, self.follow, &p.center)
            }),
            speed_share: self.centering.speed_share,
        })
    }
}
