//! What Ctrl-C and SIGTERM leave: no temporary file, and a line about the files that were to be written.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The exit code of a program that Ctrl-C ended.
pub(crate) const INTERRUPTED: u8 = 130;

/// Whether the work looks at [`stop`] and ends by itself.
static GENTLE: AtomicBool = AtomicBool::new(false);
/// Whether it is to end.
static STOP: AtomicBool = AtomicBool::new(false);
/// The files that are to be written.
static PENDING: Mutex<Vec<Pending>> = Mutex::new(Vec::new());

#[derive(Debug)]
struct Pending {
    path: PathBuf,
    temporary: Option<PathBuf>,
}

/// From now on an interrupted command cleans up.
pub(crate) fn install() {
    // Where no handler can be set the command works as well, and leaves a temporary file where it is
    // interrupted.
    ctrlc::set_handler(|| {
        // Who asks twice does not want to wait.
        if GENTLE.load(Ordering::Relaxed) && !STOP.swap(true, Ordering::Relaxed) {
            return;
        }
        // Held until the end: nothing is written while we say what is not.
        let pending = lock();
        for file in pending.iter().filter_map(|file| file.temporary.as_ref()) {
            fs::remove_file(file).ok();
        }
        let kept: String = pending.iter().map(|file| format!("; {}", state(&file.path))).collect();
        eprintln!("catseye: interrupted{kept}");
        exit(i32::from(INTERRUPTED));
    })
    .ok();
}

/// From now on the first interruption only says so, by [`stop`].
pub(crate) fn stop_gently() {
    GENTLE.store(true, Ordering::Relaxed);
}

/// Becomes true where work that asked for it by [`stop_gently`] is to end.
pub(crate) fn stop() -> &'static AtomicBool {
    &STOP
}

fn state(path: &Path) -> String {
    let state = if path.exists() { "is as it was before" } else { "was not written" };
    format!("{} {state}", path.display())
}

/// Notes that a file is going to be written.
pub(crate) fn expect(path: &Path) {
    let mut pending = lock();
    if pending.iter().all(|file| file.path != path) {
        pending.push(Pending { path: path.to_owned(), temporary: None });
    }
}

/// Notes the temporary file that stands in for a file.
pub(crate) fn stand_in(path: &Path, temporary: &Path) {
    if let Some(file) = lock().iter_mut().find(|file| file.path == path) {
        file.temporary = Some(temporary.to_owned());
    }
}

/// Puts a file in its place by `place`, which no interruption comes between.
pub(crate) fn complete<T>(path: &Path, place: impl FnOnce() -> T) -> T {
    let mut pending = lock();
    let result = place();
    pending.retain(|file| file.path != path);
    result
}

fn lock() -> MutexGuard<'static, Vec<Pending>> {
    // A list of names is whole whatever happened to the thread that held it.
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}
