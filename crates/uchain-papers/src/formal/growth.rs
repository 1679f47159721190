//! Convergence rate (scaling law): decisions until the worst link is within 1 dB of the optimum, over the length of the
//! chain.

use uchain_sim::{
    draw::figure::{Axes, Figure, Mark, Stroke},
    sweep::parallel_map,
};

use super::{equalize_all, worst_db};
use crate::{Outcome, PaperError, Row, Table};

/// Links.
const LENGTHS: [u32; 12] = [3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128];
/// Those of the report.
const SHOWN: [&str; 4] = ["4", "8", "32", "128"];
/// Tunnel per link (m).
const SPACING_M: f64 = 3.0;
/// How near to the optimum (dB).
const NEAR_DB: f64 = 1.0;
/// Most decisions.
const DECISIONS: u64 = 3_000_000;
/// From so many links on the law of growth is fitted.
const FIT_FROM: u32 = 12;

/// A radio and a k.
struct Case {
    name: &'static str,
    short: &'static str,
    stroke: Stroke,
    k_db_per_m: f64,
    step_max_m: f64,
    loss_db: fn(f64, f64) -> f64,
}

/// 6 dB/m.
fn linear_db(a_m: f64, b_m: f64) -> f64 {
    6.0 * (b_m - a_m)
}

/// A straight tunnel, exponent 2 (Laclau 2021, Eq. 22).
fn straight_db(a_m: f64, b_m: f64) -> f64 {
    35.0 + 20.0 * libm::log10(((b_m - a_m) / 0.25).max(1.0))
}

/// 0.3 m/s at 5 Hz.
const STEP_MAX_M: f64 = 0.06;

const CASES: [Case; 3] = [
    Case {
        name: "6 dB/m, k = 6 dB/m",
        short: "6 dB/m",
        stroke: Stroke::Solid,
        k_db_per_m: 6.0,
        step_max_m: f64::INFINITY,
        loss_db: linear_db,
    },
    Case {
        name: "Eq. 22, k = 25 dB/m",
        short: "Eq. 22",
        stroke: Stroke::Solid,
        k_db_per_m: 25.0,
        step_max_m: f64::INFINITY,
        loss_db: straight_db,
    },
    Case {
        name: "Eq. 22, k = 25 dB/m, at most 0.3 m/s",
        short: "with a limit",
        stroke: Stroke::Dashed,
        k_db_per_m: 25.0,
        step_max_m: STEP_MAX_M,
        loss_db: straight_db,
    },
];

/// Decisions of a chain whose relays all start at the base; `None` if [`DECISIONS`] are not enough.
fn decisions(case: &Case, links: u32) -> Option<u64> {
    let head_m = SPACING_M * f64::from(links);
    let mut depths_m = vec![0.0; links as usize];
    depths_m.push(head_m);
    let best_db = (case.loss_db)(0.0, SPACING_M);
    let mut links_db = Vec::new();
    for decision in 0..DECISIONS {
        equalize_all(&mut depths_m, &mut links_db, case.k_db_per_m, case.step_max_m, &case.loss_db);
        // These are the losses before the step.
        if worst_db(&links_db) - best_db <= NEAR_DB {
            return Some(decision);
        }
    }
    None
}

/// Slope of a straight line through points (linear regression, least squares).
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (xy, xx) = points.iter().fold((0.0, 0.0), |(xy, xx), point| {
        (xy + (point.0 - x) * (point.1 - y), xx + (point.0 - x) * (point.0 - x))
    });
    xy / xx
}

pub(super) fn add(outcome: &mut Outcome) -> Result<(), PaperError> {
    let counts = parallel_map((CASES.len() * LENGTHS.len()) as u64, |index| {
        // Long chains first: they take longest.
        let place = CASES.len() * LENGTHS.len() - 1 - index as usize;
        decisions(&CASES[place % CASES.len()], LENGTHS[place / CASES.len()])
    });
    let count = |case: usize, length: usize| {
        let place = length * CASES.len() + case;
        counts.get(counts.len() - 1 - place).copied().flatten()
    };
    let header = ["case", "links", "decisions", "minutes at 5 Hz"];
    let (mut shown, mut table) = (Table::for_report(&header), Table::new("formal-growth", &header));
    let (mut marks, mut ends) = (Vec::new(), Vec::new());
    for (c, case) in CASES.iter().enumerate() {
        let known = LENGTHS.iter().enumerate().filter_map(|(l, links)| Some((*links, count(c, l)?)));
        let known: Vec<(u32, u64)> = known.collect();
        for (links, decisions) in &known {
            let minutes = format!("{:.1}", *decisions as f64 / 5.0 / 60.0);
            table.rows.push(vec![case.name.to_owned(), links.to_string(), decisions.to_string(), minutes]);
        }
        let logarithm = |(links, decisions): &(u32, u64)| {
            (libm::log10(f64::from(*links)), libm::log10((*decisions).max(1) as f64))
        };
        let points: Vec<(f64, f64)> = known.iter().map(logarithm).collect();
        let long: Vec<(f64, f64)> =
            known.iter().filter(|(links, _)| *links >= FIT_FROM).map(logarithm).collect();
        let last = known
            .last()
            .map_or_else(|| "never".to_owned(), |(links, count)| format!("{count} at {links} links"));
        outcome.rows.push(Row::fact(
            &format!("decisions to {NEAR_DB:.0} dB, {}", case.name),
            format!(
                "grow with the {:.2}th power of the number of links from {FIT_FROM} on; {last}",
                slope(&long)
            ),
        ));
        ends.push(known.last().map_or(f64::NAN, |(_, count)| *count as f64));
        marks.push(Mark::Line {
            name: case.short.to_owned(),
            colour: c,
            stroke: case.stroke,
            points: points.clone(),
        });
        if c == 0 {
            marks.push(Mark::Line {
                name: "square law".to_owned(),
                colour: 3,
                stroke: Stroke::Light,
                points: points.last().map_or_else(Vec::new, |(x, y)| {
                    points.iter().map(|point| (point.0, y + 0.4 - 2.0 * (x - point.0))).collect()
                }),
            });
        }
    }
    let axes = Axes {
        x: "number of links, as its logarithm to base 10".to_owned(),
        y: "decisions, likewise".to_owned(),
        height: 260.0,
        marks,
        ..Axes::default()
    };
    let title = "Decisions until the worst link is within 1 dB of the optimum, from all relays at the base"
        .to_owned();
    outcome.draw("formal-growth", &Figure { title, axes: vec![axes] })?;
    let [linear, free, _] = ends[..] else { return Ok(()) };
    let slope_db_per_m = (straight_db(0.0, SPACING_M + 0.01) - straight_db(0.0, SPACING_M - 0.01)) / 0.02;
    let [_, Case { k_db_per_m, .. }, _] = CASES;
    outcome.notes.push(format!(
        "Law of growth: {SPACING_M} m of tunnel per link. Eq. 12 is diffusion along the chain, whose time grows with the \
         square of its length. By Eq. 22 the true slope at {SPACING_M} m is {slope_db_per_m:.1} dB/m, k is {k_db_per_m}: {:.1} \
         times the decisions of the first case, at {} links. The paper counts no decisions; it assumes that the chain levels \
         faster than it is stretched (§4.3).",
        free / linear,
        LENGTHS[LENGTHS.len() - 1]
    ));
    shown.rows.extend(table.rows.iter().filter(|row| SHOWN.contains(&row[1].as_str())).cloned());
    outcome.tables.extend([shown, table]);
    Ok(())
}
