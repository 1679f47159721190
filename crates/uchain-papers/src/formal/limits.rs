//! Where the conditions of the proof do not hold: link quality that is not monotone (local optima), and slopes above the
//! Lipschitz constant k (steps that overshoot and oscillate).

use uchain_core::bounded;
use uchain_sim::{
    mission::chain::Course,
    seed::{Seed, Source},
    sweep::{DesignError, parallel_map},
};

use super::{equalize_all, measure_links, worst_db};
use crate::{Outcome, PaperError, Row, SEED, Table, experiment::inline_scenario};

/// Random starts of each case.
const STARTS: u64 = 100;
/// Decisions: 20 minutes at 5 Hz.
const DECISIONS: u32 = 6000;
/// The last of them, in which a chain that has settled does not move any more.
const LAST: u32 = 300;
const LINKS: usize = 4;
/// 0.3 m/s at 5 Hz (m).
const STEP_MAX_M: f64 = 0.06;
/// Over which slopes are taken (m).
const STEP_M: f64 = 0.05;
/// How near to the optimum (dB).
const NEAR_DB: f64 = 1.0;

/// A tunnel, a radio and a k.
struct Case {
    name: &'static str,
    centre_line: &'static str,
    alpha_wall: f64,
    head_m: f64,
    k_db_per_m: f64,
}

const STRAIGHT: &str = "[[-1.0, 0.0], [16.0, 0.0]]";
const CORNER: &str = "[[-1.0, 0.0], [4.0, 0.0], [4.0, -11.0]]";
/// 12 m there, 12 m back, rock of 1 m between.
const HAIRPIN: &str = "[[-1.0, 0.0], [12.0, 0.0], [12.0, 2.0], [-1.0, 2.0]]";

const CASES: [Case; 8] = [
    Case { name: "straight", centre_line: STRAIGHT, alpha_wall: 6.0, head_m: 12.0, k_db_per_m: 25.0 },
    Case { name: "corner", centre_line: CORNER, alpha_wall: 6.0, head_m: 12.0, k_db_per_m: 6.0 },
    Case { name: "corner", centre_line: CORNER, alpha_wall: 6.0, head_m: 12.0, k_db_per_m: 25.0 },
    Case { name: "corner", centre_line: CORNER, alpha_wall: 6.0, head_m: 12.0, k_db_per_m: 100.0 },
    Case {
        name: "U, rock that radio does not pass well (exponent 6)",
        centre_line: HAIRPIN,
        alpha_wall: 6.0,
        head_m: 24.0,
        k_db_per_m: 25.0,
    },
    Case {
        name: "U, rock that radio passes (exponent 3)",
        centre_line: HAIRPIN,
        alpha_wall: 3.0,
        head_m: 24.0,
        k_db_per_m: 25.0,
    },
    Case {
        name: "U, rock that radio does not see (exponent 2)",
        centre_line: HAIRPIN,
        alpha_wall: 2.0,
        head_m: 24.0,
        k_db_per_m: 25.0,
    },
    Case {
        name: "U, not seen, head half way back",
        centre_line: HAIRPIN,
        alpha_wall: 2.0,
        head_m: 19.0,
        k_db_per_m: 25.0,
    },
];

/// Where one start led.
struct End {
    /// Optimality gap: loss of the worst link, in the mean of the last decisions, above that of the best chain (dB).
    gap_db: f64,
    /// How much the worst link still changes (peak to peak, dB).
    restless_db: f64,
}

