//! What axes of pictures are called: plain words, with the unit.

use crate::registry::Registry;

/// Numbers of the summaries whose names alone do not say it.
const KNOWN: [(&str, &str); 36] = [
    ("launches", "launches"),
    ("uavs", "UAVs in the air at the end"),
    ("sim_s", "length of the run (s)"),
    ("last_launch_s", "last launch (s)"),
    ("relays_used", "relays in the air at the end"),
    ("relays_needed", "relays that are needed"),
    ("bottleneck_gap_db", "worst link, over that of the best chain (dB)"),
    ("spread_db", "largest minus smallest loss at the end (dB)"),
    ("worst_link_db", "largest loss of any link (dB)"),
    ("converged_s", "links level after (s)"),
    ("wall_contacts", "contacts with walls"),
    ("uav_contacts", "contacts of UAVs"),
    ("robot_contacts", "contacts of robots"),
    ("connected_fraction", "share of the time connected (0 to 1)"),
    ("below_limit_fraction", "share of the time within reception (0 to 1)"),
    ("head_reach_m", "how far the head came (m)"),
    ("head_flown_m", "how far the head flew forward (m)"),
    ("robots", "robots"),
    ("iterations", "rounds"),
    ("nodes_total", "nodes of the graph"),
    ("edges", "edges of the graph"),
    ("hubs_left", "hubs left"),
    ("level_passes", "passes on other levels"),
    ("moves_total", "moves, all robots"),
    ("holds_total", "rounds held, all robots"),
    ("distance_mean_m", "distance per robot (m)"),
    ("mfl_s", "time on other levels (s)"),
    ("coverage", "share seen (0 to 1)"),
    ("coverage_t50_s", "half is seen after (s)"),
    ("coverage_t90_s", "90 % are seen after (s)"),
    ("coverage_t100_s", "all is seen after (s)"),
    ("overlap", "share seen by more than one robot (0 to 1)"),
    ("balance", "shortest over longest way (0 to 1)"),
    ("unseen_m2", "reachable, not seen (m²)"),
    ("unseen_behind_m2", "not seen behind narrow passages (m²)"),
    ("shut_off_m2", "out of reach (m²)"),
];

/// Of a number of the summary; of one that nobody knows, what its name says.
pub(super) fn of_metric(name: &str) -> String {
    let known = KNOWN.iter().find(|(known, _)| *known == name);
    known.map_or_else(|| spelled(name), |(_, words)| (*words).to_owned())
}

/// `time_on_air_s` in words: time on air (s).
fn spelled(name: &str) -> String {
    const UNITS: [(&str, &str); 9] = [
        ("_mps", "m/s"),
        ("_radps", "rad/s"),
        ("_percent", "%"),
        ("_rad", "rad"),
        ("_m2", "m²"),
        ("_db", "dB"),
        ("_hz", "Hz"),
        ("_m", "m"),
        ("_s", "s"),
    ];
    let found = UNITS.iter().find_map(|(suffix, unit)| Some((name.strip_suffix(suffix)?, *unit)));
    match found.filter(|(stem, _)| !stem.is_empty()) {
        Some((stem, unit)) => format!("{} ({unit})", stem.replace('_', " ")),
        None => name.replace('_', " "),
    }
}

/// A key as an axis of a picture calls it: its meaning, if that is known, and its name.
pub fn key_in_words(registry: Registry, key: &str) -> String {
    match meaning(registry, key) {
        Some(meaning) => format!("{meaning}: {key}"),
        None => key.to_owned(),
    }
}

#[cfg(feature = "schema")]
fn meaning(registry: Registry, key: &str) -> Option<String> {
    /// Letters that have room below a picture, the key included.
    const LONGEST: usize = 84;
    let explained = registry.explain(key).ok()?;
    let words = explained.first()?.headline().to_owned();
    let fits = words.chars().count() + key.chars().count() + 2 <= LONGEST;
    (fits && !words.is_empty()).then_some(words)
}

#[cfg(not(feature = "schema"))]
fn meaning(_: Registry, _: &str) -> Option<String> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_nobody_knows_is_spelled_out_with_its_unit() {
        assert_eq!(of_metric("spread_db"), "largest minus smallest loss at the end (dB)");
        assert_eq!(of_metric("time_on_air_s"), "time on air (s)");
        assert_eq!(of_metric("laps"), "laps");
        assert_eq!(of_metric("_s"), " s");
    }
}
