//! The page of the study: `docs/cooperation.md`. Every number of it is of these runs.

#[cfg(test)]
mod tests;

use super::{DISTANCE, HOLDS, ITERATIONS, MAPS, PAIRS, ROBOTS, STRATEGIES, Study};
use crate::{Table, outcome::mean_with_interval};

const READINGS: &str = "\
| reading | what a robot heeds of what others have announced (`explore.taken`) | when an arc is a frontier (`explore.arc_ends`) |
|---|---|---|
| as printed | nothing: Eq. 7 takes the others where they are (`\"ignored\"`, the default) | its mid-point is uncovered (`false`, the default) |
| left | Eq. 7 takes the others where they will be, and no robot of any strategy flies to a place that another has announced, while there is anything else to do (`\"left\"`, our rule) | its mid-point is uncovered |
| ends | nothing | its mid-point is uncovered, or an end of it beside which the next sector is shorter by half of `r_s_m` or more (`true`, and `arc_gap_share = 0.5`, our value) |
| all ends | nothing | its mid-point or an end of it is uncovered, whatever the gap (`true`, and `arc_gap_share = 0`) |
| left, ends | as *left* | as *ends* |
";

const WHY: &str = "\
§6.2 says that Eq. 7 gives robots that have come to one node different targets. It does not: their places are the same, so
are their frontiers, and so is what Eq. 7 makes of them; they choose alike and go on together, on two levels. *left* is
the least rule that makes the sentence true, and it is given to the random strategies as well, so that it favours none.
§4.1 speaks of a left and a right point of an arc beside its mid-point *when there is a wide gap between adjacent
sectors*, and does not say what is wide.";

const HOLDING: &str = "\
Kim 2021 says of SRG that a robot has to hold before it moves to a node that another one shares, and waits for others to
pass (§6.2, §7.2); not which one, for how long, nor how often that came about. The method's own paper (Franchi, Freda, Oriolo
and Vendittelli, The Sensor-Based Random Graph Method for Cooperative Robot Exploration, IEEE/ASME Transactions on
Mechatronics 14(2), 2009) names decentralized mechanisms of cooperation and coordination that avoid conflicts, in its
abstract; its text was not at hand, and no other source was found that says who waits and for how long. So the rule here is ours: of two
moving robots in conflict the higher number waits one round, and parked or waiting ones are passed on another level,
without which the strategy deadlocks. If published robots waited longer than ours, levels saved more than they can here.";

/// All of it.
pub(super) fn text(study: &Study, replicates: u64) -> String {
    let gist = gist(study);
    let [means, published, slopes, ways, holds] =
        [means(study), published(study), slopes(study), ways(study), holds(study)]
            .map(|table| table.markdown());
    let teams =
        MAPS.iter().enumerate().map(|(m, map)| format!("On `{map}`:\n\n{}\n", by_team(study, m).markdown()));
    let teams: String = teams.collect();
    format!(
        "\
# What cooperation buys

{gist}

This page is what `uchain paper cooperation` writes: {replicates} runs of each strategy with 2 to 5 robots on each map, under each
of five readings of Kim 2021. Runs of one number start from the same places and draw the same random numbers, whatever the
strategy and the reading. A saving is one minus the ratio of the means; parentheses hold its 95 % interval, by bootstrap over the
runs' numbers. `cssg` over `cssg-random` is what choosing targets buys (STN, Eq. 7), `cssg-random` over `srg` what flight levels
buy, `cssg` over `srg` both.

{READINGS}
{WHY}

## Saved in the mean over 2 to 5 robots (%)

{means}
## Which published range is met by which reading

*Met*: our mean over 2 to 5 robots lies within the published range. *Near*: it does not, but its interval reaches it. Published
are the least and the most of the means of 20 runs with 2 to 5 robots.

{published}
## Does what levels save grow with the number of robots?

§7.2 says that it does. The slope of what `cssg-random` saves over `srg`, in points per robot; it grows if the interval lies above 0.

{slopes}
## By the number of robots (%)

{teams}## What it takes

Savings are relative. This is what `cssg` takes, rounds and way per robot (m), with their 95 % intervals.

{ways}
## How often robots of SRG hold

Rounds held by all robots together, in the mean of a run, and their share of all rounds of a robot.

{holds}
{HOLDING}
"
    )
}

