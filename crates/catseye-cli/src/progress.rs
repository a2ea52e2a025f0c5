//! The progress bar: on a terminal, with the time left, for work that takes longer than a second.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::report;

/// Work shorter than this shows nothing.
const QUIET: Duration = Duration::from_secs(1);

/// Progress of one piece of work. It can be shared among threads.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    started: Instant,
    shown: OnceLock<()>,
}

impl Progress {
    /// `total` steps of `what`.
    pub(crate) fn new(what: &'static str, total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        let template = "{prefix} [{bar:40}] {percent}% {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_prefix(what);
        Self { bar, started: Instant::now(), shown: OnceLock::new() }
    }

    /// Work whose length nobody knows: a line with the time that it has taken.
    pub(crate) fn unknown(what: &'static str) -> Self {
        let bar = if report::is_quiet() { ProgressBar::hidden() } else { ProgressBar::new_spinner() };
        if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix} {elapsed}") {
            bar.set_style(style);
        }
        bar.set_prefix(what);
        bar.enable_steady_tick(QUIET / 4);
        Self { bar, started: Instant::now(), shown: OnceLock::from(()) }
    }

    /// Reports how many steps are done.
    pub(crate) fn set(&self, done: u64) {
        if self.started.elapsed() >= QUIET && !report::is_quiet() {
            // Standard error draws nothing where it is no terminal.
            self.shown.get_or_init(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        self.bar.set_position(done);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
