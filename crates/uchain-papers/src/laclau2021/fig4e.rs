//! Laclau 2021, Fig. 4E: how long each treatment takes to converge.

use uchain_sim::{
    analyse::{Estimate, is_less_in_pairs, tends_to_be_less},
    draw::figure::{Axes, Figure, Mark},
};

use super::{
    exploration::{
        DURATION_S, Exploration, FROM_S, Flight, LEVEL_DB, LINKS, PARKED_DB, RunsByTreatment, TREATMENTS,
    },
    fig4d::SETUP,
};
use crate::{
    Item, Outcome, PaperError, Row, RunCache, Table,
    outcome::{cell, difference_with_interval, is_significant, mann_whitney, mean_with_interval, p_value},
};

pub(crate) const FIG4E: Item =
    Item { id: "fig4e", title: "convergence time of T0, T5 and K (Laclau 2021, Fig. 4E)", run: regenerate };

/// K counts as about as fast as T0 when it is slower by no more than this share of T0's mean, with 95 % confidence
/// (non-inferiority margin).
const NON_INFERIORITY_MARGIN: f64 = 0.1;

/// Convergence time; a run that does not converge counts with its whole length (censored data) (s).
fn time_s(run: &Flight) -> f64 {
    run.converged_s().unwrap_or(DURATION_S)
}

fn times(runs: &[Flight]) -> Vec<f64> {
    runs.iter().map(time_s).collect()
}

fn regenerate(cache: &RunCache) -> Result<Outcome, PaperError> {
    let (mut rows, mut axes) = (Vec::new(), Vec::new());
    let mut table = Table::new("fig4e", &["reading", "treatment", "replicate", "converged_s"]);
    let exploration = cache.exploration()?;
    for (how, treated) in exploration.readings() {
        rows.extend(verdicts(how, treated));
        for (treatment, runs) in TREATMENTS.iter().zip(treated) {
            for (replicate, run) in runs.iter().enumerate() {
                let words = [how.to_owned(), (*treatment).to_owned(), replicate.to_string()];
                table.rows.push(words.into_iter().chain([cell(run.converged_s(), 1)]).collect());
            }
        }
        let box_of = |(i, runs): (usize, &Vec<Flight>)| Mark::Distribution {
            colour: i,
            at: (i + 1) as f64,
            values: times(runs),
        };
        axes.push(Axes {
            title: how.to_owned(),
            y: "convergence time (s)".to_owned(),
            words: TREATMENTS.map(str::to_owned).to_vec(),
            height: 190.0,
            marks: treated.iter().enumerate().map(box_of).collect(),
            ..Axes::default()
        });
    }
    let mut outcome = Outcome { setup: SETUP.to_owned(), rows, tables: vec![table], ..Outcome::default() };
    outcome.notes = vec![
        format!(
            "Converged: first time from {FROM_S:.0} s on at which the true losses of the first {LINKS} links lie within \
             {LEVEL_DB:.0} dB, a parked relay's {PARKED_DB:.0} dB base link included (the authors' simulator). A run that \
             never converges counts as {DURATION_S:.0} s."
        ),
        format!(
            "About as fast: with 95 % confidence later by no more than {:.0} % of T0's mean. {}",
            100.0 * NON_INFERIORITY_MARGIN,
            early_relays(exploration.readings())
        ),
        early_levels(exploration.readings()),
    ];
    outcome.rows.push(by_the_shortest_way(exploration));
    let title = "Time to converge, 30 runs each (Laclau 2021, Fig. 4E)".to_owned();
    outcome.draw("fig4e", &Figure { title, axes })?;
    Ok(outcome)
}

/// What the drift of odometers does to K: it levels the loss it hears, which is not that of the tunnel any more.
fn by_the_shortest_way(flown: &Exploration) -> Row {
    let words = |runs: &[Flight]| {
        let spreads: Vec<f64> = runs.iter().filter_map(Flight::end_spread_db).collect();
        let converged = runs.iter().filter(|run| run.converged_s().is_some()).count();
        format!(
            "{converged} of {} converge, spread of the links flown at the end {}",
            runs.len(),
            mean_with_interval(&spreads, 1, " dB")
        )
    };
    Row::fact(
        "K, coded: the way between UAVs by the shortest one instead of odometers",
        format!("{}; by odometers {}", words(&flown.shortest_way), words(flown.coded())),
    )
}