fn percent([saved, low, high]: [f64; 3]) -> String {
    format!("{saved:.1} ({low:.1} … {high:.1})").replace("-0.0", "0.0")
}

/// What it comes to, in two sentences.
fn gist(study: &Study) -> String {
    let saved = |map, reading: usize, pair, metric| {
        study.on(map).nth(reading).map_or([f64::NAN; 3], |(_, flown)| flown.saved_mean(pair, metric))
    };
    let levels = [ITERATIONS, DISTANCE].map(|metric| [0, 1].map(|map| saved(map, 0, PAIRS[1], metric)));
    let held = (0..MAPS.len()).filter_map(|map| study.on(map).next().map(|(_, flown)| flown.held_percent()));
    sentences(
        [0, 1].map(|reading| [0, 1].map(|map| saved(map, reading, PAIRS[0], ITERATIONS))),
        levels,
        held.flatten().fold([f64::INFINITY, 0.0], |[low, high], held| [low.min(held), high.max(held)]),
    )
}

/// Of what choosing targets saves (as printed and *left*, by map), what levels save (rounds and way, by map), and the least
/// and largest share of rounds held.
fn sentences(targets: [[[f64; 3]; 2]; 2], levels: [[[f64; 3]; 2]; 2], held: [f64; 2]) -> String {
    let of =
        |[saved, low, high]: [f64; 3]| format!("{saved:.1} % ({low:.1} … {high:.1})").replace("-0.0", "0.0");
    let [printed, left] = targets.map(|maps| maps.map(of));
    let [rounds, way] = levels.map(|maps| maps.map(of));
    let count = |shows: fn(&[f64; 3]) -> bool| levels.iter().flatten().filter(|saved| shows(saved)).count();
    let (saves, costs) = (count(|[_, low, _]| *low > 0.0), count(|[_, _, high]| *high < 0.0));
    format!(
        "Flying away from the others by Eq. 7 as printed (`cssg` over `cssg-random`) saves a team of 2 to 5 robots {} of its rounds \
         in the apartment and {} in the corridors; if all robots also leave to one another the places they have announced, which \
         is our rule, it saves {} and {}. Passing one another on flight levels instead of waiting (`cssg-random` over `srg`) saves \
         {} and {} of the rounds and {} and {} of the way, less than 0 being a loss: of these four intervals {} {} above 0 and {} \
         below, and robots that may wait do so in {:.1} to {:.1} % of their rounds only.",
        printed[0],
        printed[1],
        left[0],
        left[1],
        rounds[0],
        rounds[1],
        way[0],
        way[1],
        in_words(saves),
        if saves == 1 { "lies" } else { "lie" },
        in_words(costs),
        held[0],
        held[1],
    )
}

/// A number of a few, in a sentence.
fn in_words(count: usize) -> String {
    const WORDS: [&str; 5] = ["none", "one", "two", "three", "four"];
    WORDS.get(count).map_or_else(|| count.to_string(), |word| (*word).to_owned())
}

/// A table with the readings as columns.
fn by_reading(first: &[&str]) -> Table {
    let names: Vec<&str> = super::READINGS.iter().map(|reading| reading.name).collect();
    Table::for_report(&[first, &names].concat())
}

fn pair_words([a, b]: [usize; 2]) -> String {
    format!("`{}` over `{}`", STRATEGIES[a], STRATEGIES[b])
}