pub(super) fn add(outcome: &mut Outcome) -> Result<(), PaperError> {
    let header = [
        "case",
        "k (dB/m)",
        "steepest slope (dB/m)",
        "grows with distance",
        "optimum (dB)",
        "starts that end within 1 dB of it",
        "mean gap (dB)",
        "largest gap (dB)",
        "still moving by (dB)",
    ];
    let (mut shown, mut table) = (Table::for_report(&header), Table::new("formal-limits", &header));
    let mut monotone = (0, 0);
    let mut restless = (0.0, "nowhere".to_owned());
    for case in &CASES {
        let Case { name, centre_line, alpha_wall, head_m, k_db_per_m } = *case;
        let text = format!(
            "name = \"formal\"\nduration_s = 1.0\n[map.corridor]\ncentre_line_m = {centre_line}\nwidth_m = 1.0\n\
             [chain]\nuavs = 1\nbase_m = [0.0, 0.0]\n[radio]\nalpha_wall = {alpha_wall:?}\n\
             [[pilot]]\nstart_s = 0.0\nspeed_mps = 0.0\n"
        );
        let course = Course::read(&inline_scenario("formal", text), &[]).map_err(DesignError::from)?;
        let Some(optimum) = course.optimum() else { continue };
        let loss_db = |a_m: f64, b_m: f64| optimum.loss_db(a_m.max(0.0), b_m);
        let best_db = optimum.optimum(head_m, LINKS).bottleneck_db;
        let ends = parallel_map(STARTS, |start| run_from_random_start(case, start, best_db, &loss_db));
        let near = ends.iter().filter(|end| end.gap_db <= NEAR_DB).count();
        let most = |of: fn(&End) -> f64| ends.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let mean_db = ends.iter().map(|end| end.gap_db).sum::<f64>() / ends.len() as f64;
        let (steepest, grows) = slopes(head_m, &loss_db);
        let moves_db = most(|end| end.restless_db);
        if grows {
            monotone = (monotone.0 + near, monotone.1 + ends.len());
        }
        if moves_db > restless.0 {
            restless = (moves_db, format!("{name}, k = {k_db_per_m} dB/m, slopes up to {steepest:.0} dB/m"));
        }
        table.rows.push(vec![
            name.to_owned(),
            format!("{k_db_per_m}"),
            format!("{steepest:.0}"),
            if grows { "yes" } else { "no" }.to_owned(),
            format!("{best_db:.1}"),
            format!("{near} of {STARTS}"),
            format!("{mean_db:.1}"),
            format!("{:.1}", most(|end| end.gap_db)),
            format!("{moves_db:.1}"),
        ]);
        if !grows {
            outcome.rows.push(Row::fact(
                &format!("quality not monotone: {name}"),
                format!("{near} of {STARTS} random starts end within 1 dB of the optimum, mean gap {mean_db:.1} dB"),
            ));
        }
    }
    let (monotone_near, monotone) = monotone;
    let (restless_db, restless) = restless;
    outcome.notes.push(format!(
        "Limits: {LINKS} links, relays at random places in order, {DECISIONS} decisions of at most {STEP_MAX_M} m. The optimum \
         is the exact solver's, over all places; the steepest slope is taken over {STEP_M} m. Where quality is monotone (the \
         proof's condition) {monotone_near} of {monotone} starts end within {NEAR_DB} dB of it. Where the slope lies far above \
         k a step is too long, and the worst link never comes to rest (last column): by {restless_db:.1} dB at most, {restless}. \
         Where quality is not monotone, Eq. 12 levels what it hears, and cannot know of a better place beyond a worse one."
    ));
    shown.rows.clone_from(&table.rows);
    outcome.tables.extend([shown, table]);
    Ok(())
}

fn run_from_random_start(case: &Case, start: u64, best_db: f64, loss_db: &impl Fn(f64, f64) -> f64) -> End {
    let mut draws = Seed(SEED).replicate(start).stream(0, Source::Start);
    let relays = (1..LINKS).map(|_| f64::from(draws.uniform()) * case.head_m);
    let mut depths_m: Vec<f64> = relays.chain([0.0, case.head_m]).collect();
    depths_m.sort_by(f64::total_cmp);
    let (mut links_db, mut sum_db) = (Vec::new(), 0.0);
    let (mut low_db, mut high_db) = (f64::INFINITY, f64::NEG_INFINITY);
    for decision in 0..DECISIONS {
        equalize_all(&mut depths_m, &mut links_db, case.k_db_per_m, STEP_MAX_M, loss_db);
        // Bodies cannot pass one another.
        for i in 1..depths_m.len() - 1 {
            depths_m[i] = bounded(depths_m[i], depths_m[i - 1], case.head_m);
        }
        if decision >= DECISIONS - LAST {
            measure_links(&depths_m, &mut links_db, loss_db);
            let now_db = worst_db(&links_db);
            (low_db, high_db) = (low_db.min(now_db), high_db.max(now_db));
            sum_db += now_db;
        }
    }
    End { gap_db: sum_db / f64::from(LAST) - best_db, restless_db: high_db - low_db }
}

/// The steepest slope of loss over the depth of one end (dB/m), and whether it grows everywhere with distance.
fn slopes(head_m: f64, loss_db: &(impl Fn(f64, f64) -> f64 + Sync)) -> (f64, bool) {
    /// Rounding of single precision (dB).
    const ROUNDING_DB: f64 = 1e-3;
    let steps = (head_m / STEP_M) as u64;
    let rows = parallel_map(steps, |a| {
        let a_m = a as f64 * STEP_M;
        let (mut steepest, mut grows) = (0.0_f64, true);
        let mut before_db = loss_db(a_m, a_m);
        for b in a + 1..=steps {
            let here_db = loss_db(a_m, b as f64 * STEP_M);
            steepest = steepest.max((here_db - before_db).abs() / STEP_M);
            grows &= here_db >= before_db - ROUNDING_DB;
            before_db = here_db;
        }
        (steepest, grows)
    });
    rows.into_iter().fold((0.0, true), |(s, g), (steepest, grows)| (f64::max(s, steepest), g && grows))
}
