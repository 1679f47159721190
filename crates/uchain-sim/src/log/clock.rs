//! Time in a log: when decisions are due.

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
