//! Time in a log: when decisions are due, and where rows are missing.

use super::Step;

/// Share of a period by which a decision may come early: rows of a real log are never on the beat.
const EARLY: f64 = 0.1;

/// Counts the decisions that are due, from the first row on.
#[derive(Debug)]
pub(super) struct Clock {
    start_s: f64,
    period_s: f64,
    decided: u64,
}

impl Clock {
    /// One that has its first decision at the first row. The period is meant as it is written: 0.2 s and not the nearest
    /// number with 24 bits.
    pub(super) fn new(start_s: f64, decision_s: f32) -> Self {
        let period_s = decision_s.to_string().parse().unwrap_or(f64::from(decision_s));
        Self { start_s, period_s, decided: 0 }
    }

    /// When the next decision is due (s).
    pub(super) fn next_s(&self) -> f64 {
        self.start_s + self.decided as f64 * self.period_s
    }

    /// Whether a decision is due at this time.
    pub(super) fn is_due(&self, time_s: f64) -> bool {
        let since_s = time_s - self.start_s;
        since_s >= (self.decided as f64 - EARLY) * self.period_s
    }

    /// One decision is made.
    pub(super) fn decide(&mut self) {
        self.decided += 1;
    }

    /// Time between two decisions (s).
    pub(super) fn period_s(&self) -> f64 {
        self.period_s
    }
}

/// Where rows are missing.
#[derive(Debug, Clone, Default)]
pub(super) struct Gaps {
    /// Line behind a gap, and how long it is (s).
    found: Vec<(u64, f64)>,
    /// What most rows lie apart (s).
    pub(super) usual_s: f64,
    /// Decisions that no row stands for.
    pub(super) decisions: usize,
    period_s: f64,
}

impl Gaps {
    /// A gap is longer than a decision and a half, and than two and a half rows: one row late is none, and neither is a log
    /// that is slower than decisions all along.
    pub(super) fn of(steps: &[Step], period_s: f64) -> Self {
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

    pub(super) fn count(&self) -> usize {
        self.found.len()
    }

    /// The longest (s).
    pub(super) fn longest_s(&self) -> f64 {
        self.found.iter().map(|(_, gap_s)| *gap_s).fold(0.0, f64::max)
    }

    /// For people, a line each.
    pub(super) fn notes(&self, label: &str) -> Vec<String> {
        const TOLD: usize = 5;
        let (usual_s, period_s) = (self.usual_s, self.period_s);
        let slow = (usual_s > period_s).then(|| {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows, of a rate and from a moment on, at which decisions are made.
    fn decided(start_s: f64, rows: impl Iterator<Item = f64>) -> Vec<usize> {
        let mut clock = Clock::new(start_s, 0.2);
        let mut at = Vec::new();
        for (row, time_s) in rows.enumerate() {
            while clock.is_due(time_s) {
                clock.decide();
                at.push(row);
            }
        }
        at
    }

    #[test]
    fn at_20_hz_every_fourth_row_decides_for_hours_from_whatever_moment_on() {
        for start_s in [0.0, 12.35, 1.7e9] {
            let at = decided(start_s, (0..100_000).map(|row| start_s + f64::from(row) * 0.05));
            assert!(at.iter().enumerate().all(|(i, row)| *row == 4 * i), "{:?}", &at[..8]);
            assert_eq!(at.len(), 25_000);
        }
    }

    #[test]
    fn rows_off_the_beat_leave_as_many_decisions_as_there_were() {
        // Up to 15 ms early or late.
        let jitter = |row: u32| f64::from((row * 7919) % 31) * 0.001 - 0.015;
        let at = decided(
            0.0,
            (0..1000).map(|row| f64::from(row) * 0.05 + if row == 0 { 0.0 } else { jitter(row) }),
        );
        assert_eq!(at.len(), 250);
        assert!(at.windows(2).all(|pair| (3..=5).contains(&(pair[1] - pair[0]))));
    }

    #[test]
    fn where_rows_are_missing_the_decisions_of_the_gap_are_due_at_its_end() {
        assert_eq!(decided(0.0, [0.0, 0.2, 1.2].into_iter()), [0, 1, 2, 2, 2, 2, 2]);
    }
}
