//! What is asked of the head: the scenario's script, until a flight by hand begins.

use uchain_core::{chain::PilotInput, params::OutOfRange};

use super::{PilotStep, Scenario};
use crate::{clock::time_s, pilot::Asked};

/// What is asked of the head, tick by tick.
#[derive(Debug, Default)]
pub(super) struct Steering {
    /// What is asked for now.
    now: PilotInput,
    /// Steps of the script that have begun.
    begun: usize,
    /// Whether the script is over, for somebody steers by hand.
    by_hand: bool,
    /// What somebody asked for since the last look.
    next: Option<PilotInput>,
    /// What he asked for anew at this look.
    anew: Option<PilotInput>,
}

impl Steering {
    /// From the next look on.
    pub(super) fn steer(&mut self, input: PilotInput) -> Result<(), OutOfRange> {
        PilotStep::from(Asked { tick: 0, input }).check()?;
        self.next = Some(input);
        Ok(())
    }

    /// What is asked for at a tick; ticks come in order. Steps of the script are in order as well, so that those which have
    /// begun need no second look.
    pub(super) fn look(&mut self, script: &[PilotStep], tick: u64) -> PilotInput {
        self.anew = self.next.take();
        if let Some(input) = self.anew {
            (self.now, self.by_hand) = (input, true);
        }
        if !self.by_hand {
            let now_s = time_s(tick);
            while let Some(step) = script.get(self.begun).filter(|step| step.start_s <= now_s) {
                self.now = step.input();
                self.begun += 1;
            }
        }
        self.now
    }

    /// What was asked for by hand and anew at the last look.
    pub(super) fn anew(&self) -> Option<PilotInput> {
        self.anew
    }
}

impl PilotStep {
    /// What it asks for.
    pub fn input(&self) -> PilotInput {
        PilotInput { speed_mps: self.speed_mps, follow: self.follow }
    }
}

impl From<Asked<PilotInput>> for PilotStep {
    fn from(Asked { tick, input }: Asked<PilotInput>) -> Self {
        Self { start_s: time_s(tick), speed_mps: input.speed_mps, follow: input.follow }
    }
}

impl Scenario {
    /// This scenario with the inputs of a flight by hand as its script: flown with the same seed it has the same digest.
    /// What the script asked for before the first input stays.
    ///
    /// ```
    /// use uchain_libm as _; // the same bits on every system
    /// use uchain_core::chain::{Follow, PilotInput};
    /// use uchain_sim::{config::{Source, builtin}, mission::{Scene as _, chain::{Course, Frame}}, run::{run, run_with}};
    /// let corner = builtin("corner").unwrap();
    /// let course = Course::read(&corner, &["duration_s=30".into()]).unwrap();
    /// let mut pilot = |tick: u64, _: &Frame| {
    ///     (tick == 200).then_some(PilotInput { speed_mps: 0.1, follow: Follow::Left })
    /// };
    /// let flown = run_with(&course, 1, &mut pilot, &mut ()).unwrap();
    ///
    /// let text = course.scenario.by_hand(&flown.inputs).to_toml().unwrap();
    /// assert!(text.contains("start_s = 10.0\nspeed_mps = 0.1\nfollow = \"left\""));
    /// let again = Course::read(&Source { text, ..corner }, &[]).unwrap();
    /// assert_eq!(run(&again, 1, &mut ()).unwrap().digest, flown.summary.digest);
    /// ```
    #[must_use]
    pub fn by_hand(&self, inputs: &[Asked<PilotInput>]) -> Self {
        let first_s = inputs.first().map_or(f64::INFINITY, |first| time_s(first.tick));
        let script = self.pilot.iter().take_while(|step| step.start_s < first_s).copied();
        let pilot = script.chain(inputs.iter().copied().map(PilotStep::from)).collect();
        Self { pilot, ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use uchain_core::chain::Follow;

    use super::*;

    /// What is asked for at a time, by a look at the whole script.
    fn scanned(script: &[PilotStep], tick: u64) -> PilotInput {
        let now = script.iter().take_while(|step| step.start_s <= time_s(tick)).last();
        now.map_or_else(PilotInput::default, PilotStep::input)
    }

    /// Steps at ticks, a hair before and after them, at equal times, in no order, and at no time at all.
    fn scripts() -> impl Strategy<Value = Vec<PilotStep>> {
        let at = |tick: u64, off: usize| {
            let at_s = time_s(tick);
            [at_s, at_s.next_down(), at_s.next_up(), at_s, at_s + 0.02, f64::NAN][off]
        };
        let step =
            (0_u64..60, 0_usize..6, -1.0_f32..=1.0).prop_map(move |(tick, off, speed_mps)| PilotStep {
                start_s: at(tick, off),
                speed_mps,
                follow: if speed_mps < 0.0 { Follow::Left } else { Follow::Right },
            });
        let sorted = |mut steps: Vec<PilotStep>| {
            steps.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
            steps
        };
        let steps = prop::collection::vec(step, 0..40);
        prop_oneof![4 => steps.clone().prop_map(sorted), 1 => steps]
    }

    proptest! {
        #[test]
        fn a_cursor_finds_what_a_look_at_the_whole_script_finds(script in scripts()) {
            let mut steering = Steering::default();
            for tick in 0..70 {
                prop_assert_eq!(steering.look(&script, tick), scanned(&script, tick), "tick {}", tick);
                prop_assert_eq!(steering.anew(), None);
            }
        }
    }

    #[test]
    fn from_the_first_input_on_the_script_is_over() {
        let step = |start_s, speed_mps| PilotStep { start_s, speed_mps, follow: Follow::Centre };
        let script = [step(0.0, 0.1), step(1.0, 0.2)];
        let mut steering = Steering::default();
        assert_eq!(steering.look(&script, 0).speed_mps, 0.1);
        let input = PilotInput { speed_mps: 0.3, follow: Follow::Left };
        steering.steer(input).unwrap();
        assert_eq!((steering.look(&script, 1), steering.anew()), (input, Some(input)));
        assert_eq!((steering.look(&script, 2), steering.anew()), (input, None));
        assert_eq!(steering.look(&script, 40), input);
    }

    #[test]
    fn what_no_scenario_may_ask_for_is_refused_and_changes_nothing() {
        let mut steering = Steering::default();
        for (speed_mps, words) in [
            (1.5, "speed_mps = 1.5: must lie in -1..=1"),
            (-1.1, "speed_mps = -1.100000023841858: must lie in -1..=1"),
            (f32::NAN, "speed_mps = NaN: must lie in -1..=1"),
            (f32::INFINITY, "speed_mps = inf: must lie in -1..=1"),
        ] {
            let refused = steering.steer(PilotInput { speed_mps, ..PilotInput::default() }).unwrap_err();
            assert_eq!(refused.to_string(), words);
        }
        assert_eq!((steering.look(&[], 0), steering.anew()), (PilotInput::default(), None));
        assert_eq!(steering.steer(PilotInput { speed_mps: -1.0, ..PilotInput::default() }), Ok(()));
    }
}
