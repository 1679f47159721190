//! What cooperation buys: what strategies of Kim 2021, §7.2, save over one another, paired by seed, under each reading of
//! what the paper leaves open or says in two ways.

mod page;

use super::{
    comparison::{Claim, Comparison, DISTANCE, HOLDS, ITERATIONS, ROBOTS, STRATEGIES},
    fig10, fig11,
};
use crate::{Item, Outcome, Page, PaperError, RunCache, Table};

pub(crate) const COOPERATION: Item = Item {
    id: "cooperation",
    title: "what cooperation buys, by each reading (Kim 2021, Eq. 7, sections 4.1 and 6.2)",
    run: regenerate,
};

/// Five times as many as published: most differences between readings are smaller than what 20 runs tell apart.
const REPLICATES: u64 = 100;
const MAPS: [&str; 2] = ["apartment", "corridors"];
/// What is compared: by places in [`STRATEGIES`], the first saves over the second.
const PAIRS: [[usize; 2]; 3] = [[0, 1], [1, 2], [0, 2]];

/// A way to read the paper.
struct Reading {
    name: &'static str,
    sets: &'static [&'static str],
}

/// As printed first.
const READINGS: [Reading; 5] = [
    Reading { name: "as printed", sets: &[] },
    Reading { name: "left", sets: &["explore.taken=\"left\""] },
    Reading { name: "ends", sets: &["explore.arc_ends=true"] },
    Reading { name: "all ends", sets: &["explore.arc_ends=true", "explore.arc_gap_share=0"] },
    Reading { name: "left, ends", sets: &["explore.taken=\"left\"", "explore.arc_ends=true"] },
];

/// All runs.
struct Study {
    /// By reading, then by map.
    flown: Vec<[Comparison; 2]>,
}

impl Study {
    fn fly(replicates: u64) -> Result<Self, PaperError> {
        let fly = |reading: &Reading| {
            let [apartment, corridors] = MAPS.map(|map| Comparison::fly(map, reading.sets, replicates));
            Ok([apartment?, corridors?])
        };
        Ok(Self { flown: READINGS.iter().map(fly).collect::<Result<_, PaperError>>()? })
    }

    /// The comparisons on one map, with the names of their readings.
    fn on(&self, map: usize) -> impl Iterator<Item = (&'static str, &Comparison)> {
        READINGS.iter().zip(&self.flown).map(move |(reading, maps)| (reading.name, &maps[map % MAPS.len()]))
    }

    /// What was published, with the place of its map.
    fn published() -> impl Iterator<Item = (usize, &'static Claim, [f64; 2])> {
        let claims = fig10::CLAIMS.iter().map(|claim| (0, claim));
        let claims = claims.chain(fig11::CLAIMS.iter().map(|claim| (1, claim)));
        claims.filter_map(|(map, claim)| Some((map, claim, claim.range?)))
    }

    /// Every saving, and every run, for programs.
    fn tables(&self) -> [Table; 2] {
        let mut savings = Table::new(
            "cooperation",
            &["reading", "map", "strategy", "over", "metric", "robots", "saved_percent", "low", "high"],
        );
        let mut runs = Table::new(
            "cooperation-runs",
            &["reading", "map", "strategy", "robots", "replicate", "iterations", "distance_mean_m", "holds"],
        );
        for (m, map) in MAPS.iter().enumerate() {
            for (reading, flown) in self.on(m) {
                for [a, b] in PAIRS {
                    for metric in [ITERATIONS, DISTANCE] {
                        for (saved, robots) in flown.saved([a, b], metric).into_iter().zip(ROBOTS) {
                            let words = [reading, map, STRATEGIES[a], STRATEGIES[b], metric.name];
                            let words = words.map(str::to_owned).into_iter().chain([robots.to_string()]);
                            let numbers = saved.map(|percent| format!("{percent:.3}"));
                            savings.rows.push(words.chain(numbers).collect());
                        }
                    }
                }
                for (s, strategy) in STRATEGIES.iter().enumerate() {
                    for (n, robots) in ROBOTS.iter().enumerate() {
                        let [rounds, metres, holds] =
                            [ITERATIONS, DISTANCE, HOLDS].map(|metric| flown.sample(s, n, metric));
                        for (replicate, ((rounds, metres), holds)) in
                            rounds.iter().zip(&metres).zip(&holds).enumerate()
                        {
                            let words = [reading.to_owned(), (*map).to_owned(), (*strategy).to_owned()];
                            let numbers = [
                                robots.to_string(),
                                replicate.to_string(),
                                format!("{rounds:.0}"),
                                format!("{metres:.3}"),
                                format!("{holds:.0}"),
                            ];
                            runs.rows.push(words.into_iter().chain(numbers).collect());
                        }
                    }
                }
            }
        }
        [savings, runs]
    }
}

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let study = Study::fly(REPLICATES)?;
    let page = Page { name: "cooperation.md".to_owned(), text: page::text(&study, REPLICATES) };
    Ok(Outcome {
        setup: format!(
            "{} Five readings, two maps, three strategies, 2 to 5 robots, {REPLICATES} runs of each, paired by seed; the first \
             20 of the first reading are those of fig10 and fig11. Nothing is judged here: the page says which published range is met \
             by which reading.",
            page.gist()
        ),
        tables: study.tables().into(),
        pages: vec![page],
        ..Outcome::default()
    })
}
