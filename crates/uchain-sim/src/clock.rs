//! Simulated time: whole ticks, and the seconds they stand for.
//!
//! Time is counted in ticks; every rate divides theirs, and every period is a whole number of them. Seconds are
//! computed from ticks, never added up.

/// Ticks of one second.
pub const TICKS_PER_S: f64 = 20.0;
/// Length of one tick (s).
pub const TICK_S: f32 = 0.05;
/// Length of one tick (ns).
pub const TICK_NS: u64 = 1_000_000_000 / TICKS_PER_S as u64;

/// Simulated time at the end of a tick (s).
///
/// ```
/// assert_eq!(uchain_sim::clock::time_s(30), 1.5);
/// ```
pub fn time_s(tick: u64) -> f64 {
    tick as f64 / TICKS_PER_S
}

/// Simulated time at the start of a tick (s), counted by its end: when sensors were read and decisions taken.
pub fn start_s(tick: u64) -> f64 {
    time_s(tick.saturating_sub(1))
}

/// Ticks of a run of this length (s), to the nearest one.
pub fn total_ticks(duration_s: f64) -> u64 {
    (duration_s * TICKS_PER_S).round() as u64
}

/// A time (s) as a whole number of ticks, which may be none.
pub fn whole_ticks(time_s: f32) -> u64 {
    (time_s / TICK_S).round() as u64
}

/// A period (s) as a whole number of ticks, at least one.
pub fn period_ticks(period_s: f32) -> u64 {
    whole_ticks(period_s).max(1)
}

/// Whether a period (s) is a whole number of ticks, at least one, as closely as decimal fractions are.
pub fn is_period(period_s: f64) -> bool {
    let ticks = period_s / (1.0 / TICKS_PER_S);
    (ticks - ticks.round()).abs() <= 1e-4 && ticks > 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_has_as_many_ticks_in_every_unit() {
        assert_eq!(total_ticks(1.0), TICKS_PER_S as u64);
        assert_eq!(whole_ticks(1.0), TICKS_PER_S as u64);
        assert_eq!(TICK_NS * TICKS_PER_S as u64, 1_000_000_000);
        assert_eq!((start_s(20), time_s(20), start_s(0)), (0.95, 1.0, 0.0));
    }

    #[test]
    fn a_period_is_one_tick_at_least_and_a_time_may_be_none() {
        assert_eq!((whole_ticks(0.0), period_ticks(0.0), period_ticks(0.2)), (0, 1, 4));
        assert!(is_period(0.2) && is_period(0.05) && is_period(86_400.0));
        assert!(!is_period(0.21) && !is_period(0.0) && !is_period(f64::NAN));
    }
}