fn means(study: &Study) -> Table {
    let mut table = by_reading(&["map", "saves", "of"]);
    for (m, map) in MAPS.iter().enumerate() {
        for pair in PAIRS {
            for metric in [ITERATIONS, DISTANCE] {
                let words = [(*map).to_owned(), pair_words(pair), metric.name.to_owned()];
                let cells = study.on(m).map(|(_, flown)| percent(flown.saved_mean(pair, metric)));
                table.rows.push(words.into_iter().chain(cells).collect());
            }
        }
    }
    table
}

/// Whether a saving is the published one, in a word.
fn met([saved, low, high]: [f64; 3], [least, most]: [f64; 2]) -> &'static str {
    match saved {
        saved if (least..=most).contains(&saved) => "met",
        _ if low <= most && high >= least => "near",
        _ => "no",
    }
}

fn published(study: &Study) -> Table {
    let mut table = by_reading(&["map", "saves", "of", "published (%)"]);
    for (m, claim, range) in Study::published() {
        let words = [MAPS[m].to_owned(), pair_words(claim.pair), claim.metric.name.to_owned()];
        let cells = study.on(m).map(|(_, flown)| {
            let saved = flown.saved_mean(claim.pair, claim.metric);
            format!("{}: {:.1}", met(saved, range), saved[0])
        });
        let range = format!("{} … {}", range[0], range[1]);
        table.rows.push(words.into_iter().chain([range]).chain(cells).collect());
    }
    table
}

fn slopes(study: &Study) -> Table {
    let mut table = by_reading(&["map", "of"]);
    for (m, map) in MAPS.iter().enumerate() {
        for metric in [ITERATIONS, DISTANCE] {
            let cells = study.on(m).map(|(_, flown)| {
                let [slope, low, high] = flown.slope(PAIRS[1], metric);
                let word = match () {
                    () if low > 0.0 => "grows",
                    () if high < 0.0 => "falls",
                    () => "does not show",
                };
                format!("{word}: {slope:+.1} ({low:+.1} … {high:+.1})")
            });
            table.rows.push([*map, metric.name].map(str::to_owned).into_iter().chain(cells).collect());
        }
    }
    table
}

/// On one map.
fn by_team(study: &Study, map: usize) -> Table {
    let robots: Vec<String> = ROBOTS.iter().map(|robots| format!("{robots} robots")).collect();
    let header: Vec<&str> =
        ["reading", "saves", "of"].into_iter().chain(robots.iter().map(String::as_str)).collect();
    let mut table = Table::for_report(&header);
    for (reading, flown) in study.on(map) {
        for pair in PAIRS {
            for metric in [ITERATIONS, DISTANCE] {
                let words = [reading.to_owned(), pair_words(pair), metric.name.to_owned()];
                let cells = flown.saved(pair, metric).into_iter().map(percent);
                table.rows.push(words.into_iter().chain(cells).collect());
            }
        }
    }
    table
}

fn ways(study: &Study) -> Table {
    let mut table = by_reading(&["map", "robots", "of"]);
    for (m, map) in MAPS.iter().enumerate() {
        for (n, robots) in ROBOTS.iter().enumerate() {
            for metric in [ITERATIONS, DISTANCE] {
                let words = [(*map).to_owned(), robots.to_string(), metric.name.to_owned()];
                let cells =
                    study.on(m).map(|(_, flown)| mean_with_interval(&flown.sample(0, n, metric), 1, ""));
                table.rows.push(words.into_iter().chain(cells).collect());
            }
        }
    }
    table
}

fn holds(study: &Study) -> Table {
    let mut table = by_reading(&["map", "robots"]);
    for (m, map) in MAPS.iter().enumerate() {
        for (n, robots) in ROBOTS.iter().enumerate() {
            let cells = study.on(m).map(|(_, flown)| {
                let rounds = mean_with_interval(&flown.sample(2, n, HOLDS), 1, "");
                format!("{rounds}: {:.1} %", flown.held_percent()[n])
            });
            table.rows.push([(*map).to_owned(), robots.to_string()].into_iter().chain(cells).collect());
        }
    }
    table
}
