//! Flights beside their plan.

use std::fmt::Write as _;

use super::decimal;
use crate::mission::chain::{FlightEnd, FlownRun, Plan};

/// Median and worst flight beside what was planned.
pub(super) fn flown(plan: &Plan) -> String {
    let Some((flown, goal)) = plan.flown.as_ref().zip(plan.rows.last()) else { return String::new() };
    let count = flown.runs.len();
    let there = flown.runs.iter().filter(|run| run.there_min.is_some()).count();
    let mut text = format!(
        "\nflown {count} times for {:.1} min with {} UAVs; the head was there in {there} of {count}\n",
        flown.duration_s / 60.0,
        flown.uavs,
    );
    text += "                        planned    median     worst\n";
    let mut line = |name: &str, planned: String, of: &dyn Fn(&FlownRun) -> String| {
        let _ =
            writeln!(text, "  {name:<20}  {planned:>7}  {:>8}  {:>8}", of(&flown.median), of(&flown.worst));
    };
    line("reach (m)", format!("{:.1}", goal.depth_m), &|run| format!("{:.1}", run.reach_m));
    line("head there (min)", decimal(goal.time_min), &|run| decimal(run.there_min));
    line("relays", goal.relays_needed.map_or_else(|| "-".to_owned(), |relays| relays.to_string()), &|run| {
        run.relays.to_string()
    });
    line("worst link (dB)", decimal(goal.bottleneck_db), &|run| decimal(run.worst_link_db));
    line("connected (%)", "100".to_owned(), &|run| format!("{:.1}", 100.0 * run.connected_fraction));
    line("contacts", "0".to_owned(), &|run| run.contacts.to_string());
    for end in FlightEnd::ALL.into_iter().filter(|end| *end != FlightEnd::Arrived) {
        let count = flown.runs.iter().filter(|run| run.ended == Some(end)).count();
        if count > 0 {
            let _ = writeln!(text, "  {count} of {}: {}", flown.runs.len(), end.words());
        }
    }
    text += "  A plan is a best case: in a flight relays have to find their places by what they measure.\n";
    text
}
