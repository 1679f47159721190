//! The report of a sweep in Markdown.

use std::fmt::Write as _;

use super::{CELLS_MAX, Failures, Metric};
use crate::{
    analyse::Estimate,
    sweep::{
        Sweep,
        folder::{Manifest, Totals},
    },
};

/// Every cell of every number, for programs.
pub const CSV: &str = "report.csv";
/// Folder of the pictures.
pub const PLOTS: &str = "plots";

/// Most rows of a table.
const ROWS_MAX: usize = 200;

/// The report: what was flown, what failed and why, and a table for every number.
// Writing to a String cannot fail: what it returns is left aside all through.
pub fn markdown(
    manifest: &Manifest,
    sweep: &Sweep,
    totals: &Totals,
    metrics: &[Metric],
    failures: &Failures,
) -> String {
    let mut text = format!("# Sweep of {}\n\n", manifest.name);
    let (variants, replicates) = (sweep.variants(), sweep.replicates());
    let _ = writeln!(text, "- {} runs: {variants} variants × {replicates} replicates", totals.runs);
    let _ = writeln!(text, "- failed: {}", totals.failed);
    let _ = writeln!(text, "- root seed {}, uchain {}", manifest.seed, manifest.version);
    for set in &manifest.set {
        let _ = writeln!(text, "- set for all: `{set}`");
    }
    for vary in &manifest.design.vary {
        let _ = writeln!(text, "- varied: `{vary}`");
    }
    if manifest.design.table.is_some() {
        let keys: Vec<String> = sweep.design().keys().map(|key| format!("`{key}`")).collect();
        let _ = writeln!(text, "- varied by a table: {}", keys.join(", "));
    }
    let _ = writeln!(text, "- {:.1} s simulated, digest `{}`", totals.sim_s, totals.digest);
    text.push_str("\nIntervals hold the mean of a cell with 95 % confidence (Student's t); those of counts are cut at 0.\n");
    let constants: Vec<String> = metrics
        .iter()
        .filter_map(|metric| Some(format!("{} = {}", metric.name, number(metric.constant?))))
        .collect();
    if !constants.is_empty() {
        let _ = writeln!(text, "\nThe same in all runs: {}.", constants.join(", "));
    }
    let is_absent = |metric: &&Metric| metric.cells.iter().all(Option::is_none);
    let absent: Vec<&str> = metrics.iter().filter(is_absent).map(|metric| metric.name.as_str()).collect();
    if !absent.is_empty() && sweep.variants() <= CELLS_MAX as u64 {
        let _ = writeln!(text, "\nIn no run: {}.", absent.join(", "));
    }
    if totals.failed > 0 {
        failed(&mut text, failures, replicates);
    }
    for metric in metrics.iter().filter(|metric| metric.constant.is_none()) {
        if metric.cells.iter().any(Option::is_some) {
            table(&mut text, sweep, metric, failures);
        }
    }
    text
}

fn failed(text: &mut String, failures: &Failures, replicates: u64) {
    text.push_str("\n## Failed\n\n| runs | first | outcome | the first |\n|---:|---:|---|---|\n");
    for reason in &failures.reasons {
        let (outcome, verdict) = (cell(&reason.words), cell(reason.verdict.as_deref().unwrap_or_default()));
        let _ = writeln!(text, "| {} | {} | {outcome} | {verdict} |", reason.runs, reason.first);
    }
    if failures.others > 0 {
        let _ = writeln!(text, "| {} | | other outcomes | |", failures.others);
    }
    let _ = writeln!(text, "\nRun i is replicate i % {replicates} of variant i / {replicates}.");
}

fn table(text: &mut String, sweep: &Sweep, metric: &Metric, failures: &Failures) {
    let keys: Vec<&str> = sweep.design().keys().collect();
    let _ = write!(text, "\n## {}\n\n|", metric.name);
    for key in &keys {
        let _ = write!(text, " {key} |");
    }
    text.push_str(" runs | failed | mean | 95 % interval | median |\n|");
    text.push_str(&"---:|".repeat(keys.len() + 5));
    text.push('\n');
    for (variant, estimate) in metric.cells.iter().enumerate().take(ROWS_MAX) {
        text.push('|');
        for value in sweep.design().values(variant as u64) {
            let _ = write!(text, " {} |", cell(value.as_deref().unwrap_or("")));
        }
        let failed = failures.cells.get(variant).copied().unwrap_or_default();
        match estimate {
            Some(estimate) => {
                let Estimate { count, mean, median, .. } = estimate;
                let (mean, median) = (number(*mean), number(*median));
                let _ = writeln!(text, " {count} | {failed} | {mean} | {} | {median} |", interval(estimate));
            }
            None => {
                let _ = writeln!(text, " 0 | {failed} | | | |");
            }
        }
    }
    let variants = sweep.variants();
    if variants > ROWS_MAX as u64 {
        let _ = writeln!(text, "\nThe first {ROWS_MAX} of {variants} variants; all are in {CSV}.");
    }
    let drawn =
        if variants > CELLS_MAX as u64 { format!(", first {CELLS_MAX} variants") } else { String::new() };
    let _ = writeln!(text, "\n![{0}{drawn}]({PLOTS}/{0}.svg)", metric.name);
}

fn interval(estimate: &Estimate) -> String {
    match estimate.half_width {
        Some(_) => {
            let (low, high) = estimate.interval();
            format!("{} … {}", number(low), number(high))
        }
        None => "one value".to_owned(),
    }
}

/// Five digits that mean something.
fn number(value: f64) -> String {
    let size = value.abs();
    let decimals = if size >= 1000.0 {
        1
    } else if size >= 10.0 {
        2
    } else if size >= 0.1 || size == 0.0 {
        4
    } else {
        6
    };
    let text = format!("{value:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Words that may stand in a table.
fn cell(words: &str) -> String {
    words.replace('|', "\\|").replace(['\n', '\r'], " ")
}
