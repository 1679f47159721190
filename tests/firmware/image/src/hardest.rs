//! What a decision costs at most: every law, both roles, as many packets as a node takes in, readings good and bad.
//!
//! Flights show what is usual, and this what is possible.

use core::hint::black_box;

use uchain_core::chain::{
    Brain as _, CenterLaw, Command, Gap, Heard, Launch, Node, NodeParams, Observation, Packet, RadioSlot,
    Role, Signal, SpeedLaw, Tof,
};

use crate::{clock::cost_of, stack::depth_of};

/// Instructions and bytes of stack.
#[derive(Clone, Copy, Default)]
pub struct Hardest {
    /// Instructions of a decision.
    pub instructions: u32,
    /// Stack of a decision (bytes).
    pub decide_stack: usize,
    /// Stack of a packet that is made (bytes).
    pub say_stack: usize,
    /// Decisions that were looked at.
    pub decisions: u32,
}

/// Decisions of each node.
const DECISIONS: u32 = 40;

/// Numbers that look drawn (Marsaglia 2003, "Xorshift RNGs").
struct Draw(u32);

impl Draw {
    fn bits(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.bits() >> 8) as f32 / (1 << 24) as f32
    }

    /// A reading between these, or now and then one that is none.
    fn reading(&mut self, low: f32, high: f32) -> f32 {
        match self.bits() % 32 {
            0 => f32::NAN,
            1 => f32::INFINITY,
            2 => -1.0,
            _ => self.between(low, high),
        }
    }

    fn seen(&mut self) -> Observation {
        let mut radio = RadioSlot::default();
        for from in 0..8 {
            let packet = if from == 7 {
                Packet::BASE
            } else {
                Packet {
                    place: from,
                    ground_speed_mps: self.reading(-0.3, 0.3),
                    flown_s: self.between(0.0, 60.0),
                    imbalance_db: self.between(0.0, 10.0),
                    ..Packet::default()
                }
            };
            radio.push(Heard { from, loss_db: self.reading(30.0, 95.0), packet });
        }
        let mut beam = || self.reading(0.05, 2.0);
        let tof = Tof { nw_m: beam(), ne_m: beam(), sw_m: beam(), se_m: beam() };
        Observation {
            place: Some(self.bits() as u16 % 4),
            tof: Some(tof),
            radio: Some(radio),
            ground_speed_mps: Some(self.reading(-0.3, 0.3)),
            ..Observation::default()
        }
    }
}

#[inline(never)]
fn decide(node: &mut Node, seen: &Observation) -> Command {
    node.decide(seen)
}

#[inline(never)]
fn say(node: &Node, seen: &Observation) -> Packet {
    node.say(seen)
}

/// Lets every law decide, through all its variants.
pub fn fly() -> Hardest {
    let mut most = Hardest::default();
    let mut draw = Draw(0x9e37_79b9);
    for law in [SpeedLaw::Lipschitz, SpeedLaw::InverseModel, SpeedLaw::BangBang] {
        for center in [CenterLaw::Wall, CenterLaw::Paper, CenterLaw::Firmware] {
            for variant in 0..8 {
                let mut params = NodeParams::default();
                params.equalize.law = law;
                params.equalize.spacing = variant & 1 != 0;
                params.center.law = center;
                params.link.gap = if variant & 2 != 0 { Gap::Predict } else { Gap::Hold };
                params.link.signal = if variant & 4 != 0 { Signal::Raw } else { Signal::Filtered };
                params.takeoff.launch = Launch::Converged;
                let mut node = Node::new(Role::Relay, black_box(params));
                for _ in 0..DECISIONS {
                    one(&mut node, &draw.seen(), &mut most);
                }
            }
        }
    }
    most
}

/// One decision on a copy of the node looks at the stack, and one on the node itself at the clock: neither sees the
/// other's work.
fn one(node: &mut Node, seen: &Observation, most: &mut Hardest) {
    let mut copy = black_box(node.clone());
    let (_, say_stack) = depth_of::<1024, _>(|| black_box(say(&copy, black_box(seen))));
    let (_, decide_stack) = depth_of::<1024, _>(|| black_box(decide(&mut copy, black_box(seen))));
    let (_, instructions) = cost_of(|| black_box(decide(node, black_box(seen))));
    most.instructions = most.instructions.max(instructions);
    most.decide_stack = most.decide_stack.max(decide_stack);
    most.say_stack = most.say_stack.max(say_stack);
    most.decisions += 1;
}
