//! What a chain came to, for people.

use std::fmt::Write as _;

use super::super::{Moment, Summary};
use crate::mission::thinned;

/// Most links listed to people.
const LINKS_SHOWN: usize = 12;

/// A few aligned lines that say what a run came to.
pub(super) fn text(summary: &Summary, wall_s: Option<f64>, files: &str) -> String {
    let wall = wall_s.map(|wall_s| format!(" in {wall_s:.2} s")).unwrap_or_default();
    let mut text =
        format!("{}, seed {}: {} s simulated{wall}\n", summary.scenario, summary.seed, summary.sim_s);
    let mut line = |name: &str, value: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {name:<10} {value}");
    };
    let in_the_air = match summary.uavs {
        1 => "1 UAV".to_owned(),
        n => format!("{n} UAVs"),
    };
    line("outcome", &summary.verdict.words());
    line(
        "reach",
        &match summary.launches_s.len() {
            0 => "nobody took off".to_owned(),
            _ => format!("{:.2} m, {in_the_air} in the air", summary.head_reach_m),
        },
    );
    for (i, link) in summary.links.iter().enumerate().take(LINKS_SHOWN) {
        let to = summary.links.get(i + 1).map_or_else(|| "base".to_owned(), |behind| behind.uav.to_string());
        let filtered = match link.filtered_db {
            Some(filtered_db) => format!("{filtered_db:>6.1} dB filtered"),
            None => "never heard".to_owned(),
        };
        let ends = format!("UAV {} - {to}", link.uav);
        let value = format!("{ends:<14} {:>6.1} dB true  {filtered}", link.true_db);
        line(if i == 0 { "links" } else { "" }, &value);
    }
    if summary.links.len() > LINKS_SHOWN {
        line("", &format!("… and {} more", summary.links.len() - LINKS_SHOWN));
    }
    let converged = match summary.converged_s {
        Some(at_s) => format!("level at {at_s:.1} s"),
        None => "never level".to_owned(),
    };
    match summary.spread_db {
        Some(spread_db) => line("spread", &format!("{spread_db:.1} dB, {converged}")),
        None => line("spread", "none, fewer than two links"),
    }
    line("relays", &relays(summary));
    let launches: Vec<String> = summary.launches_s.iter().map(|at_s| format!("{at_s:.1}")).collect();
    line("launches", &if launches.is_empty() { "none".to_owned() } else { launches.join(", ") + " s" });
    line("contacts", &format!("{} wall, {} UAV", summary.wall_contacts, summary.uav_contacts));
    line("connected", &connected(summary));
    line("digest", &summary.digest);
    line("files", files);
    text
}

/// How long it was connected, in either sense.
fn connected(summary: &Summary) -> String {
    let percent = |share: Option<f64>| share.map(|share| format!("{:.1} % of the time", 100.0 * share));
    let heard = percent(summary.connected_fraction).unwrap_or_else(|| "unknown".to_owned());
    match percent(summary.below_limit_fraction) {
        Some(below) => format!("{heard} heard both ways, {below} within reception"),
        None => "never: the head did not fly".to_owned(),
    }
}

/// Relays and worst link against the optimum.
fn relays(summary: &Summary) -> String {
    let used = summary.relays_used;
    // Without a gap nobody knows the optimum: there is no link, or no middle of the tunnel.
    let Some(gap_db) = summary.bottleneck_gap_db else { return format!("{used} used") };
    let needed = summary.relays_needed.map_or("no number would do".to_owned(), |n| format!("{n} needed"));
    // As it is printed: 0.0 dB are none.
    if gap_db <= -0.05 {
        let gap_db = -gap_db;
        return format!(
            "{used} used, {needed}; worst link {gap_db:.1} dB better than the best chain in mid-tunnel"
        );
    }
    format!("{used} used, {needed}; worst link {:.1} dB worse than the optimum", gap_db.max(0.0))
}

/// Moments as a table of about so many rows.
pub(super) fn table(moments: &[Moment], rows: usize) -> String {
    let mut text =
        "\n  time (s)  UAVs  reach (m)  worst link (dB)  spread (dB)  wall, UAV contacts\n".to_owned();
    let number =
        |value: Option<f32>| value.map_or_else(|| "-".to_owned(), |value_db| format!("{value_db:.1}"));
    for moment in thinned(moments, rows) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {:8.1}  {:4}  {:9.2}  {:>15}  {:>11}  {:>13}, {}{}",
            moment.time_s,
            moment.uavs,
            moment.head_reach_m,
            number(moment.worst_link_db),
            number(moment.spread_db),
            moment.wall_contacts,
            moment.uav_contacts,
            if moment.connected == Some(false) && moment.worst_link_db.is_some() {
                "  not connected"
            } else {
                ""
            },
        );
    }
    text
}
