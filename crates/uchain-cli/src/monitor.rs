//! Monitors a run while it flies: Ctrl-C (SIGINT), and the progress bar.

use std::{
    ops::ControlFlow,
    sync::{
        Once,
        atomic::{AtomicBool, Ordering},
    },
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use uchain_sim::{
    clock::total_ticks,
    registry::{AnyScene, Now, Watch},
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

/// Stops a run at Ctrl-C, and shows on a terminal how far it has come.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// Whether it is known how long the run is.
    has_end: bool,
}

impl Progress {
    /// Of a run in this scene.
    pub(crate) fn new(scene: &dyn AnyScene, show_progress: bool) -> Self {
        let target = if show_progress { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let has_end = scene.runs_to_the_end();
        let bar = ProgressBar::with_draw_target(has_end.then(|| total_ticks(scene.duration_s())), target);
        if has_end {
            // The template is a constant; were it wrong, the default style would do.
            if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
                bar.set_style(style);
            }
        } else {
            bar.set_message(format!("{} is flown", scene.name()));
        }
        Self { bar, has_end }
    }

    /// Leaves nothing on the terminal.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Progress {
    fn tick(&mut self, now: &Now<'_>) -> ControlFlow<()> {
        if interrupted() {
            self.clear();
            return ControlFlow::Break(());
        }
        if now.is_decision && !self.bar.is_hidden() {
            if self.has_end {
                self.bar.set_position(now.tick);
            }
            self.bar.set_message((now.words)());
            self.bar.tick();
        }
        ControlFlow::Continue(())
    }
}
