//! A plan as text for people: a table over the depth of the head, and the answer in one sentence.

use std::fmt::Write as _;

use crate::{
    analyse::optimum::MOST_LINKS,
    mission::chain::{Plan, PlanRow},
};

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

    /// Title, rows, answer.
    pub fn text(&self) -> String {
        let plan = self.plan;
        let speed =
            plan.speed_mps.map(|mps| format!(", the head at {} m/s", rounded(mps))).unwrap_or_default();
        let speed = speed + &self.cut().map(|cut| format!(" ({cut})")).unwrap_or_default();
        let mut text =
            format!("{}: links of at most {} dB{speed}\n\n", plan.scenario, rounded(plan.s_min_db));
        text += "  depth  relays  worst link  one fewer  head there  relay 1 flies\n";
        text += "    (m)  needed        (dB)       (dB)       (min)          (min)\n";
        for row in &self.shown {
            let one_fewer = row.relays_needed.and_then(|relays| relays.checked_sub(1));
            let one_fewer_db = one_fewer.and_then(|at| row.bottleneck_by_links_db.get(at)).copied();
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "{:>7.2}  {:>6}  {:>10}  {:>9}  {:>10}  {:>13}  {}",
                row.depth_m,
                row.relays_needed.map_or_else(|| "-".to_owned(), |relays| relays.to_string()),
                decimal(row.bottleneck_db),
                decimal(one_fewer_db),
                decimal(row.time_min),
                decimal(row.first_relay_min),
                self.verdict(row),
            );
        }
        let _ = writeln!(text, "\n{}", self.answer());
        text
    }

    /// What the planner wants to know, in one sentence.
    pub fn answer(&self) -> String {
        let plan = self.plan;
        let Some(last) = plan.rows.last() else { return "There is nothing to plan.".to_owned() };
        let depth_m = rounded(last.depth_m);
        let mut sentence = match plan.uavs_needed {
            None => {
                let s_min_db = rounded(plan.s_min_db);
                format!(
                    "{depth_m} m cannot be had with links of {s_min_db} dB and up to {} relays",
                    MOST_LINKS - 1
                )
            }
            Some(1) => format!("{depth_m} m need no relay (1 UAV)"),
            Some(2) => format!("{depth_m} m need 1 relay (2 UAVs)"),
            Some(uavs) => format!("{depth_m} m need {} relays ({uavs} UAVs)", uavs - 1),
        };
        if let Some((uavs, relays)) = plan.uavs_needed.zip(last.relays_needed) {
            if relays + 1 < uavs {
                let _ = write!(sentence, " on the way and {relays} at the end");
            }
            if self.too_few(last) {
                let at_hand = plan.relays_available.unwrap_or_default() + 1;
                let _ = write!(sentence, ", {at_hand} at hand: too few");
            }
            self.times(last, &mut sentence);
        }
        if !last.feasible {
            let _ = match (plan.feasible_to_m, plan.rows.first()) {
                (Some(depth_m), _) => write!(sentence, "; {} m can be done", rounded(depth_m)),
                (None, first) => {
                    let first_m = first.map_or(0.0, |first| rounded(first.depth_m));
                    write!(sentence, "; not even {first_m} m can be done")
                }
            };
        }
        sentence + "."
    }

    fn times(&self, last: &PlanRow, sentence: &mut String) {
        let Some(time_min) = last.time_min else { return };
        let _ = write!(sentence, "; the head is there after {time_min:.1} min");
        if let Some(cut) = self.cut() {
            let _ = write!(sentence, " ({cut})");
        }
        if let Some(first_min) = last.first_relay_min {
            let _ = write!(sentence, "; the first relay then has hovered {first_min:.1} min");
        }
        let endurance_min = self.plan.endurance_s / 60.0;
        let verdict = if self.too_long(last) { "too long" } else { "long enough" };
        let _ = write!(sentence, "; a battery lasts {endurance_min:.1} min: {verdict}");
    }

    /// Why the head is slower than asked, if it is.
    fn cut(&self) -> Option<String> {
        let asked_mps = rounded(self.plan.speed_asked_mps?);
        let flown_mps = rounded(self.plan.speed_mps.unwrap_or_default());
        Some(format!("{asked_mps} m/s asked, cut to equalize.v_max_mps = {flown_mps}"))
    }

    /// On the way or there.
    fn too_few(&self, row: &PlanRow) -> bool {
        let so_far = self.plan.launches.iter().filter(|launch| launch.depth_m <= row.depth_m);
        self.plan.relays_available.is_some_and(|relays| so_far.count() > relays)
    }

    fn too_long(&self, row: &PlanRow) -> bool {
        row.time_min.is_some_and(|time_min| 60.0 * time_min > self.plan.endurance_s)
    }

    fn verdict(&self, row: &PlanRow) -> &'static str {
        match (row.relays_needed, self.too_few(row), self.too_long(row)) {
            (None, ..) => "out of reach",
            (_, true, true) => "too few UAVs, too long",
            (_, true, false) => "too few UAVs",
            (_, false, true) => "too long",
            (_, false, false) if row.feasible => "ok",
            // No number of relays held on the way here.
            (_, false, false) => "beyond reach",
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