/// Where K is later than T0, and whether the second relay of T0 takes off earlier there.
fn early_relays<'a>(readings: impl Iterator<Item = (&'static str, &'a RunsByTreatment)>) -> String {
    let (mut later, mut launches) = (Vec::new(), Vec::new());
    for (how, treated) in readings {
        let [t0, k] = [0, 2].map(|i: usize| treated.get(i).map_or(&[][..], Vec::as_slice));
        let second = |runs: &[Flight]| -> Vec<f64> {
            runs.iter().map(|run| run.launches_s.get(2).copied().unwrap_or(DURATION_S)).collect()
        };
        launches.push(format!(
            "{} against {} ({how})",
            mean_with_interval(&second(t0), 1, " s"),
            mean_with_interval(&second(k), 1, " s")
        ));
        if is_significant(is_less_in_pairs(&times(t0), &times(k))) {
            let is_early = is_significant(is_less_in_pairs(&second(t0), &second(k)));
            later.push((how, is_early));
        }
    }
    let names = |wanted: bool| {
        let names = later.iter().filter(|(_, is_early)| *is_early == wanted).map(|(how, _)| *how);
        names.collect::<Vec<_>>().join(" and ")
    };
    let mut text = vec![format!("The second relay takes off, T0 against K, after {}.", launches.join("; "))];
    match (names(true), names(false)) {
        (early, other) if early.is_empty() && other.is_empty() => {
            text.push("By no reading is K later than T0, run by run.".to_owned());
        }
        (early, other) => {
            if !early.is_empty() {
                text.push(format!(
                    "Run by run K is later than T0 by this reading: {early}. There noise launches that relay of T0 early, \
                     so that it has been under way for longer when the head stops."
                ));
            }
            if !other.is_empty() {
                text.push(format!(
                    "Run by run K is later than T0, without an earlier relay, by this reading: {other}."
                ));
            }
        }
    }
    text.join(" ")
}

/// Runs that are level for a moment before the head stops, and what is left of K's delay without them.
fn early_levels<'a>(readings: impl Iterator<Item = (&'static str, &'a RunsByTreatment)>) -> String {
    let is_early = |run: &Flight| run.converged_s().is_some_and(|at_s| at_s < run.stop_s);
    let (mut counts, mut rest) = (Vec::new(), Vec::new());
    for (how, treated) in readings {
        let early = treated.iter().map(|runs| runs.iter().filter(|run| is_early(run)).count());
        let early: Vec<String> = early.map(|count| count.to_string()).collect();
        counts.push(format!("{} ({how})", early.join(", ")));
        let [t0, k] = [0, 2].map(|i: usize| treated.get(i).map_or(&[][..], Vec::as_slice));
        let pairs: Vec<(&Flight, &Flight)> = t0.iter().zip(k).collect();
        let left = pairs.iter().filter(|(t0, k)| !is_early(t0) && !is_early(k));
        let left: Vec<f64> = left.map(|(t0, k)| time_s(k) - time_s(t0)).collect();
        if left.len() < pairs.len() {
            rest.push(format!(
                " Without such pairs K is later by {} ({how}).",
                difference_with_interval(&left, 1, " s")
            ));
        }
    }
    format!(
        "The first time counts, also where a chain is level for a moment before the head stops and parts again. Such runs of \
         T0, T5 and K: {}.{}",
        counts.join("; "),
        rest.concat()
    )
}

fn verdicts(how: &str, treated: &RunsByTreatment) -> Vec<Row> {
    let of = |i: usize| treated.get(i).map_or(&[][..], Vec::as_slice);
    let converged = |i: usize| of(i).iter().filter(|run| run.converged_s().is_some()).count();
    let words = |(i, treatment): (usize, &&str)| {
        format!(
            "{treatment} {} of {}, after {}",
            converged(i),
            of(i).len(),
            mean_with_interval(&times(of(i)), 1, " s")
        )
    };
    let all = TREATMENTS.iter().enumerate().map(words).collect::<Vec<_>>();
    let mut rows = vec![Row::claim(
        &format!("runs that converge, {how}"),
        "all converge",
        all.join("; "),
        (0..TREATMENTS.len()).all(|i| converged(i) == of(i).len()),
    )];
    let [t0, t5, k] = [0, 1, 2].map(|i| times(of(i)));
    let p = tends_to_be_less(&t0, &t5);
    rows.push(Row::claim(
        &format!("T5 slower than T0, {how}"),
        "slower",
        format!("{}; in pairs {}", mann_whitney(p), p_value(is_less_in_pairs(&t0, &t5))),
        is_significant(p.map(|of| of.p)),
    ));
    let later: Vec<f64> = k.iter().zip(&t0).map(|(k, t0)| k - t0).collect();
    let margin_s = NON_INFERIORITY_MARGIN * t0.iter().sum::<f64>() / t0.len() as f64;
    let most_s = Estimate::of(&later).map_or(f64::INFINITY, |estimate| estimate.interval().1);
    let slower = mann_whitney(tends_to_be_less(&t0, &k));
    rows.push(Row::claim(
        &format!("K about as fast as T0 or faster, {how}"),
        "about as fast or faster",
        format!("later by {}; slower: {slower}", difference_with_interval(&later, 1, " s")),
        most_s <= margin_s,
    ));
    rows
}

