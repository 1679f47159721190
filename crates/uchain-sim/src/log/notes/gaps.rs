//! Where rows are missing.

use super::super::Step;

/// Times the period of decisions that rows lie apart in a slow log.
const SLOW: f64 = 1.05;

/// Where rows are missing.
#[derive(Debug, Clone, Default)]
pub(in crate::log) struct Gaps {
    /// Line behind a gap, and how long it is (s).
    found: Vec<(u64, f64)>,
    /// What most rows lie apart (s).
    pub(in crate::log) usual_s: f64,
    /// Decisions that no row stands for.
    pub(in crate::log) decisions: usize,
    period_s: f64,
}

impl Gaps {
    /// A gap is longer than a decision and a half, and than two and a half rows: one row late is none, and neither is a log
    /// that is slower than decisions all along.
    pub(in crate::log) fn of(steps: &[Step], period_s: f64) -> Self {
        let rows = || steps.iter().filter_map(|step| Some((step.line?, step.time_s)));
        let apart = || rows().zip(rows().skip(1)).map(|((_, from_s), (line, to_s))| (line, to_s - from_s));
        let mut lengths_s: Vec<f64> = apart().map(|(_, apart_s)| apart_s).collect();
        lengths_s.sort_by(f64::total_cmp);
        let usual_s = lengths_s.get(lengths_s.len() / 2).copied().unwrap_or(0.0);
        let long_s = (1.5 * period_s).max(2.5 * usual_s);
        let found = apart().filter(|(_, apart_s)| *apart_s > long_s).collect();
        let decisions = steps.iter().filter(|step| step.line.is_none()).count();
        Self { found, usual_s, decisions, period_s }
    }

    pub(in crate::log) fn count(&self) -> usize {
        self.found.len()
    }

    /// The longest (s).
    pub(in crate::log) fn longest_s(&self) -> f64 {
        self.found.iter().map(|(_, gap_s)| *gap_s).fold(0.0, f64::max)
    }

    /// For people, a line each.
    pub(in crate::log) fn notes(&self, label: &str) -> Vec<String> {
        const TOLD: usize = 5;
        let (usual_s, period_s) = (self.usual_s, self.period_s);
        // Rows at the rate of decisions are never quite on the beat, and each decision still finds its own.
        let is_slow = self.decisions > 0 && usual_s > SLOW * period_s;
        let slow = is_slow.then(|| {
            format!("{label}: rows come every {usual_s:.2} s, decisions every {period_s} s: a decision without a row finds nothing new")
        });
        let told = self.found.iter().take(TOLD).map(|(line, gap_s)| {
            format!("{label}:{line}: {gap_s:.2} s after the row before: in between the node decides on time, and hears nothing")
        });
        let more = self.found.len().saturating_sub(TOLD);
        let rest =
            (more > 0).then(|| format!("{label}: {more} more gaps, the longest {:.2} s", self.longest_s()));
        slow.into_iter().chain(told).chain(rest).collect()
    }
}
