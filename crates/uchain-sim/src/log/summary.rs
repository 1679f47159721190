//! What a replay came to, for programs and for people.

use std::fmt::Write as _;

use serde::Serialize;
use uchain_core::chain::{Override, Role, Stage};

use super::{Settings, Step, notes::Gaps};

/// What a replay came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Summary {
    /// "head" or "relay", at the end.
    pub role: &'static str,
    /// Place in the chain at the end, 0 leads it.
    pub place: u16,
    /// Rows of the log.
    pub rows: usize,
    /// Time of the first row (s).
    pub start_s: f64,
    /// Time of the last row (s).
    pub end_s: f64,
    /// Time between two decisions (s).
    pub decision_s: f32,
    /// Loss of the front link that makes it take off (dB); `None` of a head, and where the log begins in the air.
    pub s_min_db: Option<f32>,
    /// Decisions.
    pub decisions: usize,
    /// Of these, decisions that no row of the log stands for.
    pub decisions_between_rows: usize,
    /// Places where rows are missing.
    pub gaps: usize,
    /// The longest of them (s).
    pub longest_gap_s: f64,
    /// Packets of the neighbour toward the base.
    pub back: Neighbour,
    /// Packets of the neighbour toward the head.
    pub front: Neighbour,
    /// When it took off (s).
    pub launch_s: Option<f64>,
    /// Why it never took off, in words; `None` if it did.
    pub grounded: Option<String>,
    /// From when on it flew by its laws (s).
    pub flying_s: Option<f64>,
    /// Smallest and largest forward speed it asked for (m/s); `None` if it never flew.
    pub forward_mps: Option<[f32; 2]>,
    /// Largest difference of its two links (dB).
    pub worst_imbalance_db: Option<f32>,
    /// Overrides, in the order in which they first came.
    pub overrides: Vec<Overridden>,
    /// What the drone itself asked for against this, as far as the log has it.
    pub compared: Vec<Compared>,
}

/// What came of one neighbour.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct Neighbour {
    /// Packets in the log.
    pub packets: usize,
    /// Mean loss of them (dB).
    pub mean_db: Option<f64>,
    /// Filtered loss at the end (dB).
    pub filtered_db: Option<f32>,
}

/// How often an override was in force.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Overridden {
    /// Its word.
    pub by: &'static str,
    /// Decisions under it.
    pub decisions: usize,
    /// When it first came (s).
    pub first_s: f64,
    /// At which line of the log; `None` between two rows.
    pub first_line: Option<u64>,
}

/// A command of the log against the node's, over all rows that have both.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Compared {
    /// The column.
    pub column: &'static str,
    /// Rows that have a number there.
    pub rows: usize,
    /// Of these, rows with the very same bits.
    pub same_bits: usize,
    /// Largest difference, in the unit of the column.
    pub largest: f32,
    /// The line of it.
    pub largest_line: Option<u64>,
}

impl Summary {
    pub(super) fn of(steps: &[Step], gaps: &Gaps, settings: &Settings) -> Self {
        let rows = || steps.iter().filter(|step| step.line.is_some());
        let decisions = || steps.iter().filter(|step| step.is_decision);
        let flies = |step: &&Step| step.why.stage == Stage::Flying;
        let last = steps.last();
        let role = match last.map(|step| step.why.role) {
            Some(Role::Head) => "head",
            _ => "relay",
        };
        let heard = |end: usize| {
            let raw =
                || rows().filter_map(|step| step.raw_db[end]).filter(|db| db.is_finite()).map(f64::from);
            let estimates = last.map(|step| [step.why.estimates.back, step.why.estimates.front]);
            let packets = raw().count();
            Neighbour {
                packets,
                mean_db: (packets > 0).then(|| raw().sum::<f64>() / packets as f64 + 0.0),
                filtered_db: estimates.and_then(|ends| ends[end].filtered_db).map(|db| db + 0.0),
            }
        };
        // What is added makes 0 of -0, which says nothing to people.
        let forward = || steps.iter().filter(flies).map(|step| step.command.forward_mps + 0.0);
        Self {
            role,
            place: last.and_then(|step| step.why.place).unwrap_or(settings.place),
            rows: rows().count(),
            start_s: steps.first().map_or(0.0, |step| step.time_s),
            end_s: last.map_or(0.0, |step| step.time_s),
            decision_s: settings.params.equalize.decision_s,
            s_min_db: Some(settings.params.takeoff.s_min_db)
                .filter(|_| settings.place > 0 && !settings.is_airborne),
            decisions: decisions().count(),
            decisions_between_rows: gaps.decisions,
            gaps: gaps.count(),
            longest_gap_s: gaps.longest_s(),
            back: heard(0),
            front: heard(1),
            launch_s: steps.iter().find(|step| step.command.airborne).map(|step| step.time_s),
            grounded: None,
            flying_s: steps.iter().find(flies).map(|step| step.time_s),
            forward_mps: forward().next().map(|_| {
                forward().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
            }),
            worst_imbalance_db: decisions()
                .filter_map(|step| Some(step.why.imbalance_db? + 0.0))
                .max_by(|a, b| a.abs().total_cmp(&b.abs())),
            overrides: overrides(decisions()),
            compared: (0..3).filter_map(|which| compared(which, rows())).collect(),
        }
    }

