//! The progress bar: on a terminal, with the time left, for work that takes longer than a second.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle as Template};

use crate::report;

/// Work shorter than this shows nothing.
const QUIET: Duration = Duration::from_secs(1);

/// Steps of work that is told in shares.
const STEPS: u64 = 1000;

/// How progress is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressStyle {
    /// A bar on a terminal
    #[default]
    Bar,
    /// Lines `openjd_progress: 12.5` on standard output, as runners of Open Job Description read them
    Openjd,
    /// Nothing
    None,
}

/// Progress of one piece of work. It can be shared among threads.
#[derive(Debug)]
pub(crate) struct Progress {
    style: ProgressStyle,
    /// The last share that was printed, in [`STEPS`].
    printed: AtomicU64,
    bar: ProgressBar,
    started: Instant,
    shown: OnceLock<()>,
}

impl Progress {
    /// `total` steps of `what`.
    pub(crate) fn new(what: &'static str, total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        let template = "{prefix} [{bar:40}] {percent}% {eta} left";
        if let Ok(style) = Template::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_prefix(what);
        let (style, printed) = (ProgressStyle::Bar, AtomicU64::new(0));
        Self { style, printed, bar, started: Instant::now(), shown: OnceLock::new() }
    }

    /// Work that tells the share of it that is done.
    pub(crate) fn shares(what: &'static str, style: ProgressStyle) -> Self {
        let mut progress = Self::new(what, STEPS);
        progress.style = style;
        progress
    }

    /// Work whose length nobody knows: a line with the time that it has taken.
    pub(crate) fn unknown(what: &'static str) -> Self {
        let bar = if report::is_quiet() { ProgressBar::hidden() } else { ProgressBar::new_spinner() };
        if let Ok(style) = Template::with_template("{spinner} {prefix} {elapsed}") {
            bar.set_style(style);
        }
        bar.set_prefix(what);
        bar.enable_steady_tick(QUIET / 4);
        let (style, printed) = (ProgressStyle::Bar, AtomicU64::new(0));
        Self { style, printed, bar, started: Instant::now(), shown: OnceLock::from(()) }
    }

    /// Reports which share is done, in `[0, 1]`.
    pub(crate) fn share(&self, share: f32) {
        let steps = (share.clamp(0.0, 1.0) * STEPS as f32) as u64;
        match self.style {
            ProgressStyle::Bar => self.set(steps),
            ProgressStyle::None => {}
            // Threads report in any order; half a percent is news.
            ProgressStyle::Openjd => {
                let before = self.printed.fetch_max(steps, Ordering::Relaxed);
                if steps / 5 > before / 5 {
                    println!("openjd_progress: {:.1}", steps as f32 / 10.0);
                }
            }
        }
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
