//! One run as a row: the run, its variant, and what it came to under the names of `summary.json`. Lists that differ in
//! length from run to run stay lists; what a report needs of them stands beside them.

use super::{Flown, Run, Sweep};
use crate::analyse::{Cell, Column, Kind};
use crate::mission::{
    ValueKind,
    chain::{LinkSummary, Summary},
    explore::ExploreSummary,
};

/// A result: its name, what it is, and where it is found.
type Field<S> = (&'static str, Kind, fn(&S) -> Cell);

/// What a chain came to.
const CHAIN: [Field<Summary>; 21] = [
    ("sim_s", Kind::Number, |s| s.sim_s.into()),
    ("launches_s", Kind::Numbers, |s| Cell::list(s.launches_s.iter().copied())),
    ("launches", Kind::Count, |s| s.launches_s.len().into()),
    ("last_launch_s", Kind::Number, |s| s.launches_s.last().copied().into()),
    ("uavs", Kind::Count, |s| s.uavs.into()),
    ("relays_used", Kind::Count, |s| s.relays_used.into()),
    ("relays_needed", Kind::Count, |s| s.relays_needed.into()),
    ("bottleneck_gap_db", Kind::Single, |s| s.bottleneck_gap_db.into()),
    ("link_true_db", Kind::Singles, |s| Cell::list(s.links.iter().map(|link| link.true_db))),
    ("link_filtered_db", Kind::Singles, |s| Cell::list(s.links.iter().map(filtered_db))),
    ("spread_db", Kind::Single, |s| s.spread_db.into()),
    ("worst_link_db", Kind::Single, |s| s.worst_link_db.into()),
    ("converged_s", Kind::Number, |s| s.converged_s.into()),
    ("wall_contacts", Kind::Count, |s| s.wall_contacts.into()),
    ("uav_contacts", Kind::Count, |s| s.uav_contacts.into()),
    ("connected_fraction", Kind::Number, |s| s.connected_fraction.into()),
    ("below_limit_fraction", Kind::Number, |s| s.below_limit_fraction.into()),
    ("head_reach_m", Kind::Single, |s| s.head_reach_m.into()),
    ("outcome", Kind::Text, |s| s.verdict.outcome().word().into()),
    (VERDICT, Kind::Text, |s| s.verdict.to_string().as_str().into()),
    ("digest", Kind::Text, |s| s.digest.as_str().into()),
];

/// What an exploration came to.
const EXPLORE: [Field<ExploreSummary>; 34] = [
    ("strategy", Kind::Text, |s| word(&s.strategy)),
    ("vehicle", Kind::Text, |s| word(&s.vehicle)),
    ("robots", Kind::Count, |s| u32::from(s.robots).into()),
    ("sim_s", Kind::Number, |s| s.sim_s.into()),
    ("iterations", Kind::Count, |s| s.iterations.into()),
    ("moves", Kind::Numbers, |s| Cell::list(s.moves.iter().copied())),
    ("holds", Kind::Numbers, |s| Cell::list(s.holds.iter().copied())),
    ("distance_m", Kind::Numbers, |s| Cell::list(s.distance_m.iter().copied())),
    ("distance_mean_m", Kind::Number, |s| s.distance_mean_m().into()),
    ("distance_3d_m", Kind::Numbers, |s| Cell::list(s.distance_3d_m.iter().copied())),
    ("mfl_s", Kind::Number, |s| s.mfl_s.into()),
    ("coverage", Kind::Number, |s| s.coverage.into()),
    ("coverage_t50_s", Kind::Number, |s| s.coverage_t50_s.into()),
    ("coverage_t90_s", Kind::Number, |s| s.coverage_t90_s.into()),
    ("coverage_t100_s", Kind::Number, |s| s.coverage_t100_s.into()),
    ("overlap", Kind::Number, |s| s.overlap.into()),
    ("balance", Kind::Number, |s| s.balance.into()),
    ("nodes", Kind::Numbers, |s| Cell::list(s.nodes.iter().copied())),
    ("nodes_total", Kind::Count, |s| s.nodes.iter().sum::<u32>().into()),
    ("edges", Kind::Count, |s| s.edges.into()),
    ("hubs_left", Kind::Count, |s| s.hubs_left.into()),
    ("unseen_m2", Kind::Number, |s| s.unseen_m2.into()),
    ("unseen_behind_m2", Kind::Number, |s| s.unseen_behind_m2.into()),
    ("shut_off_m2", Kind::Number, |s| s.shut_off_m2.into()),
    ("wall_contacts", Kind::Count, |s| s.wall_contacts.into()),
    ("robot_contacts", Kind::Count, |s| s.robot_contacts.into()),
    ("level_passes", Kind::Count, |s| s.level_passes.into()),
    ("downwash_s", Kind::Numbers, |s| Cell::list(s.downwash_s.iter().copied())),
    ("downwash_total_s", Kind::Number, |s| s.downwash_s.iter().sum::<f64>().into()),
    ("moves_total", Kind::Count, |s| s.moves.iter().sum::<u32>().into()),
    ("holds_total", Kind::Count, |s| s.holds.iter().sum::<u32>().into()),
    ("outcome", Kind::Text, |s| s.verdict.outcome().word().into()),
    (VERDICT, Kind::Text, |s| s.verdict.to_string().as_str().into()),
    ("digest", Kind::Text, |s| s.digest.as_str().into()),
];

/// Columns before those of the design.
const RUN: [(&str, Kind); 4] =
    [("run", Kind::Count), ("variant", Kind::Count), ("replicate", Kind::Count), ("seed", Kind::Count)];
/// Why a run failed: its outcome's word, or why it was not flown; absent if it did not fail.
pub(super) const FAILED: &str = "failed";
/// What a run came to, in words with numbers.
pub(super) const VERDICT: &str = "verdict";

fn filtered_db(link: &LinkSummary) -> f32 {
    link.filtered_db.unwrap_or(f32::NAN)
}

/// A choice by the name it has in files.
fn word(choice: &impl serde::Serialize) -> Cell {
    match serde_json::to_value(choice) {
        Ok(serde_json::Value::String(word)) => Cell::Text(word),
        _ => Cell::Absent,
    }
}

/// How a run that came to an end still failed its mission: its outcome's word.
fn failure(flown: &Flown) -> Option<&str> {
    let outcome = flown.verdict().outcome();
    (!outcome.is_success()).then(|| outcome.word())
}

/// Whether what became of a run is a failure: it was not flown to its end, or its mission failed.
pub(super) fn has_failed(flown: &Result<Flown, String>) -> bool {
    flown.as_ref().map_or(true, |flown| failure(flown).is_some())
}

impl Sweep {
    /// All columns of its table.
    pub fn columns(&self) -> Vec<Column> {
        let column = |name: &str, kind, is_result| Column { name: name.to_owned(), kind, is_result };
        let mut columns: Vec<Column> = RUN.iter().map(|(name, kind)| column(name, *kind, false)).collect();
        for (key, kind) in self.design.keys().zip(&self.kinds) {
            let kind = match kind {
                ValueKind::Whole => Kind::Count,
                ValueKind::Number => Kind::Number,
                ValueKind::Other => Kind::Text,
            };
            columns.push(column(key, kind, false));
        }
        columns.push(column(FAILED, Kind::Text, false));
        if self.about.is_exploration {
            columns.extend(EXPLORE.iter().map(|(name, kind, _)| column(name, *kind, true)));
        } else {
            columns.extend(CHAIN.iter().map(|(name, kind, _)| column(name, *kind, true)));
        }
        columns
    }

    /// The row of a run, in the order of [`Sweep::columns`].
    pub fn row(&self, run: Run, flown: &Result<Flown, String>) -> Vec<Cell> {
        let mut row: Vec<Cell> =
            [run.index, run.variant, run.replicate, run.seed].into_iter().map(Cell::from).collect();
        for (value, kind) in self.design.values(run.variant).into_iter().zip(&self.kinds) {
            row.push(value.map_or(Cell::Absent, |text| cell(&text, *kind)));
        }
        row.push(match flown {
            Ok(flown) => failure(flown).into(),
            Err(reason) => reason.as_str().into(),
        });
        match flown {
            Ok(Flown::Chain(summary)) => row.extend(CHAIN.iter().map(|(_, _, of)| of(summary))),
            Ok(Flown::Explore(summary)) => row.extend(EXPLORE.iter().map(|(_, _, of)| of(summary))),
            Err(_) => {
                let results = if self.about.is_exploration { EXPLORE.len() } else { CHAIN.len() };
                row.extend((0..results).map(|_| Cell::Absent));
            }
        }
        row
    }
}

/// A varied value, in a column whose type is its key's, whatever the value.
fn cell(text: &str, kind: ValueKind) -> Cell {
    match (kind, text.parse()) {
        (ValueKind::Whole, Ok(toml::Value::Integer(number))) => Cell::Count(number),
        (ValueKind::Number, Ok(toml::Value::Integer(number))) => Cell::Number(number as f64),
        (ValueKind::Number, Ok(toml::Value::Float(number))) => number.into(),
        // A word is the same with quotes and without.
        (ValueKind::Other, Ok(toml::Value::String(word))) => Cell::Text(word),
        (ValueKind::Other, _) => text.into(),
        // A variant with such a value is no scenario.
        _ => Cell::Absent,
    }
}