    /// A few aligned lines for people. `files` says where the rest is.
    pub fn text(&self, label: &str, files: &str) -> String {
        let plural =
            |count: usize, word: &str| format!("{count} {word}{}", if count == 1 { "" } else { "s" });
        let span_s = self.end_s - self.start_s;
        let mut text = format!(
            "{label}: a {} at place {}, {span_s:.1} s in {}, {} at {} Hz\n",
            self.role,
            self.place,
            plural(self.rows, "row"),
            plural(self.decisions, "decision"),
            1.0 / self.decision_s
        );
        let mut line = |name: &str, value: &str| {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "  {name:<10} {value}");
        };
        line("back", &heard(&self.back));
        if self.place > 0 {
            line("front", &heard(&self.front));
        }
        line(
            "launch",
            &match (self.launch_s, self.flying_s) {
                (None, _) => {
                    format!("never: {}", self.grounded.as_deref().unwrap_or("the log ends on the ground"))
                }
                (Some(launch_s), None) => {
                    format!("at {} s; the log ends before it flies by its laws", fixed(launch_s, 2))
                }
                (Some(launch_s), Some(flying_s)) => {
                    format!("at {} s, by its laws from {} s on", fixed(launch_s, 2), fixed(flying_s, 2))
                }
            },
        );
        if let Some([low, high]) = self.forward_mps {
            line("asked", &format!("{} to {} m/s forward", fixed(low, 3), fixed(high, 3)));
        }
        if let Some(imbalance_db) = self.worst_imbalance_db {
            line("imbalance", &format!("{} dB at worst", fixed(imbalance_db, 1)));
        }
        for (i, over) in self.overrides.iter().enumerate() {
            let at =
                over.first_line.map_or_else(|| "between two rows".to_owned(), |line| format!("line {line}"));
            let (name, first_s) = (if i == 0 { "overrides" } else { "" }, fixed(over.first_s, 2));
            let decisions = plural(over.decisions, "decision");
            line(name, &format!("{}: {decisions}, first at {first_s} s, {at}", over.by));
        }
        if self.overrides.is_empty() {
            line("overrides", "none");
        }
        let between = plural(self.decisions_between_rows, "decision");
        line(
            "gaps",
            &match self.gaps {
                0 => format!("none; {between} between rows"),
                gaps => {
                    format!("{gaps}, the longest {:.2} s; {between} between rows", self.longest_gap_s)
                }
            },
        );
        for Compared { column, rows, same_bits, largest, largest_line } in &self.compared {
            let at = largest_line
                .filter(|_| *largest > 0.0)
                .map(|line| format!(" in line {line}"))
                .unwrap_or_default();
            line(
                "log",
                &format!(
                    "{column}: {same_bits} of {} the same to the bit, {largest:.6} off at most{at}",
                    plural(*rows, "row")
                ),
            );
        }
        line("files", files);
        text
    }
}

/// A number with so many digits behind the point, and without a minus before nothing but zeros.
fn fixed(value: impl Into<f64>, digits: usize) -> String {
    let text = format!("{:.digits$}", value.into());
    let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

fn heard(heard: &Neighbour) -> String {
    let packets =
        if heard.packets == 1 { "1 packet".to_owned() } else { format!("{} packets", heard.packets) };
    match (heard.mean_db, heard.filtered_db) {
        (Some(mean_db), Some(filtered_db)) => {
            let (mean_db, filtered_db) = (fixed(mean_db, 1), fixed(filtered_db, 1));
            format!("{packets}, {mean_db} dB in the mean, {filtered_db} dB filtered at the end")
        }
        (Some(mean_db), None) => {
            format!("{packets}, {} dB in the mean, not listened to on the ground", fixed(mean_db, 1))
        }
        _ => "nothing heard".to_owned(),
    }
}

fn overrides<'s>(decisions: impl Iterator<Item = &'s Step>) -> Vec<Overridden> {
    let mut found: Vec<Overridden> = Vec::new();
    for step in decisions {
        let Some(by) = step.why.overridden.map(Override::word) else { continue };
        match found.iter_mut().find(|over| over.by == by) {
            Some(over) => over.decisions += 1,
            None => {
                found.push(Overridden { by, decisions: 1, first_s: step.time_s, first_line: step.line });
            }
        }
    }
    found
}

fn compared<'s>(which: usize, rows: impl Iterator<Item = &'s Step>) -> Option<Compared> {
    let column = ["asked_forward_mps", "asked_lateral_mps", "asked_yaw_rate_radps"][which];
    let mut found = Compared { column, rows: 0, same_bits: 0, largest: 0.0, largest_line: None };
    for step in rows {
        let command = &step.command;
        let ours = [command.forward_mps, command.lateral_mps, command.yaw_rate_radps][which];
        let Some(theirs) = step.asked[which].filter(|theirs| theirs.is_finite()) else { continue };
        found.rows += 1;
        found.same_bits += usize::from(ours.to_bits() == theirs.to_bits());
        let off = (ours - theirs).abs();
        if off > found.largest {
            (found.largest, found.largest_line) = (off, step.line);
        }
    }
    (found.rows > 0).then_some(found)
}
