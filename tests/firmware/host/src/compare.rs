//! Two results, number by number.

use std::fmt;

use replay::{
    Fault, Input,
    rows::{EXPLORED, FLOWN, Field, Of, Row, RowReader, Words},
};

/// How two results differ.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Differences {
    /// Rows that were compared: one UAV at one tick, or one robot in one round.
    pub(crate) ticks: u32,
    /// Rows of which something differs.
    pub(crate) rows: u32,
    /// Rows of which something differs that is asked of a body.
    pub(crate) commands: u32,
    /// Rows of which something differs that is believed or said.
    pub(crate) states: u32,
    /// The first number that differs.
    pub(crate) first: Option<First>,
}

/// A number that differs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct First {
    mission: String,
    /// Tick and UAV, or round and robot.
    place: [(&'static str, u32); 2],
    field: &'static str,
    ours: u32,
    theirs: u32,
}

/// Why two results cannot be compared to their ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Unlike {
    /// Ours cannot be read.
    Ours(Fault),
    /// Theirs cannot be read.
    Theirs(Fault),
    /// They are not of the same missions, ticks and UAVs from this row on.
    Row(u32),
}

impl fmt::Display for First {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [(tick, at), (uav, id)] = self.place;
        write!(f, "{}, {tick} {at}, {uav} {id}, {}: ", self.mission, self.field)?;
        write!(f, "{}, where the host has {}", shown(self.field, self.theirs), shown(self.field, self.ours))
    }
}

/// Bits, and the number they are: a name with an underscore has a unit, or is a share, and no whole number.
fn shown(field: &str, bits: u32) -> String {
    let value = if field.contains('_') { f32::from_bits(bits).to_string() } else { bits.to_string() };
    format!("{bits:#010x} ({value})")
}

impl fmt::Display for Unlike {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ours(fault) => write!(f, "the host's own result: {fault}"),
            Self::Theirs(fault) => write!(f, "{fault}"),
            Self::Row(rows) => {
                write!(f, "after {rows} rows it is about something else than the trace; fly the same trace")
            }
        }
    }
}

/// Compares what a host has flown with what somebody else has.
pub(crate) fn compare(ours: &mut impl Input, theirs: &mut impl Input) -> Result<Differences, Unlike> {
    let mut ours = RowReader::open(ours).map_err(Unlike::Ours)?;
    let mut theirs = RowReader::open(theirs).map_err(Unlike::Theirs)?;
    let mut found = Differences::default();
    let mut mission = String::new();
    loop {
        let pair = (ours.read().map_err(Unlike::Ours)?, theirs.read().map_err(Unlike::Theirs)?);
        match pair {
            (None, None) => return Ok(found),
            (Some(Row::Mission(a)), Some(Row::Mission(b))) if a == b => a.clone_into(&mut mission),
            (Some(Row::Flown(a)), Some(Row::Flown(b))) => found.add(&mission, FLOWN, a, b)?,
            (Some(Row::Explored(a)), Some(Row::Explored(b))) => found.add(&mission, EXPLORED, a, b)?,
            _ => return Err(Unlike::Row(found.ticks)),
        }
    }
}

impl Differences {
    fn add(
        &mut self,
        mission: &str,
        fields: &[Field],
        ours: Words<'_>,
        theirs: Words<'_>,
    ) -> Result<(), Unlike> {
        let mut differs = [false; 2];
        let mut place = [("", 0); 2];
        for ((i, field), (ours, theirs)) in fields.iter().enumerate().zip(ours.iter().zip(theirs.iter())) {
            if let Some(place) = place.get_mut(i) {
                *place = (field.name, ours);
            }
            if ours == theirs {
                continue;
            }
            match field.of {
                Of::Place => return Err(Unlike::Row(self.ticks)),
                Of::Command => differs[0] = true,
                Of::State => differs[1] = true,
            }
            let mission = mission.to_owned();
            self.first.get_or_insert(First { mission, place, field: field.name, ours, theirs });
        }
        let [command, state] = differs;
        self.ticks += 1;
        self.rows += u32::from(command || state);
        self.commands += u32::from(command);
        self.states += u32::from(state);
        Ok(())
    }
}
