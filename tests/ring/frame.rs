//! One instant of a ring, and the message it is recorded as.

use uchain_sim::{
    record::{
        Difference, FieldDiff, Snapshot, Value, Whose,
        mcap::{Recordable, alike, bounded, few, set},
    },
    world::Body,
};

/// One instant of a ring.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct RingFrame {
    /// Ticks since the start.
    pub(crate) tick: u64,
    /// Whether the robots turned to their next places at the start of the tick.
    pub(crate) decision: bool,
    /// All robots.
    pub(crate) robots: Vec<RobotFrame>,
}

/// One robot at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct RobotFrame {
    /// Where it is (m).
    pub(crate) x_m: f32,
    /// Where it is (m).
    pub(crate) y_m: f32,
    /// Contacts with others begun so far.
    pub(crate) contacts: u32,
}

impl RingFrame {
    pub(super) fn fill(&mut self, tick: u64, decision: bool, bodies: &[Body]) {
        (self.tick, self.decision) = (tick, decision);
        let robot = |body: &Body| RobotFrame { x_m: body.at.x, y_m: body.at.y, contacts: body.uav_contacts };
        set(&mut self.robots, bodies.iter().map(robot));
    }
}

impl Snapshot for RingFrame {
    const CREW: &'static str = "robots";

    fn tick(&self) -> u64 {
        self.tick
    }

    fn crew(&self) -> usize {
        self.robots.len()
    }

    fn is_decision(&self) -> bool {
        self.decision
    }

    fn hash(&self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.tick.to_le_bytes());
        bytes.push(self.decision.into());
        for robot in &self.robots {
            bytes.extend_from_slice(&robot.x_m.to_bits().to_le_bytes());
            bytes.extend_from_slice(&robot.y_m.to_bits().to_le_bytes());
            bytes.extend_from_slice(&robot.contacts.to_le_bytes());
        }
    }

    fn differences(&self, there: &Self, found: &mut dyn FnMut(Difference)) {
        let mut look = FieldDiff { tick: self.tick, found };
        let own = |frame: &Self| {
            [("decision", Value::Flag(frame.decision)), ("robots", Value::Count(frame.robots.len() as u64))]
        };
        look.at(Whose::Frame, own(self), own(there));
        for (i, (here, there)) in self.robots.iter().zip(&there.robots).enumerate() {
            let robot = |robot: &RobotFrame| {
                [
                    ("x_m", Value::Number(robot.x_m)),
                    ("y_m", Value::Number(robot.y_m)),
                    ("contacts", Value::Count(robot.contacts.into())),
                ]
            };
            look.at(Whose::One("robot", i as u64), robot(here), robot(there));
        }
    }
}

/// `uchain.RingFrame`.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct RingFrameMessage {
    #[prost(uint64, tag = "1")]
    tick: u64,
    #[prost(bool, tag = "2")]
    decision: bool,
    #[prost(float, repeated, tag = "3")]
    x_m: Vec<f32>,
    #[prost(float, repeated, tag = "4")]
    y_m: Vec<f32>,
    #[prost(uint32, repeated, tag = "5")]
    contacts: Vec<u32>,
}

impl Recordable for RingFrame {
    type Message = RingFrameMessage;
    const PROTO: &'static str = include_str!("ring.proto");
    const MESSAGE: &'static str = "RingFrame";

    fn take(&mut self, message: &RingFrameMessage) -> Result<(), String> {
        let RingFrameMessage { tick, decision, x_m, y_m, contacts } = message;
        alike(x_m.len(), "x_m", &[("y_m", y_m.len()), ("contacts", contacts.len())])?;
        bounded(&[("x_m", x_m), ("y_m", y_m)])?;
        few(&[("contacts", contacts)])?;
        (self.tick, self.decision) = (*tick, *decision);
        let robots = x_m.iter().zip(y_m).zip(contacts);
        set(&mut self.robots, robots.map(|((&x_m, &y_m), &contacts)| RobotFrame { x_m, y_m, contacts }));
        Ok(())
    }

    fn fill(&self, message: &mut RingFrameMessage) {
        (message.tick, message.decision) = (self.tick, self.decision);
        set(&mut message.x_m, self.robots.iter().map(|robot| robot.x_m));
        set(&mut message.y_m, self.robots.iter().map(|robot| robot.y_m));
        set(&mut message.contacts, self.robots.iter().map(|robot| robot.contacts));
    }
}
