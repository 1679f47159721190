//! Two runs side by side: where they part, and how far.

use std::{collections::BTreeMap, fmt};

use crate::record::{Frame, LinkFrame, TICKS_PER_S, UavFrame};

/// Whose value it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whose {
    /// A UAV's, 0 = head.
    Uav(usize),
    /// The link's with this UAV at its front end.
    Link(usize),
    /// The frame's own.
    Frame,
}

impl fmt::Display for Whose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uav(uav) => write!(f, "UAV {uav}, "),
            Self::Link(uav) => write!(f, "link of UAV {uav}, "),
            Self::Frame => Ok(()),
        }
    }
}

/// A field's value. Numbers are equal when their bits are.
#[derive(Debug, Clone, Copy)]
pub enum Value {
    /// In the unit of the field's name.
    Number(f32),
    /// A number of things.
    Count(u64),
    /// Yes or no.
    Flag(bool),
    /// There is none.
    Absent,
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (Self::Count(a), Self::Count(b)) => a == b,
            (Self::Flag(a), Self::Flag(b)) => a == b,
            (Self::Absent, Self::Absent) => true,
            _ => false,
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => write!(f, "{value}"),
            Self::Count(value) => write!(f, "{value}"),
            Self::Flag(value) => write!(f, "{value}"),
            Self::Absent => f.write_str("none"),
        }
    }
}

impl From<Option<f32>> for Value {
    fn from(value: Option<f32>) -> Self {
        value.map_or(Self::Absent, Self::Number)
    }
}

/// One field of one frame that is not the same in two runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// The tick.
    pub tick: u64,
    /// Whose field.
    pub whose: Whose,
    /// Its name, unit included.
    pub field: &'static str,
    /// Its value in the first run.
    pub here: Value,
    /// Its value in the second run.
    pub there: Value,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} and {}", self.place(), self.here, self.there)
    }
}

/// Every field in which two frames differ, in a fixed order: the frame's own, UAV by UAV, link by link.
pub fn differences(here: &Frame, there: &Frame, mut found: impl FnMut(Difference)) {
    let tick = here.tick;
    let mut look = |whose, field, here: Value, there: Value| {
        if here != there {
            found(Difference { tick, whose, field, here, there });
        }
    };
    let own = |frame: &Frame| {
        [
            ("tick", Value::Count(frame.tick)),
            ("decision", Value::Flag(frame.decision)),
            ("uavs", Value::Count(frame.uavs.len() as u64)),
            ("links", Value::Count(frame.links.len() as u64)),
            ("head_reach_m", Value::Number(frame.head_reach_m)),
        ]
    };
    for ((field, a), (_, b)) in own(here).into_iter().zip(own(there)) {
        look(Whose::Frame, field, a, b);
    }
    for (i, (a, b)) in here.uavs.iter().zip(&there.uavs).enumerate() {
        for ((field, a), (_, b)) in uav(a).into_iter().zip(uav(b)) {
            look(Whose::Uav(i), field, a, b);
        }
    }
    for (a, b) in here.links.iter().zip(&there.links) {
        for ((field, x), (_, y)) in link(a).into_iter().zip(link(b)) {
            look(Whose::Link(a.uav), field, x, y);
        }
    }
}

fn uav(uav: &UavFrame) -> [(&'static str, Value); 13] {
    let tof = uav.tof;
    [
        ("x_m", Value::Number(uav.x_m)),
        ("y_m", Value::Number(uav.y_m)),
        ("heading_rad", Value::Number(uav.heading_rad)),
        ("forward_mps", Value::Number(uav.forward_mps)),
        ("lateral_mps", Value::Number(uav.lateral_mps)),
        ("yaw_rate_radps", Value::Number(uav.yaw_rate_radps)),
        ("airborne", Value::Flag(uav.airborne)),
        ("wall_contacts", Value::Count(uav.wall_contacts.into())),
        ("uav_contacts", Value::Count(uav.uav_contacts.into())),
        ("tof.nw_m", tof.map(|tof| tof.nw_m).into()),
        ("tof.ne_m", tof.map(|tof| tof.ne_m).into()),
        ("tof.sw_m", tof.map(|tof| tof.sw_m).into()),
        ("tof.se_m", tof.map(|tof| tof.se_m).into()),
    ]
}

fn link(link: &LinkFrame) -> [(&'static str, Value); 3] {
    [
        ("uav", Value::Count(link.uav as u64)),
        ("true_db", Value::Number(link.true_db)),
        ("filtered_db", link.filtered_db.into()),
    ]
}

/// Two runs compared frame by frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Comparison {
    /// Ticks that both have.
    pub ticks: u64,
    /// Ticks at which they differ.
    pub differing: u64,
    /// The first field that differs.
    pub first: Option<Difference>,
    /// For every field that differs at some tick: the first of its largest differences. That of a number from none
    /// has no size, and counts as the least.
    pub largest: BTreeMap<&'static str, Difference>,
}

impl Comparison {
    /// Compares the next tick.
    pub fn tick(&mut self, here: &Frame, there: &Frame) {
        self.ticks += 1;
        let mut any = false;
        differences(here, there, |found| {
            any = true;
            self.first.get_or_insert(found);
            let largest = self.largest.entry(found.field).or_insert(found);
            if found.size() > largest.size() {
                *largest = found;
            }
        });
        self.differing += u64::from(any);
    }
}

impl Difference {
    /// When, whose and what: `tick 777 (38.85 s), UAV 1, x_m`.
    pub fn place(&self) -> String {
        let Self { tick, whose, field, .. } = self;
        format!("tick {tick} ({:.2} s), {whose}{field}", *tick as f64 / TICKS_PER_S)
    }

    /// How far apart two numbers are; `None` of anything else.
    pub fn size(&self) -> Option<f64> {
        match (self.here, self.there) {
            (Value::Number(a), Value::Number(b)) => Some((f64::from(a) - f64::from(b)).abs()),
            (Value::Count(a), Value::Count(b)) => Some(a.abs_diff(b) as f64),
            _ => None,
        }
    }
}
