//! What comes of a flight, in rows of plain numbers: bits of commands, and of all that a brain believes. Everybody writes
//! the same rows, so that whoever compares needs to know no law.

use uchain_core::chain::{Command, Explanation, Follow, LinkEstimate, Override, Packet, Stage, Walls};

use crate::{
    Cause, Fault, Frames, Input, Output,
    frames::{begin, write},
};

/// How a result begins, before its version.
pub const RESULT_MAGIC: [u8; 7] = *b"UCFLOWN";

/// The bits of what is absent: a number that is none, and that no arithmetic gives.
pub const NONE: u32 = u32::MAX;

/// One number of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// What it is called.
    pub name: &'static str,
    /// What it is of.
    pub of: Of,
}

/// What a number is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// Where the row belongs.
    Place,
    /// What is asked of a body.
    Command,
    /// What is believed, and said.
    State,
}

macro_rules! fields {
    ($($of:ident $($name:literal)*;)*) => { &[$($(Field { name: $name, of: Of::$of },)*)*] };
}

/// Rows of a chain: one UAV at one tick. Numbers with a unit are the bits of an `f32`.
pub const FLOWN: &[Field] = fields! {
    Place "tick" "uav";
    Command "forward_mps" "lateral_mps" "yaw_rate_radps" "airborne";
    State "back.filtered_db" "back.variance_db2" "back.raw_db" "back.silent_s";
    State "front.filtered_db" "front.variance_db2" "front.raw_db" "front.silent_s";
    State "allowed_mps" "wish_mps" "imbalance_db" "speed_share";
    State "said.imbalance_db" "said.flown_s";
    State "follow" "stage" "overridden" "walls";
};

/// Rows of an exploration: one robot in one round. What is known is that of the robot's store.
pub const EXPLORED: &[Field] = fields! {
    Place "round" "robot";
    Command "to.x_m" "to.y_m" "heading_rad" "level" "z_m" "scan" "mfl" "hold";
    State "target.purpose" "target.from.x_m" "target.from.y_m" "target.to.x_m" "target.to.y_m";
    State "target.hub.robot" "target.hub.number" "target.level";
    State "store.nodes" "store.edges" "store.hubs" "store.hash.low" "store.hash.high";
};

/// A row of [`FLOWN`].
pub type Flown = [u32; FLOWN.len()];

/// A row of [`EXPLORED`].
pub type Explored = [u32; EXPLORED.len()];

fn bits(value: Option<f32>) -> u32 {
    value.map_or(NONE, f32::to_bits)
}

/// What one UAV asks for after a decision, with what it believes and would say then.
pub fn flown(tick: u32, uav: u8, asks: &Command, why: &Explanation, says: &Packet) -> Flown {
    let [back, front] =
        [(why.estimates.back, why.back_variance_db2), (why.estimates.front, why.front_variance_db2)].map(
            |(LinkEstimate { filtered_db, raw_db, silent_s }, variance_db2)| {
                [filtered_db, variance_db2, raw_db, silent_s].map(bits)
            },
        );
    let mut row = [NONE; FLOWN.len()];
    let command = [asks.forward_mps, asks.lateral_mps, asks.yaw_rate_radps].map(f32::to_bits);
    let state = [
        bits(why.estimates.allowed_mps),
        why.wish_mps.to_bits(),
        bits(why.imbalance_db),
        why.speed_share.to_bits(),
        says.imbalance_db.to_bits(),
        says.flown_s.to_bits(),
        match why.follow {
            Follow::Centre => 0,
            Follow::Left => 1,
            Follow::Right => 2,
        },
        match why.stage {
            Stage::Waiting => 0,
            Stage::Rising => 1,
            Stage::Flying => 2,
            _ => NONE,
        },
        number(why.overridden.and_then(|reason| Override::ALL.iter().position(|&known| known == reason))),
        why.walls.map_or(NONE, |walls| match walls {
            Walls::Both => 0,
            Walls::Left => 1,
            Walls::Right => 2,
        }),
    ];
    fill(&mut row, &[&[tick, u32::from(uav)], &command, &[u32::from(asks.airborne)], &back, &front, &state]);
    row
}

fn number(value: Option<usize>) -> u32 {
    value.map_or(NONE, |value| value as u32)
}

/// Puts numbers into a row, one after the other.
pub(crate) fn fill(row: &mut [u32], parts: &[&[u32]]) {
    let words = parts.iter().copied().flatten();
    debug_assert_eq!(words.clone().count(), row.len());
    for (place, word) in row.iter_mut().zip(words) {
        *place = *word;
    }
}

