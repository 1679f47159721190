//! A plan as text for people: what it stands on, a table over the depth of the head, where the relays stand, whose battery
//! lasts, and the answer in one sentence.

mod answer;
mod blocks;
mod files;
mod flown;

use std::fmt::Write as _;

use crate::{
    analyse::optimum::MOST_LINKS,
    mission::chain::{Plan, PlanRow},
};

pub(in crate::mission::chain) use answer::{answer, help};
use answer::{cut, too_few, too_long};
pub use files::{everywhere_csv, places_csv, places_geojson};

/// Most rows by default.
const ROWS_MAX: f64 = 20.0;
/// Rows of the files for each of the table, and the depth beyond which there are no more (m): a row takes the longer
/// the more relays it needs.
const FINER: f64 = 5.0;
const FINER_TO_M: f64 = 200.0;

/// How finely the depth is divided.
#[derive(Debug, Clone, Copy)]
pub struct PlanSteps {
    /// In the plan (m).
    pub plan_m: f64,
    /// In the table (m).
    pub table_m: f64,
}

impl PlanSteps {
    /// As asked for; else the least round step that gives at most 20 rows down to `to_m`, and a fifth of it in
    /// the files of a tunnel of usual length.
    pub fn new(to_m: f64, asked_m: Option<f64>) -> Self {
        if let Some(step_m) = asked_m {
            return Self { plan_m: step_m, table_m: step_m };
        }
        let mut table_m = 0.01;
        'decades: for decade in [0.01, 0.1, 1.0, 10.0, 100.0, 1000.0, 10_000.0] {
            for share in [1.0, 2.0, 2.5, 5.0] {
                table_m = decade * share;
                if to_m <= ROWS_MAX * table_m {
                    break 'decades;
                }
            }
        }
        let finer = if to_m <= FINER_TO_M { FINER } else { 1.0 };
        Self { plan_m: table_m / finer, table_m }
    }
}

/// A plan and the rows of it that are shown.
#[derive(Debug)]
pub struct PlanTable<'a> {
    plan: &'a Plan,
    shown: Vec<&'a PlanRow>,
}

impl<'a> PlanTable<'a> {
    /// Of a plan that was made in these steps.
    pub fn new(plan: &'a Plan, steps: &PlanSteps) -> Self {
        let round = |row: &PlanRow| {
            let steps = row.depth_m / steps.table_m;
            steps > 0.5 && (steps - steps.round()).abs() < 1e-6
        };
        let mut shown: Vec<&PlanRow> = plan.rows.iter().filter(|row| round(row)).collect();
        if let Some(last) =
            plan.rows.last().filter(|last| shown.last().is_none_or(|row| row.depth_m < last.depth_m))
        {
            shown.push(last);
        }
        Self { plan, shown }
    }

    /// Title, what is assumed, rows, places, batteries, answer.
    pub fn text(&self) -> String {
        let plan = self.plan;
        let speed =
            plan.speed_mps.map(|mps| format!(", the head at {} m/s", rounded(mps))).unwrap_or_default();
        let speed = speed + &cut(plan).map(|cut| format!(" ({cut})")).unwrap_or_default();
        let mut text =
            format!("{}: links of at most {} dB{speed}\n\n", plan.scenario, rounded(plan.s_min_db));
        text += &blocks::assumptions(plan);
        text += "\n  depth  relays  worst link  one fewer  head there  relay 1 is up  all home\n";
        text += "    (m)  needed        (dB)       (dB)       (min)          (min)     (min)\n";
        for row in &self.shown {
            let one_fewer = row.relays_needed.and_then(|relays| relays.checked_sub(1));
            let one_fewer_db = one_fewer.and_then(|at| row.bottleneck_by_links_db.get(at)).copied();
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "{:>7.2}  {:>6}  {:>10}  {:>9}  {:>10}  {:>13}  {:>8}  {}",
                row.depth_m,
                row.relays_needed.map_or_else(|| "-".to_owned(), |relays| relays.to_string()),
                decimal(row.bottleneck_db),
                decimal(one_fewer_db),
                decimal(row.time_min),
                decimal(row.first_relay_min),
                decimal(row.home_min),
                self.verdict(row),
            );
        }
        text += &blocks::places(plan);
        text += &blocks::batteries(plan);
        text += &blocks::sensitivity(plan);
        text += &blocks::budget(plan);
        text += &blocks::reach(plan);
        text += &flown::flown(plan);
        let _ = writeln!(text, "\n{}", self.answer());
        text
    }

    /// What the planner wants to know, in one sentence.
    pub fn answer(&self) -> String {
        answer(self.plan)
    }

    fn verdict(&self, row: &PlanRow) -> &'static str {
        let usable_min = self.plan.batteries.as_ref().map(|batteries| batteries.usable_min);
        let is_home =
            row.home_min.zip(usable_min).is_none_or(|(home_min, usable_min)| home_min <= usable_min);
        match (row.relays_needed, too_few(self.plan, row), too_long(self.plan, row)) {
            (None, ..) => "out of reach",
            (Some(relays), ..) if relays >= MOST_LINKS => "too many",
            (_, true, true) => "too few UAVs, too long",
            (_, true, false) => "too few UAVs",
            (_, false, true) => "too long",
            (_, false, false) if !row.feasible => "beyond reach", // no number of relays held on the way here
            (_, false, false) if is_home => "ok",
            (_, false, false) => "no way back",
        }
    }
}

fn decimal(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1}"))
}

/// To two decimals, without zeros at the end.
fn rounded(value: f64) -> f64 {
    (100.0 * value).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_to_twenty_rows_are_shown_whatever_the_depth() {
        let mut to_m = 0.3;
        while to_m < 100_000.0 {
            let rows = to_m / PlanSteps::new(to_m, None).table_m;
            assert!((10.0 - 1e-9..=20.0).contains(&rows), "{to_m} m: {rows}");
            to_m *= 1.005;
        }
    }
}
