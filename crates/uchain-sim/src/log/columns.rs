//! The columns a log may have: what each means, what may stand in it, and what an absent one says.

use std::fmt::Write as _;

use crate::config::{Choices, shorten};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Of {
    Time,
    Place,
    /// Front left, front right, rear left, rear right.
    Tof(usize),
    GroundSpeed,
    Battery,
    PilotSpeed,
    PilotFollow,
    Rssi(End),
    Loss(End),
    Speed(End),
    BackIsBase,
    FrontFlown,
    FrontFollow,
    FrontImbalance,
    /// Forward, lateral, yaw rate.
    Asked(usize),
}

/// One of the two links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum End {
    Back,
    Front,
}

/// A column that a log may have.
#[derive(Debug)]
pub(super) struct Column {
    pub(super) name: &'static str,
    pub(super) of: Of,
    /// Smallest and largest number that is no mistake of unit or sign, and which mistake it would be.
    pub(super) sound: Option<(f64, f64, &'static str)>,
    /// For people, with what an empty cell means.
    about: &'static str,
    /// What stands there in the rows of a template.
    example: [&'static str; 2],
}

const fn column(
    name: &'static str,
    of: Of,
    sound: Option<(f64, f64, &'static str)>,
    example: [&'static str; 2],
    about: &'static str,
) -> Column {
    Column { name, of, sound, about, example }
}

const TOF: Option<(f64, f64, &str)> = Some((
    -1.0,
    100.0,
    "is it in millimetres? expected metres; a beam that sees nothing may read the range limit",
));
const BACK_RSSI: Option<(f64, f64, &str)> =
    Some((-200.0, 20.0, "is it without its minus? then the column is called back_loss_db"));
const FRONT_RSSI: Option<(f64, f64, &str)> =
    Some((-200.0, 20.0, "is it without its minus? then the column is called front_loss_db"));
const BACK_LOSS: Option<(f64, f64, &str)> =
    Some((-20.0, 200.0, "is it a received power in dBm? then the column is called back_rssi_dbm"));
const FRONT_LOSS: Option<(f64, f64, &str)> =
    Some((-20.0, 200.0, "is it a received power in dBm? then the column is called front_rssi_dbm"));
const SPEED: Option<(f64, f64, &str)> = Some((-20.0, 20.0, "is it in mm/s? expected m/s"));
const LATER: [&str; 2] = ["", ""];

/// All columns, in the order of a template.
pub(super) const COLUMNS: &[Column] = &[
    column(
        "time_s",
        Of::Time,
        None,
        ["0.00", "0.05"],
        "when; each row later than the one before, from whatever moment on. The one column that must be there",
    ),
    column("place", Of::Place, None, ["1", ""], "its place in the chain, 0 leads it; empty: as before"),
    column(
        "tof_nw_m",
        Of::Tof(0),
        TOF,
        ["0.61", "0.60"],
        "a new set of distances: front left; all four empty: nothing new, one empty: it sees nothing",
    ),
    column("tof_ne_m", Of::Tof(1), TOF, ["0.58", "0.59"], "front right"),
    column("tof_sw_m", Of::Tof(2), TOF, ["0.60", "0.60"], "rear left"),
    column("tof_se_m", Of::Tof(3), TOF, ["0.59", ""], "rear right"),
    column(
        "ground_speed_mps",
        Of::GroundSpeed,
        SPEED,
        ["0.00", "0.01"],
        "forward, by optic flow, in the body's frame; empty: not measured",
    ),
    column(
        "battery",
        Of::Battery,
        Some((0.0, 1.0, "is it in per cent, or a voltage? expected a share, 0 to 1")),
        LATER,
        "share that is left; no law heeds it",
    ),
    column(
        "pilot_speed_mps",
        Of::PilotSpeed,
        SPEED,
        LATER,
        "what the pilot asks of the head; empty: as before, 0 at first",
    ),
    column("pilot_follow", Of::PilotFollow, None, LATER, "centre, left or right; empty: as before"),
    column(
        "back_rssi_dbm",
        Of::Rssi(End::Back),
        BACK_RSSI,
        ["-52", ""],
        "a packet from the neighbour toward the base: its received power, negative; empty: none came",
    ),
    column("back_loss_db", Of::Loss(End::Back), BACK_LOSS, LATER, "instead of it: its loss, positive"),
    column("back_ground_speed_mps", Of::Speed(End::Back), SPEED, LATER, "the speed in that packet; empty: 0"),
    column(
        "back_is_base",
        Of::BackIsBase,
        None,
        LATER,
        "1: that neighbour is the base, 0: a UAV; empty: the base if it says no speed",
    ),
    column(
        "front_rssi_dbm",
        Of::Rssi(End::Front),
        FRONT_RSSI,
        ["-64", ""],
        "the same from the neighbour toward the head",
    ),
    column("front_loss_db", Of::Loss(End::Front), FRONT_LOSS, LATER, "instead of it: its loss, positive"),
    column(
        "front_ground_speed_mps",
        Of::Speed(End::Front),
        SPEED,
        ["0.10", ""],
        "the speed in that packet; empty: 0",
    ),
    column(
        "front_flown_s",
        Of::FrontFlown,
        Some((0.0, 1.0e6, "expected seconds in the air")),
        ["60", ""],
        "for how long that neighbour has flown; empty: for long enough",
    ),
    column(
        "front_follow",
        Of::FrontFollow,
        None,
        LATER,
        "its wall choice: centre, left or right; empty: centre",
    ),
    column(
        "front_imbalance_db",
        Of::FrontImbalance,
        Some((0.0, 1.0e6, "expected dB, no less than 0")),
        LATER,
        "the worst imbalance it tells of; empty: 0",
    ),
    column(
        "asked_forward_mps",
        Of::Asked(0),
        SPEED,
        LATER,
        "what the drone itself asked for at that row, to compare with: forward",
    ),
    column("asked_lateral_mps", Of::Asked(1), SPEED, LATER, "to the left"),
    column(
        "asked_yaw_rate_radps",
        Of::Asked(2),
        Some((-50.0, 50.0, "is it in degrees? expected rad/s, counter-clockwise")),
        LATER,
        "turn, counter-clockwise",
    ),
];

/// All columns with what each means, for people; no line is longer than 100 letters.
pub fn about_columns() -> String {
    const WIDTH: usize = 75;
    let mut text = String::new();
    for Column { name, about, .. } in COLUMNS {
        let (mut name, mut line) = (*name, String::new());
        for word in about.split(' ').map(Some).chain([None]) {
            let is_full = word.is_none_or(|word| line.len() + 1 + word.len() > WIDTH);
            if is_full {
                // Writing to a String cannot fail.
                let _ = writeln!(text, "  {:<23}{line}", std::mem::take(&mut name));
                line.clear();
            }
            if let Some(word) = word {
                let space = if line.is_empty() { "" } else { " " };
                line = line + space + word;
            }
        }
    }
    text
}

/// A log of two rows with a column for all that a relay most often has: to be filled in by a drone.
pub fn template() -> String {
    let shown = || COLUMNS.iter().filter(|column| column.example != LATER);
    let line = |cells: Vec<&str>| cells.join(",") + "\n";
    let names = line(shown().map(|column| column.name).collect());
    let rows = [0, 1].map(|row: usize| line(shown().map(|column| column.example[row]).collect()));
    names + &rows.concat()
}

/// Which column each cell of a row belongs to; `None` where it is left out.
pub(super) type Header = Vec<Option<&'static Column>>;

/// The columns that a log's first line names, or what is wrong with it.
pub(super) fn header(line: &csv::StringRecord) -> Result<Header, String> {
    let mut found: Header = Vec::new();
    for (place, cell) in line.iter().enumerate() {
        // numpy.savetxt writes a comment's sign before its header.
        let name = if place == 0 { cell.trim_start_matches(['#', ' ']) } else { cell };
        if name.starts_with('#') {
            found.push(None);
            continue;
        }
        let Some(column) = COLUMNS.iter().find(|column| column.name == name) else {
            return Err(unknown(name, place + 1));
        };
        if found.iter().flatten().any(|other| other.of == column.of) {
            return Err(format!(
                "two columns are called {name}: expected one; put a # before the name of the other"
            ));
        }
        found.push(Some(column));
    }
    agree(&found)?;
    Ok(found)
}

fn unknown(name: &str, number: usize) -> String {
    if name.is_empty() {
        return format!("column {number} has no name: expected one, or # to leave it out");
    }
    if name.parse::<f64>().is_ok() {
        return format!(
            "column {number} is called '{}': values without names above them? expected a header; \
             uchain node --template prints one",
            shorten(name)
        );
    }
    for (separator, words) in [('\t', "tabs"), (';', "semicolons")] {
        if name.contains(separator) {
            return format!("columns are separated by {words}, expected commas");
        }
    }
    let known = COLUMNS.iter().map(|column| column.name.to_owned()).collect();
    let remedy = match Choices::for_word(name, known).nearest {
        Some(nearest) => format!("did you mean '{nearest}'?"),
        None => "put a # before its name to leave it out".to_owned(),
    };
    format!("unknown column '{}'; {remedy} (columns: uchain node --help)", shorten(name))
}

/// Columns that need each other, or exclude each other.
fn agree(found: &[Option<&'static Column>]) -> Result<(), String> {
    let has = |of: Of| found.iter().flatten().any(|column| column.of == of);
    if !has(Of::Time) {
        return Err("no column time_s: expected one, in seconds".to_owned());
    }
    let tof = [0, 1, 2, 3].map(|beam| has(Of::Tof(beam)));
    if tof.contains(&true) && tof.contains(&false) {
        let missing = COLUMNS
            .iter()
            .filter(|column| matches!(column.of, Of::Tof(beam) if !tof[beam]))
            .map(|column| column.name);
        return Err(format!(
            "no column {}: expected all four distances or none; where a sensor is missing, an empty column",
            missing.collect::<Vec<_>>().join(", ")
        ));
    }
    for (end, rssi, loss) in
        [(End::Back, "back_rssi_dbm", "back_loss_db"), (End::Front, "front_rssi_dbm", "front_loss_db")]
    {
        if has(Of::Rssi(end)) && has(Of::Loss(end)) {
            return Err(format!(
                "{rssi} and {loss} are one thing: expected one of them; put a # before the name of the other"
            ));
        }
    }
    Ok(())
}

/// Whether a log may tell of packets from there.
pub(super) fn hears(header: &[Option<&'static Column>], end: End) -> bool {
    header.iter().flatten().any(|column| [Of::Rssi(end), Of::Loss(end)].contains(&column.of))
}
