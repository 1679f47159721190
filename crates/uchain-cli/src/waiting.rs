//! What turns on a terminal while a large map is worked on.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};

/// Turns, with these words, until it is dropped.
pub(crate) fn spinner(show: bool, words: &'static str) -> ProgressBar {
    let target = if show { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let spinner =
        ProgressBar::with_draw_target(None, target).with_message(words).with_finish(ProgressFinish::AndClear);
    // The template is a constant; were it wrong, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        spinner.set_style(style);
    }
    if show {
        spinner.enable_steady_tick(Duration::from_millis(100));
    }
    spinner
}
