//! Progress bar of a sweep.

use std::{
    sync::atomic::{AtomicU64, Ordering},
    time::Duration,
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use uchain_sim::sweep::folder::{FolderError, Watch};

use crate::monitor::interrupted;

/// A bar with rate and time left; on a terminal only.
pub(super) struct Progress {
    bar: ProgressBar,
    failed: AtomicU64,
}

impl Progress {
    pub(super) fn new(runs: u64, show: bool) -> Self {
        let target = if show { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(runs), target);
        // The template is a constant; were it wrong, the default style would do.
        if let Ok(style) =
            ProgressStyle::with_template("{bar:30} {pos}/{len} runs, {per_sec}, {eta} left{msg}")
        {
            bar.set_style(style);
        }
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        Self { bar, failed: AtomicU64::new(0) }
    }

    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Progress {
    fn stop(&self) -> bool {
        interrupted()
    }

    fn again(&self, why: &FolderError) {
        self.bar.suspend(|| eprintln!("warning: {why}"));
    }

    fn done(&self, runs: u64, failed: u64, now: bool) {
        self.bar.inc(runs);
        if !now {
            // What was there took no time.
            self.bar.reset_eta();
        }
        let failed = self.failed.fetch_add(failed, Ordering::Relaxed) + failed;
        if failed > 0 {
            self.bar.set_message(format!(", {failed} failed"));
        }
    }
}
