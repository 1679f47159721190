//! The two files, little-endian, as `harness/main.c` has them: what is asked, in records of 48 bytes, and what is answered
//! to every step, in records of 108.

use uchain_core::{
    chain::{
        Brain as _, Command, Follow, Heard, Node, NodeParams, Observation, Override, Role, Stage, Walls,
    },
    wire::{self, Message, SIZE_MAX},
};

/// Bytes of a record of what is asked.
const ASKED: usize = 48;
/// Bytes of a record of what is answered.
pub(crate) const REPLY: usize = 108;

/// Kinds of records.
const END: u8 = 0;
const INIT: u8 = 1;
const HEAR: u8 = 2;
const STEP: u8 = 3;

/// One of the functions that fill Params.
#[derive(Debug, Clone, Copy)]
#[repr(u8)]
pub(crate) enum Preset {
    Default = 0,
    Frontiers2021 = 1,
    Cavemod = 2,
}

impl Preset {
    pub(crate) const ALL: [Self; 3] = [Self::Default, Self::Frontiers2021, Self::Cavemod];

    pub(crate) fn params(self) -> NodeParams {
        match self {
            Self::Default => NodeParams::default(),
            Self::Frontiers2021 => NodeParams::frontiers2021(),
            Self::Cavemod => NodeParams::cavemod(),
        }
    }
}

/// One UAV, and the packets it says.
#[derive(Debug)]
pub(crate) struct Uav {
    number: u8,
    pub(crate) id: u16,
    node: Node,
    sequence: u8,
    heard: Vec<Heard>,
}

/// Both files in the making.
#[derive(Debug, Default)]
pub(crate) struct Files {
    pub(crate) asked: Vec<u8>,
    pub(crate) expected: Vec<u8>,
}

impl Files {
    fn ask(&mut self, kind: u8, uav: u8, a: u8, b: u8, c: u32, payload: &[u8]) {
        let start = self.asked.len();
        self.asked.extend([kind, uav, a, b]);
        self.asked.extend(c.to_le_bytes());
        self.asked.extend(payload);
        self.asked.resize(start + ASKED, 0);
    }

    pub(crate) fn uav(&mut self, number: u8, id: u16, role: Role, preset: Preset) -> Uav {
        self.ask(INIT, number, u8::from(role == Role::Relay), preset as u8, id.into(), &[]);
        Uav { number, id, node: Node::new(role, preset.params()), sequence: 0, heard: Vec::new() }
    }

    /// A packet arrives.
    pub(crate) fn hear(&mut self, uav: &mut Uav, bytes: &[u8], loss_db: f32) {
        self.ask(HEAR, uav.number, bytes.len() as u8, 0, loss_db.to_bits(), bytes);
        let Message { from, packet, .. } = wire::decode(bytes).expect("what was encoded");
        uav.heard.retain(|heard| heard.from != from);
        uav.heard.push(Heard { from, loss_db, packet });
    }

    /// One step. What it says, if a decision is due, and what it asks for.
    pub(crate) fn step(&mut self, uav: &mut Uav, mut seen: Observation, is_due: bool) -> (Vec<u8>, Command) {
        self.ask(STEP, uav.number, 0, 0, 0, &observation(&seen, is_due));
        let mut said = Vec::new();
        if is_due {
            let mut bytes = [0; SIZE_MAX];
            let packet = uav.node.say(&seen);
            let length = wire::encode(&Message { from: uav.id, sequence: uav.sequence, packet }, &mut bytes);
            uav.sequence = uav.sequence.wrapping_add(1);
            said.extend(&bytes[..length]);
            seen.radio = Some(uav.heard.drain(..).collect());
        }
        let command = uav.node.decide(&seen);
        seen.radio = None;
        self.expect(&said, command, &uav.node, &seen);
        (said, command)
    }

    fn expect(&mut self, said: &[u8], command: Command, node: &Node, seen: &Observation) {
        let start = self.expected.len();
        self.expected.extend([0, 0, command.airborne.into(), said.len() as u8]);
        for number in [command.forward_mps, command.lateral_mps, command.yaw_rate_radps] {
            self.expected.extend(number.to_le_bytes());
        }
        self.expected.extend(explanation(node, seen));
        self.expected.resize(start + 76, 0);
        self.expected.extend(said);
        self.expected.resize(start + REPLY, 0);
    }

    pub(crate) fn end(&mut self) {
        self.ask(END, 0, 0, 0, 0, &[]);
    }
}

fn follow(follow: Follow) -> u8 {
    match follow {
        Follow::Centre => 0,
        Follow::Left => 1,
        Follow::Right => 2,
    }
}

/// As `uchain_observation` lies in memory.
fn observation(seen: &Observation, is_due: bool) -> Vec<u8> {
    let tof = seen.tof.map(|tof| [tof.nw_m, tof.ne_m, tof.sw_m, tof.se_m]);
    let pilot = seen.pilot.unwrap_or_default();
    let mut bytes = Vec::new();
    for number in tof.unwrap_or_default() {
        bytes.extend(number.to_le_bytes());
    }
    for number in
        [seen.ground_speed_mps.unwrap_or_default(), seen.battery.unwrap_or_default(), pilot.speed_mps]
    {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(seen.place.unwrap_or_default().to_le_bytes());
    bytes.push(follow(pilot.follow));
    let has = [
        seen.place.is_some(),
        tof.is_some(),
        is_due,
        seen.ground_speed_mps.is_some(),
        seen.battery.is_some(),
        seen.pilot.is_some(),
    ];
    bytes.extend(has.map(u8::from));
    bytes
}

/// As `uchain_explanation` lies in memory, without the gap at its end.
fn explanation(node: &Node, seen: &Observation) -> Vec<u8> {
    let why = node.explain(seen).expect("a node explains itself");
    let number = |known: Option<f32>| known.unwrap_or(f32::NAN);
    let (back, front) = (why.estimates.back, why.estimates.front);
    let numbers = [
        number(back.filtered_db),
        number(why.back_variance_db2),
        number(back.raw_db),
        number(back.silent_s),
        number(front.filtered_db),
        number(why.front_variance_db2),
        number(front.raw_db),
        number(front.silent_s),
        number(why.imbalance_db),
        why.wish_mps,
        number(why.estimates.allowed_mps),
        why.speed_share,
    ];
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend(why.place.unwrap_or(65535).to_le_bytes());
    bytes.push(u8::from(why.role == Role::Relay));
    bytes.push(match why.stage {
        Stage::Waiting => 0,
        Stage::Rising => 1,
        _ => 2,
    });
    bytes.push(match why.overridden {
        None => 0,
        Some(Override::NeverHeard) => 1,
        Some(Override::HeadStop) => 2,
        Some(Override::Retreat) => 3,
        Some(Override::BackLost) => 4,
        Some(Override::FrontLost) => 5,
        Some(_) => 6,
    });
    bytes.push(follow(why.follow));
    bytes.push(match why.walls {
        None => 0,
        Some(Walls::Both) => 1,
        Some(Walls::Left) => 2,
        Some(Walls::Right) => 3,
    });
    bytes
}
