//! Two runs side by side: where they part, and how far.

use std::{collections::BTreeMap, fmt};

use super::Snapshot;
use crate::clock::time_s;

/// Whose value it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Whose {
    /// The frame's own.
    Frame,
    /// Of one thing of several of its kind: what it is, and its number.
    One(&'static str, u64),
    /// Of one thing of several of its kind that belongs to another one: `node 3 of robot 1`.
    OneOf([(&'static str, u64); 2]),
}

impl fmt::Display for Whose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Frame => Ok(()),
            Self::One(what, number) => write!(f, "{what} {number}, "),
            Self::OneOf([(what, number), (of, whose)]) => write!(f, "{what} {number} of {of} {whose}, "),
        }
    }
}

/// A field's value. Numbers are equal when their bits are.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
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

/// Tells the fields of two frames apart, and calls `found` with those that differ.
pub struct FieldDiff<'a> {
    /// Tick of both frames.
    pub tick: u64,
    /// Called with every field that differs.
    pub found: &'a mut dyn FnMut(Difference),
}

impl FieldDiff<'_> {
    /// Compares fields of the same names, given in the same order.
    pub fn at<const N: usize>(
        &mut self,
        whose: Whose,
        here: [(&'static str, Value); N],
        there: [(&'static str, Value); N],
    ) {
        for ((field, here), (_, there)) in here.into_iter().zip(there) {
            if here != there {
                (self.found)(Difference { tick: self.tick, whose, field, here, there });
            }
        }
    }
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
    pub fn tick<F: Snapshot>(&mut self, here: &F, there: &F) {
        self.ticks += 1;
        let mut any = false;
        here.differences(there, &mut |found| {
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
        format!("tick {tick} ({:.2} s), {whose}{field}", time_s(*tick))
    }

    /// How far apart two numbers are, in the unit of the field; `None` of anything else.
    pub fn size(&self) -> Option<f64> {
        match (self.here, self.there) {
            (Value::Number(a), Value::Number(b)) => Some((f64::from(a) - f64::from(b)).abs()),
            (Value::Count(a), Value::Count(b)) => Some(a.abs_diff(b) as f64),
            _ => None,
        }
    }
}
