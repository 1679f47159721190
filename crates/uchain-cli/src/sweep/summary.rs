//! Summary of a sweep, as JSON for programs and as text for people.

use std::fmt::Write as _;

use serde::Serialize;
use uchain_sim::sweep::{
    Sweep,
    folder::{Folder, TABLE, Totals},
};

/// What `--json` prints.
#[derive(Debug, Serialize)]
pub(super) struct SweepSummary {
    scenario: String,
    seed: u64,
    version: String,
    variants: u64,
    replicates: u64,
    /// Whether all runs are there, and with them the table.
    complete: bool,
    /// Where it is.
    #[serde(skip)]
    folder: String,
    /// Runs that are there.
    runs: u64,
    failed: u64,
    sim_s: f64,
    /// How long the computer worked (s); the only number here that differs from time to time.
    wall_s: f64,
    digest: String,
}

impl SweepSummary {
    pub(super) fn new(folder: &Folder, sweep: &Sweep, totals: Totals, complete: bool, wall_s: f64) -> Self {
        let manifest = folder.manifest();
        Self {
            scenario: manifest.name.clone(),
            seed: manifest.seed,
            version: manifest.version.clone(),
            variants: sweep.variants(),
            replicates: sweep.replicates(),
            complete,
            folder: folder.path().display().to_string(),
            runs: totals.runs,
            failed: totals.failed,
            sim_s: totals.sim_s,
            wall_s,
            digest: totals.digest,
        }
    }

    /// JSON with a newline at its end.
    pub(super) fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self).map(|json| json + "\n")
    }

    /// A few lines.
    pub(super) fn text(&self) -> String {
        let Self { scenario, runs, failed, folder, wall_s, .. } = self;
        let all = self.variants * self.replicates;
        let count = |n: u64, one: &str| if n == 1 { format!("1 {one}") } else { format!("{n} {one}s") };
        let (variants, replicates) = (count(self.variants, "variant"), count(self.replicates, "replicate"));
        let mut text = format!("{scenario}, root seed {}: {}", self.seed, count(all, "run"));
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            " ({variants}, {replicates}), {} s simulated in {wall_s:.2} s",
            rounded(self.sim_s)
        );
        if *failed > 0 {
            let _ = writeln!(text, "  failed   {failed}; why stands in the column failed");
        }
        let _ = writeln!(text, "  digest   {}", self.digest);
        if self.complete {
            let _ = writeln!(text, "  files    {folder}/{TABLE}; next: uchain report {folder}");
        } else {
            let _ = writeln!(
                text,
                "  done     {runs} of {all}; when all parts are: uchain merge {folder} … --out DIR"
            );
        }
        text
    }
}

/// For people: a sum of many numbers shows no digits that nobody simulated.
fn rounded(sim_s: f64) -> f64 {
    (sim_s * 1e3).round() / 1e3
}