#[cfg(test)]
mod tests {
    use super::{super::trace::Sample, *};
    use crate::Verdict;
    use uchain_sim::mission::chain::LinkFrame;

    /// A run whose three links are level from a time on.
    fn level_from(level_s: f64) -> Flight {
        let link = |uav, true_db| LinkFrame { uav, true_db, filtered_db: None, raw_db: None, silence: None };
        let sample = |time_s: f64| {
            let first_db = if time_s < level_s { 90.0 } else { 55.0 };
            let links = vec![link(0, first_db), link(1, 55.0), link(2, 55.0)];
            Sample { time_s, links, depths_m: Vec::new(), airborne: 3 }
        };
        Flight {
            samples: (0..600).map(|decision| sample(f64::from(decision) * 0.2)).collect(),
            recorded: None,
            stop_s: 52.0,
            launches_s: vec![0.0, 14.0, 48.0],
            relays_used: 2,
            relays_needed: Some(2),
            head_reach_m: 9.7,
            head_flown_m: 10.0,
        }
    }

    /// Converged, T5 slower than T0, and K as fast: by when each becomes level, a few runs later than others.
    fn judged(levels_s: [f64; 3]) -> [Verdict; 3] {
        let runs = |level_s: f64| (0..20).map(|run| level_from(level_s + f64::from(run) * 0.2)).collect();
        let rows = verdicts("test", &Vec::from(levels_s.map(runs)));
        [0, 1, 2].map(|row: usize| rows[row].verdict)
    }

    #[test]
    fn the_published_orders_agree_and_each_of_them_differs_when_it_is_turned() {
        use Verdict::{Agrees, Differs};
        assert_eq!(judged([60.0, 66.0, 60.0]), [Agrees, Agrees, Agrees]);
        assert_eq!(judged([66.0, 60.0, 66.0]), [Agrees, Differs, Agrees], "T0 and T5 changed");
        assert_eq!(judged([60.0, 66.0, 75.0]), [Agrees, Agrees, Differs], "a slow K");
        assert_eq!(judged([60.0, 200.0, 60.0])[0], Differs, "a T5 that never is level");
    }

    #[test]
    fn what_is_said_of_early_relays_and_levels_follows_the_runs() {
        let runs = |level_s: f64, step_s: f64, second_s: fn(f64) -> f64| -> Vec<Flight> {
            let run = |i: u32| {
                let launches_s = vec![0.0, 14.0, second_s(f64::from(i))];
                Flight { launches_s, ..level_from(level_s + f64::from(i) * step_s) }
            };
            (0..20).map(run).collect()
        };
        let early: fn(f64) -> f64 = |i| 42.0 + 0.1 * i;
        let late: fn(f64) -> f64 = |_| 48.0;
        let say = |t0: Vec<Flight>, k: Vec<Flight>| {
            let treated = vec![t0, runs(66.0, 0.4, late), k];
            let readings = || std::iter::once(("test", &treated));
            (early_relays(readings()), early_levels(readings()))
        };
        let (relays, levels) = say(runs(60.0, 0.4, early), runs(65.0, 0.5, late));
        assert!(relays.contains("There noise launches that relay of T0 early"), "{relays}");
        assert!(levels.ends_with("0, 0, 0 (test)."), "{levels}");
        let (relays, _) = say(runs(65.0, 0.5, early), runs(60.0, 0.4, late));
        assert!(relays.ends_with("By no reading is K later than T0, run by run."), "{relays}");
        let (relays, _) = say(runs(60.0, 0.4, late), runs(65.0, 0.5, late));
        assert!(relays.contains("without an earlier relay, by this reading: test"), "{relays}");
        let (_, levels) = say(runs(50.0, 0.4, late), runs(65.0, 0.5, late));
        assert!(levels.contains("5, 0, 0 (test). Without such pairs K is later by 16."), "{levels}");
    }
}
