//! What Ctrl-C and SIGTERM leave: no temporary file, and a line about the files that were to be written.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::exit;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The exit code of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

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
        // Held until the end: nothing is written while we say what is not.
        let pending = lock();
        for file in pending.iter().filter_map(|file| file.temporary.as_ref()) {
            fs::remove_file(file).ok();
        }
        let kept: String = pending.iter().map(|file| format!("; {}", state(&file.path))).collect();
        eprintln!("catseye: interrupted{kept}");
        exit(INTERRUPTED);
    })
    .ok();
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
