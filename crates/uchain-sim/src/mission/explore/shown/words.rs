//! What an exploration came to, for people.

use std::fmt::Write as _;

use super::super::{ExploreSummary, Progress};
use crate::mission::thinned;

/// Most robots of which each is listed.
const EACH_MAX: usize = 12;
/// Most unseen pieces listed to people.
const UNSEEN_SHOWN: usize = 5;

/// A few aligned lines that say what an exploration came to.
pub(super) fn text(summary: &ExploreSummary, wall_s: Option<f64>, files: &str) -> String {
    let wall = wall_s.map(|wall_s| format!(" in {wall_s:.2} s")).unwrap_or_default();
    let mut text =
        format!("{}, seed {}: {:.1} s simulated{wall}\n", summary.scenario, summary.seed, summary.sim_s);
    let mut line = |name: &str, value: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {name:<10} {value}");
    };
    let list = |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(", ");
    let metres = |m: &[f64]| {
        if m.len() <= EACH_MAX {
            return list(&mut m.iter().map(|m| format!("{m:.1}")));
        }
        let [least, mean, most] = spread(m);
        format!("{least:.1} to {most:.1} (mean {mean:.1})")
    };
    let counts = |n: &[u32]| {
        if n.len() <= EACH_MAX {
            return list(&mut n.iter().map(u32::to_string));
        }
        let [least, mean, most] = spread(&n.iter().map(|&n| f64::from(n)).collect::<Vec<_>>());
        format!("{least} to {most} (mean {mean:.1})")
    };
    line("outcome", &summary.verdict.words());
    line(
        "iterations",
        &format!(
            "{} rounds; moves {}; holds {}",
            summary.iterations,
            counts(&summary.moves),
            counts(&summary.holds)
        ),
    );
    let share = |balance| format!(", shortest {:.0} % of longest", 100.0 * balance);
    let balance = summary.balance.map(share).unwrap_or_default();
    line("distance", &format!("{} m over ground{balance}", metres(&summary.distance_m)));
    line("", &format!("{} m with climbs", metres(&summary.distance_3d_m)));
    line("levels", &format!("{:.1} s on other levels", summary.mfl_s));
    let by = |share: &str, at_s: Option<f64>| match at_s {
        Some(at_s) => format!("{share} by {at_s:.0} s"),
        None => format!("{share} never"),
    };
    let [t50, t90, t100] = [
        by("half of the ground", summary.coverage_t50_s),
        by("90 %", summary.coverage_t90_s),
        by("all", summary.coverage_t100_s),
    ];
    line("seen", &format!("{:.2} %; {t50}, {t90}, {t100}", 100.0 * summary.coverage));
    line("overlap", &format!("{:.1} % seen by more than one robot", 100.0 * summary.overlap));
    for piece in summary.unseen.iter().take(UNSEEN_SHOWN) {
        line("unseen", &format!("{:.3} m2 around ({:.2}, {:.2}) m", piece.area_m2, piece.x_m, piece.y_m));
    }
    if summary.unseen.len() > UNSEEN_SHOWN {
        line("", &format!("… {:.3} m2 in all", summary.unseen_m2));
    }
    line(
        "map",
        &format!(
            "{} nodes, {} edges, {} with a frontier left",
            counts(&summary.nodes),
            summary.edges,
            summary.hubs_left
        ),
    );
    line(
        "contacts",
        &format!(
            "{} wall, {} robot; {} near passes between levels",
            summary.wall_contacts, summary.robot_contacts, summary.level_passes
        ),
    );
    let seconds = |s: &[f64]| list(&mut s.iter().map(|s| format!("{s:.1}")));
    line("downwash", &format!("{} s below another robot", seconds(&summary.downwash_s)));
    // A contact is one of two on one level: of those the gap is told first.
    let beside = summary.gaps.iter().filter_map(|gap| Some((gap.beside_m?, gap.robots)));
    match beside.min_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((m, [i, j])) => line("gaps", &format!("{m:.2} m at least side by side, robots {i} and {j}")),
        None if !summary.gaps.is_empty() => line("gaps", "never side by side"),
        None => {}
    }
    if let Some(gap) = summary.gaps.first() {
        let [i, j] = gap.robots;
        line(
            "",
            &format!("{:.2} m at least through the air, climbs included, robots {i} and {j}", gap.least_m),
        );
    }
    line("digest", &summary.digest);
    line("files", files);
    text
}

/// Least, mean and largest.
fn spread(numbers: &[f64]) -> [f64; 3] {
    let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
    let most = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [least, numbers.iter().sum::<f64>() / numbers.len().max(1) as f64, most]
}

/// Rounds as a table of about so many rows.
pub(super) fn table(progress: &[Progress], rows: usize) -> String {
    let mut text =
        "\n  time (s)  rounds  nodes  edges  with a frontier  moving  flown (m)  wall, robot contacts\n"
            .to_owned();
    for now in thinned(progress, rows) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {:8.1}  {:6}  {:5}  {:5}  {:15}  {:6}  {:9.1}  {:>13}, {}",
            now.time_s,
            now.rounds,
            now.nodes,
            now.edges,
            now.hubs,
            now.moving,
            now.distance_m,
            now.wall_contacts,
            now.robot_contacts,
        );
    }
    text
}
