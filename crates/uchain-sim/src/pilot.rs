//! Who steers: asked once before every tick, he may ask for something new.
//!
//! A scenario has a script of its own, and as long as nobody asks for anything that is what is flown. From the first
//! input on a flight is by hand: it is what its pilot asks for, until he asks for something else. So a run is a function of
//! scene, seed and inputs, and [`run_with`](crate::run::run_with) gives them back.
//!
//! | pilot | what it asks for |
//! |---|---|
//! | [`Scripted`] | nothing: the scenario's script is flown |
//! | [`Live`] | what another thread asked for last |
//! | a function of tick and frame | what it returns |
//! | [`Nobody`] | the mission's default, from the first tick on: the head of a chain hovers |

use std::sync::{Arc, Mutex, PoisonError};

/// Most inputs of one flight, and most steps of a scenario's script.
pub const INPUTS_MAX: usize = 100_000;

/// Who steers: asked once before every tick. `F` is the mission's frame, `I` its input.
///
/// Whatever takes the tick's number and the last frame, and gives an input or none, is a pilot as well:
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_core::chain::PilotInput;
/// use uchain_sim::{config::builtin, mission::chain::{Course, Frame}, run::run_with};
/// let course = Course::read(&builtin("straight").unwrap(), &["duration_s=60".into()]).unwrap();
/// // On at 0.2 m/s, until 3 m are flown.
/// let mut pilot = |_: u64, last: &Frame| {
///     let speed_mps = if last.head_reach_m < 3.0 { 0.2 } else { 0.0 };
///     Some(PilotInput { speed_mps, ..PilotInput::default() })
/// };
/// let flown = run_with(&course, 1, &mut pilot, &mut ()).unwrap();
/// // What is asked for again is nothing new.
/// assert_eq!(flown.inputs.len(), 2);
/// ```
pub trait Pilot<F, I> {
    /// A new input from this tick on, counted from 0, or `None` to leave it as it is. `last` is what the tick before left
    /// behind; before the first tick it is empty.
    fn ask(&mut self, tick: u64, last: &F) -> Option<I>;
}

impl<F, I, P: FnMut(u64, &F) -> Option<I>> Pilot<F, I> for P {
    fn ask(&mut self, tick: u64, last: &F) -> Option<I> {
        self(tick, last)
    }
}

/// The scenario's own script: asks for nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Scripted;

impl<F, I> Pilot<F, I> for Scripted {
    fn ask(&mut self, _: u64, _: &F) -> Option<I> {
        None
    }
}

/// There is no pilot, and no script: the mission's default from the first tick on. The head of a chain hovers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Nobody;

impl<F, I: Default> Pilot<F, I> for Nobody {
    fn ask(&mut self, tick: u64, _: &F) -> Option<I> {
        (tick == 0).then(I::default)
    }
}

/// Steered from another thread, by [`Controls`]: what they were set to last.
///
/// A simulation waits for nobody: whoever watches it in real time paces it with a recorder that sleeps.
///
/// ```
/// use uchain_sim::pilot::{Live, Pilot};
/// let (mut pilot, controls) = Live::new(0);
/// assert_eq!(pilot.ask(0, &()), Some(0));
/// std::thread::spawn(move || { controls.set(1); controls.set(2) }).join().unwrap();
/// assert_eq!(pilot.ask(1, &()), Some(2));
/// assert_eq!(pilot.ask(2, &()), None);
/// ```
#[derive(Debug)]
pub struct Live<I> {
    newest: Arc<Mutex<Option<I>>>,
}

/// Steers a [`Live`] pilot from wherever it is taken to; all clones steer the same one.
#[derive(Debug)]
pub struct Controls<I> {
    newest: Arc<Mutex<Option<I>>>,
}

impl<I> Live<I> {
    /// A pilot that asks for `first` from the first tick on, and what steers it from then on.
    pub fn new(first: I) -> (Self, Controls<I>) {
        let newest = Arc::new(Mutex::new(Some(first)));
        (Self { newest: newest.clone() }, Controls { newest })
    }
}

impl<F, I> Pilot<F, I> for Live<I> {
    fn ask(&mut self, _: u64, _: &F) -> Option<I> {
        // An option that is half written does not exist: whoever panicked elsewhere changes nothing here.
        self.newest.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl<I> Controls<I> {
    /// Asks for this from the next tick on, in place of whatever was not asked for yet.
    pub fn set(&self, input: I) {
        *self.newest.lock().unwrap_or_else(PoisonError::into_inner) = Some(input);
    }
}

impl<I> Clone for Controls<I> {
    fn clone(&self) -> Self {
        Self { newest: self.newest.clone() }
    }
}

/// An input, and when it was asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked<I> {
    /// The first tick that it was flown in, counted from 0: ticks of which the end was past when it was asked for.
    pub tick: u64,
    /// What was asked for.
    pub input: I,
}
