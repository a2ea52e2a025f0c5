//! Running other programs.

use std::env;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::Instant;

use anyhow::{Context as _, Result, ensure};

/// The workspace's root.
pub(crate) fn root() -> &'static Path {
    // The package's folder is one below it.
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Cargo, with arguments separated by spaces.
pub(crate) fn cargo(args: &str) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(args.split_whitespace()).current_dir(root());
    command
}

/// Runs cargo and shows what was run.
pub(crate) fn run_cargo(args: &str) -> Result<()> {
    run(&mut cargo(args), &format!("cargo {args}"))
}

/// Runs a command, shown by the given name and the time since the first one.
pub(crate) fn run(command: &mut Command, name: &str) -> Result<()> {
    static START: OnceLock<Instant> = OnceLock::new();
    let seconds = START.get_or_init(Instant::now).elapsed().as_secs();
    eprintln!("xtask: {:2}:{:02} {name}", seconds / 60, seconds % 60);
    let status = command.status().with_context(|| format!("{name}: can't be run"))?;
    ensure!(status.success(), "{name}: failed ({status})");
    Ok(())
}

/// What a command prints, if it can be run and succeeds.
pub(crate) fn output(command: &mut Command) -> Option<String> {
    let output = command.stderr(Stdio::null()).output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()
}

/// Whether `cargo NAME` is there. Where everything is required, a missing one is an error that names the way
/// out.
pub(crate) fn has_cargo(name: &str, remedy: &str) -> Result<bool> {
    let found = output(&mut cargo(&format!("{name} --version"))).is_some();
    let required = env::var("CATSEYE_REQUIRE").is_ok_and(|value| value == "all");
    ensure!(found || !required, "cargo {name} is not installed, and CATSEYE_REQUIRE=all; {remedy}");
    if !found {
        eprintln!("xtask: SKIPPED: cargo {name} is not installed; {remedy}");
    }
    Ok(found)
}