/// What a row is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Row<'a> {
    /// A mission begins.
    Mission(&'a str),
    /// A row of [`FLOWN`].
    Flown(Words<'a>),
    /// A row of [`EXPLORED`].
    Explored(Words<'a>),
}

/// The numbers of a row, as they are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Words<'a>(&'a [u8]);

impl Words<'_> {
    /// All of them, in order.
    pub fn iter(&self) -> impl Iterator<Item = u32> + '_ {
        self.0.chunks_exact(4).filter_map(|bytes| bytes.try_into().ok().map(u32::from_le_bytes))
    }
}

const MISSION: u8 = 0;
const A_FLOWN: u8 = 1;
const AN_EXPLORED: u8 = 2;
const END: u8 = 3;

/// Longest name of a mission that is written (bytes).
const NAME_MAX: usize = 64;

/// Longest row (bytes).
const ROW_MAX: usize = 4 * if FLOWN.len() > EXPLORED.len() { FLOWN.len() } else { EXPLORED.len() };

/// Writes a result.
#[derive(Debug)]
pub struct RowWriter<'a, O> {
    output: &'a mut O,
    rows: u32,
}

impl<'a, O: Output> RowWriter<'a, O> {
    /// An empty one.
    pub fn begin(output: &'a mut O) -> Self {
        begin(output, RESULT_MAGIC);
        Self { output, rows: 0 }
    }

    /// A mission begins; of a long name only the beginning is written.
    pub fn mission(&mut self, name: &str) {
        let end =
            (0..=NAME_MAX.min(name.len())).rev().find(|&end| name.get(..end).is_some()).unwrap_or_default();
        let name = name.as_bytes().get(..end).unwrap_or_default();
        let mut record = [MISSION; 1 + NAME_MAX];
        for (place, byte) in record.iter_mut().skip(1).zip(name) {
            *place = *byte;
        }
        self.write(record.get(..=name.len()).unwrap_or_default());
    }

    /// One UAV at one tick.
    pub fn flown(&mut self, row: &Flown) {
        self.words(A_FLOWN, row);
    }

    /// One robot in one round.
    pub fn explored(&mut self, row: &Explored) {
        self.words(AN_EXPLORED, row);
    }

    /// The result is over.
    pub fn end(mut self) {
        let rows = self.rows;
        self.words(END, &[rows]);
    }

    fn words(&mut self, kind: u8, words: &[u32]) {
        let mut record = [kind; 1 + ROW_MAX];
        let bytes = words.iter().flat_map(|word| word.to_le_bytes());
        for (place, byte) in record.iter_mut().skip(1).zip(bytes) {
            *place = byte;
        }
        self.write(record.get(..=4 * words.len()).unwrap_or_default());
    }

    fn write(&mut self, record: &[u8]) {
        write(self.output, record);
        self.rows = self.rows.saturating_add(1);
    }
}

/// Reads a result row by row.
#[derive(Debug)]
pub struct RowReader<'a, I> {
    frames: Option<Frames<'a, I>>,
}

impl<'a, I: Input> RowReader<'a, I> {
    /// At its first row.
    ///
    /// # Errors
    /// [`Fault`]: it is no result, or of another version.
    pub fn open(input: &'a mut I) -> Result<Self, Fault> {
        Ok(Self { frames: Some(Frames::open(input, RESULT_MAGIC)?) })
    }

    /// The next row; `None` at the end.
    ///
    /// # Errors
    /// [`Fault`]: what cannot be read.
    pub fn read(&mut self) -> Result<Option<Row<'_>>, Fault> {
        let Some(mut frames) = self.frames.take() else { return Ok(None) };
        let place = frames.count();
        let malformed = Fault { place, cause: Cause::Malformed };
        let record = frames.read()?;
        if let [END, rows @ ..] = record {
            let rows = rows.try_into().map(u32::from_le_bytes).map_err(|_| malformed)?;
            frames.end(rows)?;
            return Ok(None);
        }
        let frames = self.frames.insert(frames);
        row(frames.last()).ok_or(malformed).map(Some)
    }
}

fn row(record: &[u8]) -> Option<Row<'_>> {
    let (&kind, bytes) = record.split_first()?;
    match kind {
        MISSION => core::str::from_utf8(bytes).ok().map(Row::Mission),
        A_FLOWN if bytes.len() == 4 * FLOWN.len() => Some(Row::Flown(Words(bytes))),
        AN_EXPLORED if bytes.len() == 4 * EXPLORED.len() => Some(Row::Explored(Words(bytes))),
        _ => None,
    }
}
