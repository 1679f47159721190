//! A UAV of the chain: waits, takes off, and flies by the laws (Laclau 2021, Algorithm 1 and §4.3).

mod brain;
mod check;
mod levelling;
mod presets;
#[cfg(test)]
mod tests;

use super::{
    CenterParams, Centering, Command, End, EqualizeParams, Follow, HeadGuard, KalmanParams, LinkEnd,
    LinkEstimate, LinkParams, Observation, Packet, RadioSlot, RelayGuard, Signal, TOF_RANGE_M, Takeoff,
    TakeoffParams,
    center::{SteeredBy, center_by},
};
use crate::{bounded, larger};

pub use levelling::Levelling;

/// What a node does in the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Role {
    /// The explorer: flies as its pilot asks, as long as its back link holds.
    Head,
    /// Levels its two links.
    Relay,
}

impl Role {
    /// In a word, for people and programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Head => "head",
            Self::Relay => "relay",
        }
    }
}

/// The Params of every law a node flies by, and what it has to know of its sensors.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
/// [`Brain::decide`](super::Brain::decide) is a decision as a whole. A law of one's own that levels the two links otherwise than [`equalize`](super::equalize), and
/// leaves all else to the node, decides in halves: [`Node::prepare`], and [`Node::conclude`] with a speed from elsewhere.
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
    /// What made its centering ask for that.
    steered_by: SteeredBy,
    /// Whether a relay's speed is still to come: [`Node::conclude`] brings it.
    is_asking: bool,
    /// What a relay's law wished the last time.
    wish_mps: f32,
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
            steered_by: SteeredBy::default(),
            is_asking: false,
            wish_mps: 0.0,
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

    /// The first half of a decision: places, links and take-off as of now. It gives what a relay levels its two links by;
    /// `None` where nothing is to be levelled: on the ground, by the head, between decisions, and until both links have been
    /// heard. [`Node::conclude`] is the second half.
    ///
    /// ```
    /// use uchain_core::chain::{
    ///     BASE_ID, Brain, Command, Heard, Node, NodeParams, Observation, Packet, Role, equalize,
    /// };
    /// let params = NodeParams::default();
    /// let mut whole = Node::new(Role::Relay, params.clone());
    /// let mut halves = whole.clone();
    /// for decision in 0..50 {
    ///     let ahead = Packet { flown_s: 60.0, ..Packet::default() };
    ///     let heard = [
    ///         Heard { from: 0, loss_db: 60.0 + decision as f32 * 0.1, packet: ahead },
    ///         Heard { from: BASE_ID, loss_db: 58.0, packet: Packet::BASE },
    ///     ];
    ///     let seen =
    ///         Observation { place: Some(1), radio: Some(heard.into_iter().collect()), ..Observation::default() };
    ///     let level_mps = match halves.prepare(&seen) {
    ///         Some(asked) => equalize(asked.back_db, asked.front_db, &params.equalize), // or a law of one's own
    ///         None => 0.0,
    ///     };
    ///     assert_eq!(halves.conclude(&seen, level_mps), whole.decide(&seen));
    /// }
    /// ```
    pub fn prepare(&mut self, seen: &Observation) -> Option<Levelling> {
        let (back_db, front_db) = self.ask(seen)?;
        Some(Levelling {
            back_db,
            front_db,
            back: estimate(&self.back),
            front: estimate(&self.front),
            place: self.place,
            ground_speed_mps: seen.ground_speed_mps,
            tof: seen.tof,
        })
    }

    /// [`Node::prepare`] without what [`equalize`](super::equalize) does not look at: the losses of the two links, the one
    /// toward the base first (dB).
    fn ask(&mut self, seen: &Observation) -> Option<(f32, f32)> {
        if let Some(place) = seen.place {
            self.place = place;
        }
        self.is_asking = false;
        if let Some(radio) = &seen.radio {
            if self.airborne {
                return self.listen(radio, seen);
            }
            self.wait(radio);
        }
        None
    }

    /// The second half of a decision on what [`Node::prepare`] saw: overrides and bounds, then centering. `level_mps` is the
    /// forward speed that levels the two links (m/s): if none was asked for it is passed over, and what is not finite is 0.
    pub fn conclude(&mut self, seen: &Observation, level_mps: f32) -> Command {
        let p = &self.params;
        if core::mem::take(&mut self.is_asking) {
            self.wish_mps = if level_mps.is_finite() { level_mps } else { 0.0 };
            let allowed_mps = self.relay_guard.limit(self.wish_mps, &self.back, &self.front, &p.link);
            self.forward_mps = bounded(allowed_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
        }
        if let Some(tof) = &seen.tof {
            let backward = self.forward_mps < 0.0;
            (self.centering, self.steered_by) =
                center_by(tof, p.tof_range_m, backward, self.follow, &p.center);
        }
        self.command()
    }

    /// One decision period in the air: filters both links. The head has its speed then; a relay that has heard both links
    /// asks for one, until then it stays.
    fn listen(&mut self, radio: &RadioSlot, seen: &Observation) -> Option<(f32, f32)> {
        let p = &self.params;
        let period_s = p.equalize.decision_s;
        let own_mps = seen.ground_speed_mps.filter(|speed_mps| speed_mps.is_finite()).unwrap_or(0.0);
        self.back.hear(radio.back(self.place), Some(own_mps), period_s, &p.kalman, &p.link);
        self.front.hear(radio.front(self.place), Some(own_mps), period_s, &p.kalman, &p.link);
        self.flown = self.flown.saturating_add(1);
        let both_db = self.both_db();
        let wish_mps = match self.role() {
            Role::Head => {
                self.follow = seen.pilot.unwrap_or_default().follow;
                self.head_guard.limit(piloted_mps(seen), &self.back, &p.link)
            }
            Role::Relay => {
                let ahead = self.front.neighbour();
                self.follow = ahead.follow;
                let own_db = both_db.map_or(0.0, |(back_db, front_db)| (front_db - back_db).abs());
                self.worst_imbalance_db = larger(own_db, ahead.imbalance_db);
                if both_db.is_some() {
                    self.is_asking = true;
                    return both_db;
                }
                self.wish_mps = 0.0;
                self.relay_guard.limit(0.0, &self.back, &self.front, &p.link)
            }
        };
        self.forward_mps = bounded(wish_mps, -p.equalize.v_max_mps, p.equalize.v_max_mps);
        None
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
