//! Summary of a run, as JSON for programs and as text for people.

mod explore;

use std::fmt::Write as _;

use serde::Serialize;
use uchain_sim::{analyse::Verdict, mission::chain::Summary};

/// `summary.json`, and what `--json` prints: of a chain or of an exploration.
#[derive(Debug, Serialize)]
pub(crate) struct Report<'a, S> {
    #[serde(flatten)]
    summary: &'a S,
    /// How long the computer flew (s); the only number here that differs from run to run. A recording does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_s: Option<f64>,
    /// Version of uchain that flew.
    version: &'a str,
}

/// Most links listed to people.
const LINKS_SHOWN: usize = 12;

impl<'a, S: Serialize> Report<'a, S> {
    pub(crate) fn new(summary: &'a S, wall_s: Option<f64>, version: &'a str) -> Self {
        Self { summary, wall_s, version }
    }

    /// JSON with a newline at its end.
    pub(crate) fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self).map(|json| json + "\n")
    }
}

impl Report<'_, Summary> {
    /// A few aligned lines.
    pub(crate) fn text(&self, files: &str) -> String {
        let Self { summary, wall_s, .. } = self;
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
        line("outcome", &outcome(&summary.verdict));
        line(
            "reach",
            &match summary.launches_s.len() {
                0 => "nobody took off".to_owned(),
                _ => format!("{:.2} m, {in_the_air} in the air", summary.head_reach_m),
            },
        );
        for (i, link) in summary.links.iter().enumerate().take(LINKS_SHOWN) {
            let to =
                summary.links.get(i + 1).map_or_else(|| "base".to_owned(), |behind| behind.uav.to_string());
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
}

/// The word and the words.
fn outcome(verdict: &Verdict) -> String {
    format!("{}: {verdict}", verdict.outcome().word())
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
