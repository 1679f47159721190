//! The comparison of strategies (Kim 2021, §7.2) among robots that leave to one another the places they have announced: 1 to
//! 6 robots, three strategies, two maps, 20 seeds. How it is by Eq. 7 alone is in `docs/cooperation.md`.

use std::sync::Arc;

use std::fmt::Write as _;

use uchain_core::explore::StrategyKind;
use uchain_sim::mission::{
    Stopped,
    explore::{ExploreSummary, Site},
};

use super::{site, summary};

const MAPS: [&str; 2] = ["apartment", "corridors"];
const STRATEGIES: [&str; 3] = ["cssg", "cssg-random", "srg"];
const ROBOTS: std::ops::RangeInclusive<usize> = 1..=6;
const SEEDS: u64 = 20;

/// A column of the table.
type Of = fn(&Row) -> f64;

/// Means over the seeds.
#[derive(Debug, Clone, Copy)]
struct Row {
    iterations: f64,
    metres: f64,
    nodes: f64,
    seen_least: f64,
    overlap: f64,
    mfl_s: f64,
    holds: f64,
}

/// All runs, by map, strategy, robots and seed; shared out over threads, in that order.
fn runs() -> Vec<Vec<ExploreSummary>> {
    let mut sites: Vec<Arc<Site>> = Vec::new();
    for map in MAPS {
        for strategy in STRATEGIES {
            for robots in ROBOTS {
                let sets = [format!("explore.strategy={strategy}"), format!("explore.robots={robots}")];
                let [strategy, robots] = sets.each_ref().map(String::as_str);
                sites.push(site(map, &[strategy, robots, "explore.taken=left"]));
            }
        }
    }
    let all = |site: &Arc<Site>| (1..=SEEDS).map(|seed| summary(site, seed)).collect::<Vec<_>>();
    let threads = std::thread::available_parallelism().map_or(2, std::num::NonZero::get);
    let mut rows: Vec<(usize, Vec<ExploreSummary>)> = std::thread::scope(|scope| {
        let sites = &sites;
        let share = |first: usize| {
            scope.spawn(move || {
                let own = sites.iter().enumerate().skip(first).step_by(threads);
                own.map(|(i, site)| (i, all(site))).collect::<Vec<_>>()
            })
        };
        let shares: Vec<_> = (0..threads).map(share).collect();
        shares.into_iter().flat_map(|share| share.join().expect("no panic")).collect()
    });
    rows.sort_by_key(|(i, _)| *i);
    rows.into_iter().map(|(_, row)| row).collect()
}

fn row(runs: &[ExploreSummary]) -> Row {
    let mean = |of: &dyn Fn(&ExploreSummary) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
    Row {
        iterations: mean(&|run| run.iterations.into()),
        metres: mean(&ExploreSummary::distance_mean_m),
        nodes: mean(&|run| run.nodes.iter().sum::<u32>().into()),
        seen_least: runs.iter().map(|run| run.coverage).fold(1.0, f64::min),
        overlap: mean(&|run| run.overlap),
        mfl_s: mean(&|run| run.mfl_s),
        holds: mean(&|run| run.holds.iter().sum::<u32>().into()),
    }
}

fn at(rows: &[Row], map: usize, strategy: usize, robots: usize) -> Row {
    rows[(map * STRATEGIES.len() + strategy) * ROBOTS.count() + robots - 1]
}

/// What a strategy saves against another one, from 2 to 5 robots (%).
fn savings(rows: &[Row], map: usize, [a, b]: [usize; 2], of: Of) -> String {
    let share = |n| of(&at(rows, map, a, n)) / of(&at(rows, map, b, n));
    let savings = (2..=5).map(|n| format!("{:6.2}", 100.0 * (1.0 - share(n))));
    savings.collect::<Vec<_>>().join(" ")
}

fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<10} {:<12} {:>6} {:>10} {:>9} {:>6} {:>8} {:>8} {:>6} {:>6}\n",
        "map", "strategy", "robots", "iterations", "m/robot", "nodes", "least %", "overlap", "mfl s", "holds"
    );
    for (i, row) in rows.iter().enumerate() {
        let (map, strategy, robots) = (MAPS[i / 18], STRATEGIES[i / 6 % 3], i % 6 + 1);
        let Row { iterations, metres, nodes, seen_least, overlap, mfl_s, holds } = row;
        let _ = writeln!(
            text,
            "{map:<10} {strategy:<12} {robots:>6} {iterations:>10.2} {metres:>9.2} {nodes:>6.1} {:>8.2} {overlap:>8.3} \
             {mfl_s:>6.1} {holds:>6.2}",
            100.0 * seen_least
        );
    }
    let published = [
        (0, [0, 1], ["5.41..11.71", "4.16..13.65"]),
        (0, [1, 2], ["1.42..6.36", "2.55..5.92"]),
        (0, [0, 2], ["", ""]),
        (1, [0, 1], ["", ""]),
        (1, [1, 2], ["", ""]),
        (1, [0, 2], ["8.94..11.05", "12.23..14.71"]),
    ];
    text += "\nsaved (%), 2 to 5 robots                                          published\n";
    for (map, pair, ranges) in published {
        let of: [(&str, Of); 2] = [("iterations", |row| row.iterations), ("m/robot", |row| row.metres)];
        for ((what, of), range) in of.into_iter().zip(ranges) {
            let who = format!("{} by {} over {}", MAPS[map], STRATEGIES[pair[0]], STRATEGIES[pair[1]]);
            let line = format!("{who:<40} {what:<10} {}  {range}", savings(rows, map, pair, of));
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
    text
}

#[test]
fn all_explorations_end_at_home_with_nothing_touched_and_cooperation_pays() {
    let runs = runs();
    let rows: Vec<Row> = runs.iter().map(|runs| row(runs)).collect();
    for run in runs.iter().flatten() {
        let ExploreSummary { scenario, strategy, robots, seed, .. } = run;
        let which = format!("{scenario} {strategy:?} {robots} robots, seed {seed}");
        assert_eq!((run.stopped, run.hubs_left), (Some(Stopped::Explored), 0), "{which}");
        assert_eq!((run.wall_contacts, run.robot_contacts), (0, 0), "{which}");
        assert!(*strategy != StrategyKind::CSSG || run.coverage >= 0.99, "{which}: {}", run.coverage);
    }
    // What flight levels save over holding (`cssg-random` over `srg`) is in the table, for it is not always a saving.
    for (map, name) in MAPS.iter().enumerate() {
        for other in [1, 2] {
            for of in [|row: &Row| row.iterations, |row: &Row| row.metres] {
                let share = |robots| of(&at(&rows, map, 0, robots)) / of(&at(&rows, map, other, robots));
                let mean = (2..=5).map(share).sum::<f64>() / 4.0;
                assert!(mean < 1.0, "{name}: {mean} of what {} takes", STRATEGIES[other]);
            }
        }
    }
    insta::assert_snapshot!(table(&rows));
}
