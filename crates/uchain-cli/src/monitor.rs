//! Monitors a run while it flies: Ctrl-C (SIGINT), the progress bar, and the frames for the picture.

use std::sync::{
    Once,
    atomic::{AtomicBool, Ordering},
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use uchain_core::bounded;
use uchain_sim::{
    mission::chain::{Frame, History},
    record::{RecordError, Recorder},
};

/// Set by Ctrl-C. A process has one such signal, so there is one flag.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From here on Ctrl-C asks the run to stop; a second one stops the process at once.
pub(crate) fn listen_for_interrupt() {
    static ONCE: Once = Once::new();
    INTERRUPTED.store(false, Ordering::SeqCst);
    ONCE.call_once(|| {
        // If a host program already handles Ctrl-C, that is its business.
        let _ = ctrlc::set_handler(|| {
            if INTERRUPTED.swap(true, Ordering::SeqCst) {
                std::process::exit(crate::exit::Exit::Interrupted as i32);
            }
        });
    });
}

/// Whether Ctrl-C was pressed since [`listen_for_interrupt`].
pub(crate) fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}

/// Most UAV places kept for the picture, and the bounds on frames that follow from it.
const PLACES_MAX: usize = 2_000_000;
const FRAMES: (usize, usize) = (500, 8000);

/// Progress bar, and decision frames for the picture: all of a short run, every 2nd, 4th, … of a long one (decimation),
/// so that memory is bounded.
pub(crate) struct Monitor {
    history: History,
    frames_max: usize,
    stride: u64,
    decisions: u64,
    last: Frame,
    bar: ProgressBar,
}

impl Monitor {
    /// Monitors a run of so many ticks; the bar shows only on a terminal.
    pub(crate) fn new(uavs: usize, ticks: u64, show_progress: bool) -> Self {
        let target = if show_progress { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(ticks), target);
        // The template is a constant; were it wrong, the default style would do.
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
            bar.set_style(style);
        }
        Self {
            history: History::default(),
            frames_max: bounded(PLACES_MAX / uavs.max(1), FRAMES.0, FRAMES.1),
            stride: 1,
            decisions: 0,
            last: Frame::default(),
            bar,
        }
    }

    /// The frames kept, the last one included.
    pub(crate) fn into_history(mut self) -> History {
        self.bar.finish_and_clear();
        if self.history.frames.last().is_some_and(|kept| kept.tick < self.last.tick) {
            self.history.frames.push(self.last);
        }
        self.history
    }

    fn keep(&mut self, frame: &Frame) {
        self.last.clone_from(frame);
        if self.decisions.is_multiple_of(self.stride) {
            self.history.frames.push(frame.clone());
        }
        self.decisions += 1;
        if self.history.frames.len() >= self.frames_max {
            let mut index = 0_u32;
            self.history.frames.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
    }
}

impl Recorder<Frame> for Monitor {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if interrupted() {
            self.bar.finish_and_clear();
            return Err(RecordError::Interrupted { time_s: frame.time_s() });
        }
        if frame.decision {
            self.keep(frame);
            if !self.bar.is_hidden() {
                self.bar.set_position(frame.tick);
                self.bar.set_message(format!("{:.0} s", frame.time_s()));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_is_kept_evenly_spaced_in_bounded_memory_with_its_last_frame() {
        let mut monitor = Monitor::new(4000, 0, false);
        for tick in 0..100_001 {
            monitor.frame(&Frame { tick, decision: true, ..Frame::default() }).unwrap();
        }
        let ticks: Vec<u64> = monitor.into_history().frames.iter().map(|frame| frame.tick).collect();
        assert!((250..=501).contains(&ticks.len()), "{}", ticks.len());
        assert_eq!((ticks[0], ticks[ticks.len() - 1]), (0, 100_000));
        let step = ticks[1] - ticks[0];
        assert!(ticks[..ticks.len() - 1].windows(2).all(|pair| pair[1] - pair[0] == step));
    }
}
