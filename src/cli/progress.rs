//! Progress bars on stderr: only on a terminal, never in results.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Mutex;
use truecast::render::Progress;

/// One bar that shows the current stage.
pub(super) struct Bar {
    bar: ProgressBar,
    /// The pool's threads announce steps while the main thread may begin a stage.
    stage: Mutex<()>,
}

impl Bar {
    /// A bar that draws on stderr if that is a terminal and `quiet` is not asked for.
    pub(super) fn new(quiet: bool) -> Self {
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(0), target);
        if let Ok(style) = ProgressStyle::with_template("{msg:10} {wide_bar} {pos}/{len} {eta}") {
            bar.set_style(style);
        }
        Self { bar, stage: Mutex::new(()) }
    }

    /// Takes the bar off the terminal.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar {
    fn begin(&self, stage: &str, steps: usize) {
        let _order = self.stage.lock();
        self.bar.set_length(steps as u64);
        self.bar.set_position(0);
        self.bar.set_message(stage.to_owned());
    }

    fn step(&self) {
        self.bar.inc(1);
    }
}
