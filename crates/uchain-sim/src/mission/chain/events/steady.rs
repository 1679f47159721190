//! A state that comes and goes, told so that one that flickers does not flood a log.

use crate::clock::TICKS_PER_S;

/// What is told of a state.
///
/// * It begins: once it has been there for so long on end as the state takes to be one, at once if that is 0.
/// * It becomes another one: likewise, but no sooner than [`SETTLED_TICKS`] after the last began.
/// * It ends: once it has been away for [`SETTLED_TICKS`] on end, with the last time it was there as its end.
///
/// So one that comes and goes at every decision is told once or never, and one that changes its word at every decision is
/// told once a second at most.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steady<T> {
    /// How long it has to be there to be told (ticks).
    patience_ticks: u64,
    told: Option<T>,
    /// Since when what is told has been there.
    since_tick: u64,
    /// When it was there last.
    last_tick: u64,
    /// What is there instead, and since when.
    instead: Option<T>,
    instead_tick: u64,
}

/// What there is to tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn<T> {
    /// What is over, and how long it lasted (ticks).
    pub(super) over: Option<(T, u64)>,
    /// What begins.
    pub(super) begins: Option<T>,
}

/// One second.
const SETTLED_TICKS: u64 = TICKS_PER_S as u64;

impl<T: Copy + PartialEq> Steady<T> {
    /// A state that has to be there for so long to be told.
    pub(super) fn patient(patience_ticks: u64) -> Self {
        Self { patience_ticks, told: None, since_tick: 0, last_tick: 0, instead: None, instead_tick: 0 }
    }

    /// What there is to tell of the state as it is at this tick.
    pub(super) fn turn(&mut self, now: Option<T>, tick: u64) -> Turn<T> {
        let nothing = Turn { over: None, begins: None };
        if self.told == now {
            (self.last_tick, self.instead, self.instead_tick) = (tick, now, tick);
            return nothing;
        }
        if self.instead != now {
            (self.instead, self.instead_tick) = (now, tick);
        }
        let is_since = |from_tick: u64, ticks: u64| tick.saturating_sub(from_tick) >= ticks;
        let is_due = match (self.told, now) {
            (_, None) => is_since(self.last_tick, SETTLED_TICKS),
            (None, Some(_)) => is_since(self.instead_tick, self.patience_ticks),
            (Some(_), Some(_)) => {
                is_since(self.instead_tick, self.patience_ticks) && is_since(self.since_tick, SETTLED_TICKS)
            }
        };
        if !is_due {
            return nothing;
        }
        let lasted_ticks = self.last_tick.saturating_sub(self.since_tick);
        let over = self.told.map(|told| (told, lasted_ticks));
        (self.told, self.since_tick, self.last_tick) = (now, self.instead_tick, tick);
        Turn { over, begins: now }
    }

    /// Nothing is told any more of what was.
    pub(super) fn forget(&mut self) {
        *self = Self::patient(self.patience_ticks);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All that is told of a minute at five decisions a second: the second it is told in, what is over, what begins.
    fn told(
        patience_ticks: u64,
        state: impl Fn(u64) -> Option<char>,
    ) -> Vec<(u64, Option<char>, Option<char>)> {
        let mut steady = Steady::patient(patience_ticks);
        let decisions = (0..300).map(|decision| decision * 4 + 1);
        let turns = decisions.filter_map(|tick| {
            let Turn { over, begins } = steady.turn(state(tick / 4), tick);
            (over.is_some() || begins.is_some()).then(|| (tick / 20, over.map(|(was, _)| was), begins))
        });
        turns.collect()
    }

    #[test]
    fn a_state_that_comes_and_goes_is_told_as_it_comes_and_a_second_after_it_went() {
        let all = told(0, |decision| (50..100).contains(&decision).then_some('a'));
        assert_eq!(all, [(10, None, Some('a')), (20, Some('a'), None)]);
        let all = told(12, |decision| (52..100).contains(&decision).then_some('a'));
        assert_eq!(all, [(11, None, Some('a')), (20, Some('a'), None)], "it has to be there for 0.6 s");
        let mut steady = Steady::patient(0);
        steady.turn(Some('a'), 21);
        steady.turn(Some('a'), 61);
        assert_eq!(steady.turn(None, 80), Turn { over: None, begins: None }, "away for less than a second");
        assert_eq!(
            steady.turn(None, 81),
            Turn { over: Some(('a', 40)), begins: None },
            "it was there for 2 s"
        );
    }

    #[test]
    fn one_that_flickers_at_every_decision_is_told_once_and_one_that_changes_its_word_once_a_second() {
        let flickers = |decision: u64| decision.is_multiple_of(2).then_some('a');
        assert_eq!(told(0, flickers).len(), 1);
        assert_eq!(told(12, flickers).len(), 0);
        let changes = |decision: u64| Some(if decision.is_multiple_of(2) { 'a' } else { 'b' });
        let words = told(0, changes);
        assert!((30..=60).contains(&words.len()), "{} of 300 decisions", words.len());
        assert!(words.windows(2).all(|two| two[1].0 > two[0].0), "{words:?}");
        assert_eq!(told(12, changes).len(), 0);
        // Every decision of one that lasts is no news.
        assert_eq!(told(0, |_| Some('a')).len(), 1);
    }
}
