//! Optimality gap of Eq. 12 for random profiles of loss that keep the theorem's conditions (a Monte Carlo test).

use uchain_sim::{
    analyse::optimum::equal_links,
    seed::{Seed, Source, Stream},
    sweep::parallel_map,
};

use super::{equalize_all, measure_links, worst_db};
use crate::{Outcome, Row, SEED};

/// Random profiles.
const PROFILES: u64 = 100_000;
/// Most links.
const LINKS_MAX: u32 = 7;
/// How near to the optimum counts as there (dB).
const THERE_DB: f64 = 0.05;
/// Most decisions.
const DECISIONS: u32 = 20_000;
/// Profiles of the control, which takes steps so many times too long, and its decisions.
const CONTROLS: u64 = 10_000;
const TOO_LONG: [f64; 2] = [1.5, 3.0];
const CONTROL_DECISIONS: u32 = 100;
/// Rounding (dB, m).
const ROUNDING: f64 = 1e-9;
/// Length of a piece of tunnel with one slope (m).
const PIECE_M: f64 = 0.5;

/// A loss that grows with distance, 0 at no distance: the sum of a loss that adds up along the tunnel, piece by piece,
/// and of one that flattens. Some are nearly all the one, some nearly all the other.
struct Profile {
    /// Sums of two local slopes up to the start of every piece (dB).
    sums_db: [Vec<f64>; 2],
    /// Loss from which the second one flattens (dB).
    flat_db: f64,
}

impl Profile {
    fn draw(draws: &mut Stream, length_m: f64, k_db_per_m: f64) -> Self {
        let pieces = (length_m / PIECE_M) as usize + 2;
        let share = 0.1 + 0.9 * f64::from(draws.uniform());
        let mut sums = |share: f64| {
            let mut sum_db = 0.0;
            let mut next = || {
                let here_db = sum_db;
                sum_db += PIECE_M * share * k_db_per_m * (0.1 + 0.9 * f64::from(draws.uniform()));
                here_db
            };
            (0..=pieces).map(|_| next()).collect()
        };
        let sums_db = [sums(share), sums(1.0 - share)];
        Self { sums_db, flat_db: 1.0 + 30.0 * f64::from(draws.uniform()) }
    }

    /// The least k with which it is k-Lipschitz: its steepest piece, at no distance (dB/m).
    fn steepest_db_per_m(&self) -> f64 {
        let [adds, flattens] = &self.sums_db;
        let slopes = adds.windows(2).zip(flattens.windows(2));
        let slope = |(a, b): (&[f64], &[f64])| (a[1] - a[0] + b[1] - b[0]) / PIECE_M;
        slopes.map(slope).fold(0.0, f64::max)
    }

    fn sum_db(&self, which: usize, depth_m: f64) -> f64 {
        let piece = (depth_m / PIECE_M).max(0.0);
        let sums = &self.sums_db[which];
        let index = (piece as usize).min(sums.len() - 2);
        sums[index] + (piece - index as f64) * (sums[index + 1] - sums[index])
    }

    fn loss_db(&self, a_m: f64, b_m: f64) -> f64 {
        let [adds, flattens] = [0, 1].map(|which| self.sum_db(which, b_m) - self.sum_db(which, a_m));
        // Relays never cross; were they to, the loss between them would count as negative and show.
        adds + self.flat_db * libm::log1p((flattens / self.flat_db).max(-0.5))
    }
}

/// What became of one profile.
struct Trial {
    decisions: u32,
    /// The worst link got worse, by so much at most (dB).
    worse_db: f64,
    crossed: bool,
    /// Optimality gap at the end (dB).
    gap_db: f64,
}

/// Up to so many decisions of steps so many times as long as those of Eq. 12.
fn trial(index: u64, times: f64, decisions: u32) -> Trial {
    let mut draws = Seed(SEED).replicate(index).stream(0, Source::Start);
    let mut uniform = |low: f64, high: f64| low + (high - low) * f64::from(draws.uniform());
    let links = uniform(2.0, f64::from(LINKS_MAX) + 1.0) as usize;
    let (head_m, k_db_per_m) = (uniform(1.0, 15.0), uniform(1.0, 30.0));
    let mut depths_m: Vec<f64> = (1..links).map(|_| uniform(0.0, head_m)).chain([0.0, head_m]).collect();
    depths_m.sort_by(f64::total_cmp);
    let profile = Profile::draw(&mut draws, head_m, k_db_per_m);
    let k_db_per_m = profile.steepest_db_per_m();
    let loss_db = |a_m: f64, b_m: f64| profile.loss_db(a_m, b_m);
    let best_db = equal_links(&loss_db, head_m, links).map_or(f64::NAN, |best| best.bottleneck_db);
    let mut links_db = Vec::new();
    measure_links(&depths_m, &mut links_db, &loss_db);
    let mut now_db = worst_db(&links_db);
    let mut trial = Trial { decisions: 0, worse_db: 0.0, crossed: false, gap_db: f64::NAN };
    while trial.decisions < decisions && now_db - best_db > THERE_DB {
        equalize_all(&mut depths_m, &mut links_db, k_db_per_m / times, f64::INFINITY, &loss_db);
        measure_links(&depths_m, &mut links_db, &loss_db);
        let next_db = worst_db(&links_db);
        trial.worse_db = trial.worse_db.max(next_db - now_db);
        trial.crossed |= depths_m.windows(2).any(|pair| pair[0] > pair[1] + ROUNDING);
        trial.decisions += 1;
        now_db = next_db;
    }
    trial.gap_db = now_db - best_db;
    trial
}

pub(super) fn add(outcome: &mut Outcome) {
    let trials = parallel_map(PROFILES, |index| trial(index, 1.0, DECISIONS));
    let count = |of: &dyn Fn(&Trial) -> bool| trials.iter().filter(|trial| of(trial)).count();
    let worse = count(&|trial| trial.worse_db > ROUNDING);
    let crossed = count(&|trial| trial.crossed);
    // The other way round, so that no number counts as a miss.
    let missed = trials.len() - count(&|trial| trial.gap_db.abs() <= THERE_DB);
    let most = trials.iter().map(|trial| trial.decisions).max().unwrap_or(0);
    let claim = |what: &str, cases: usize| {
        Row::claim(what, "never", format!("{cases} of {PROFILES} random profiles"), cases == 0)
    };
    outcome.rows.push(claim("a decision of Eq. 12 makes the worst link worse", worse));
    outcome.rows.push(claim("neighbours change places", crossed));
    outcome.rows.push(Row::claim(
        "Eq. 12 does not end at the optimum",
        "never",
        format!("{missed} of {PROFILES} (within {THERE_DB} dB after at most {most} decisions)"),
        missed == 0,
    ));
    for times in TOO_LONG {
        let controls = parallel_map(CONTROLS, |index| trial(index, times, CONTROL_DECISIONS));
        let worse = controls.iter().filter(|control| control.worse_db > ROUNDING).count();
        outcome.rows.push(Row::fact(
            &format!("control: steps {times} times as long make the worst link worse"),
            format!("{worse} of {CONTROLS}"),
        ));
    }
    outcome.notes.push(format!(
        "Random profiles: 2 to {LINKS_MAX} links, 1 to 15 m, slopes of 0.1 to 30 dB/m; loss grows everywhere, 0 at no \
         distance; a part of it, from a tenth to all, adds up along the tunnel piece by piece, the rest flattens. k is the \
         steepest slope of the profile itself. The optimum is that of the exact solver's bisection."
    ));
}
