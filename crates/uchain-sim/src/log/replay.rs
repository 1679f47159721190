//! A node fed with a log, row by row and decision by decision.

use std::path::Path;

use uchain_core::chain::{
    BASE_ID, Brain as _, Command, Explanation, Heard, Node, Observation, Packet, PilotInput, RadioSlot, Role,
    Tof,
};

use super::{
    LogError, Settings,
    clock::Clock,
    columns::{End, hears},
    notes::{Gaps, Grounded, Readings, no_numbers},
    rows::{self, Row, Rows, Word},
    summary::Summary,
};

/// Most steps of a replay: rows, and decisions in gaps between them.
pub const STEPS_MAX: usize = 500_000;

/// One call of the node: a row of the log, or a decision in a gap between two rows.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Step {
    /// Its line in the log; `None` in a gap.
    pub line: Option<u64>,
    /// When (s).
    pub time_s: f64,
    /// Whether a decision was due.
    pub is_decision: bool,
    /// What the node asked for.
    pub command: Command,
    /// What it believed, and why it asked for that.
    pub why: Explanation,
    /// Loss of a packet that the log has in this row, toward the base and toward the head (dB).
    pub raw_db: [Option<f32>; 2],
    /// Distances in this row.
    pub tof: Option<Tof>,
    /// The drone's own forward speed in this row (m/s).
    pub ground_speed_mps: Option<f32>,
    /// What the drone itself asked for: forward, lateral (m/s), yaw rate (rad/s).
    pub asked: [Option<f32>; 3],
}

/// What a node would have asked for, all along a log.
#[derive(Debug, Clone)]
pub struct Replay {
    pub(super) steps: Vec<Step>,
    pub(super) summary: Summary,
    /// What most rows lie apart (s).
    pub(super) usual_s: f64,
    notes: Vec<String>,
}

impl Replay {
    /// Replays a log in a file of at most [`LOG_MAX_BYTES`](super::LOG_MAX_BYTES).
    ///
    /// # Errors
    /// [`LogError::Read`]; those of [`Replay::of`].
    pub fn read(path: &Path, settings: &Settings) -> Result<Self, LogError> {
        Self::of(&rows::text(path)?, &path.display().to_string(), settings)
    }

    /// Replays a log; `label` is what messages call it.
    ///
    /// # Errors
    /// What is wrong with it: line, column, what was expected.
    pub fn of(text: &str, label: &str, settings: &Settings) -> Result<Self, LogError> {
        let text = rows::plain(text);
        let mut rows = Rows::start(&text, label)?;
        can_decide(&rows, label, settings)?;
        let mut flight: Option<Flight> = None;
        let mut readings = Readings::new(settings);
        while let Some(row) = rows.next()? {
            let flight = flight.get_or_insert_with(|| Flight::start(settings, row.time_s));
            flight.see(&row);
            readings.see(&row);
            if flight.steps.len() > STEPS_MAX {
                let line = flight.steps.iter().rev().find_map(|step| step.line).unwrap_or(1);
                let why = format!(
                    "more than {STEPS_MAX} rows, with the decisions between them: cut the log into parts (--airborne)"
                );
                return Err(LogError::Line { label: label.to_owned(), line, why });
            }
        }
        let Some(flight) = flight else {
            let why = "no rows below the header: expected one for each moment".to_owned();
            return Err(LogError::Whole { label: label.to_owned(), why });
        };
        let gaps = Gaps::of(&flight.steps, flight.clock.period_s());
        let notes = [no_numbers(label, &rows.no_numbers), readings.notes(label), gaps.notes(label)].concat();
        let mut summary = Summary::of(&flight.steps, &gaps, settings);
        if summary.launch_s.is_none() {
            summary.grounded = Some(flight.grounded.words(&flight.steps, &settings.params));
        }
        Ok(Self { steps: flight.steps, summary, usual_s: gaps.usual_s, notes })
    }

    /// All steps, in order of time.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// What it came to.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }

    /// What is odd about the log and was read all the same, a line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// An error for a log that tells nothing of a link without which nothing is decided.
fn can_decide(rows: &Rows<'_>, label: &str, settings: &Settings) -> Result<(), LogError> {
    let is_head = settings.place == 0;
    for (end, is_needed, rssi, loss) in [
        (End::Back, true, "back_rssi_dbm", "back_loss_db"),
        (End::Front, !is_head, "front_rssi_dbm", "front_loss_db"),
    ] {
        if is_needed && !hears(&rows.header, end) {
            let who = if is_head {
                "a head decides by it (for a relay: --role relay)"
            } else {
                "a relay decides by both of its links (for a head: --role head)"
            };
            let why = format!("no column {rssi} or {loss}: {who}");
            return Err(LogError::Whole { label: label.to_owned(), why });
        }
    }
    Ok(())
}

/// A node on its way through a log.
struct Flight {
    node: Node,
    is_of_age_s: f32,
    clock: Clock,
    place: u16,
    pilot: Option<PilotInput>,
    battery: Option<f32>,
    /// Since the last decision.
    heard: [Option<Word>; 2],
    ground_speed_mps: Option<f32>,
    steps: Vec<Step>,
    grounded: Grounded,
}

impl Flight {
    fn start(settings: &Settings, start_s: f64) -> Self {
        let params = settings.node_params();
        let role = if settings.place == 0 { Role::Head } else { Role::Relay };
        Self {
            is_of_age_s: params.takeoff.after_previous_s,
            clock: Clock::new(start_s, params.equalize.decision_s),
            node: Node::new(role, params),
            place: settings.place,
            pilot: None,
            battery: None,
            heard: [None; 2],
            ground_speed_mps: None,
            steps: Vec::new(),
            grounded: Grounded::default(),
        }
    }

    /// A row of the log, after the decisions that were due before it.
    fn see(&mut self, row: &Row) {
        self.pass_gap(row);
        self.place = row.place.unwrap_or(self.place);
        if row.pilot_mps.is_some() || row.pilot_follow.is_some() {
            let before = self.pilot.unwrap_or_default();
            self.pilot = Some(PilotInput {
                speed_mps: row.pilot_mps.unwrap_or(before.speed_mps),
                follow: row.pilot_follow.unwrap_or(before.follow),
            });
        }
        self.battery = row.battery.or(self.battery);
        self.ground_speed_mps = row.ground_speed_mps.or(self.ground_speed_mps);
        self.heard = [row.back.or(self.heard[0]), row.front.or(self.heard[1])];
        let is_decision = self.clock.is_due(row.time_s);
        self.step(is_decision, row);
    }

    /// The decisions between the row before and this one, of which the log knows nothing: nothing is heard in them but what was
    /// put by.
    fn pass_gap(&mut self, row: &Row) {
        // The last one that is due is the row's own.
        while self.clock.is_due(row.time_s - self.clock.period_s()) && self.steps.len() <= STEPS_MAX {
            let time_s = self.clock.next_s();
            self.step(true, &Row { time_s, ..Row::default() });
        }
    }

    fn step(&mut self, is_decision: bool, row: &Row) {
        let seen = Observation {
            place: Some(self.place),
            tof: row.tof,
            radio: is_decision.then(|| self.radio()),
            ground_speed_mps: if is_decision { self.ground_speed_mps.take() } else { row.ground_speed_mps },
            battery: self.battery,
            pilot: self.pilot,
        };
        if is_decision {
            self.clock.decide();
        }
        let command = self.node.decide(&seen);
        if is_decision {
            self.grounded.see(row.time_s, self.node.doing(&seen).and_then(|doing| doing.launch));
        }
        // A node always explains itself.
        let Some(why) = self.node.explain(&seen) else { return };
        let raw_db = [row.back, row.front].map(|word| word.map(|word| word.loss_db));
        self.steps.push(Step {
            line: (row.line > 0).then_some(row.line),
            time_s: row.time_s,
            is_decision,
            command,
            why,
            raw_db,
            tof: row.tof,
            ground_speed_mps: row.ground_speed_mps,
            asked: row.asked,
        });
    }

    /// What was heard since the last decision: the last packet of each neighbour.
    fn radio(&mut self) -> RadioSlot {
        let [back, front] = std::mem::take(&mut self.heard);
        let back = back.map(|word| {
            let place = if word.packet.is_base { Packet::BASE_PLACE } else { self.place.saturating_add(1) };
            let from = if word.packet.is_base { BASE_ID } else { place };
            Heard { from, loss_db: word.loss_db, packet: Packet { place, ..word.packet } }
        });
        // Nobody is ahead of the head.
        let front = front.filter(|_| self.place > 0).map(|word| {
            let place = self.place - 1;
            let flown_s = if word.is_of_age { self.is_of_age_s } else { word.packet.flown_s };
            Heard { from: place, loss_db: word.loss_db, packet: Packet { place, flown_s, ..word.packet } }
        });
        front.into_iter().chain(back).collect()
    }
}
