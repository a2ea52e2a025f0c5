//! Whether the crates meant for others can be published: each is packaged, and what was packaged compiles.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use crate::tool::{self, cargo, run_cargo};

/// Packages the crates as `cargo publish` would and checks them outside the workspace, where no path leads
/// back to a file that was not packaged. They find each other as local files, since crates.io has none of
/// them yet.
pub(crate) fn run() -> Result<()> {
    let packages = tool::root().join("target/package");
    // What an earlier run has packaged must not be taken for this one's.
    if packages.exists() {
        fs::remove_dir_all(&packages).with_context(|| format!("{}: can't be removed", packages.display()))?;
    }
    run_cargo("package --workspace --exclude xtask --no-verify --allow-dirty --quiet")?;
    let mut members = Vec::new();
    for entry in fs::read_dir(&packages)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "crate") {
            members.push(unpack(&path)?);
        }
    }
    ensure!(!members.is_empty(), "cargo package left nothing in {}", packages.display());
    fs::write(packages.join("Cargo.toml"), workspace(&members))?;
    fs::copy(tool::root().join("Cargo.lock"), packages.join("Cargo.lock"))?;
    let args = "check --release --workspace --all-features";
    let mut check = cargo(args);
    check.current_dir(&packages).arg("--target-dir").arg(tool::root().join("target"));
    tool::run(&mut check, &format!("cargo {args}, in target/package"))
}

/// Unpacks an archive beside itself; the name of its folder, which is the crate's with the version.
fn unpack(archive: &Path) -> Result<String> {
    let stem = archive.file_stem().context("an archive without a name")?;
    let folder = archive.parent().context("an archive without a folder")?;
    let status = Command::new("tar").arg("-xzf").arg(archive).arg("-C").arg(folder).status()?;
    ensure!(status.success(), "{}: tar failed ({status})", archive.display());
    stem.to_os_string().into_string().ok().context("an archive with a strange name")
}

/// A manifest that joins the unpacked crates.
fn workspace(members: &[String]) -> String {
    let patches = members.iter().filter_map(|member| {
        let (name, _) = member.rsplit_once('-')?;
        Some(format!("{name} = {{ path = \"{member}\" }}\n"))
    });
    format!(
        "[workspace]\nresolver = \"3\"\nmembers = {members:?}\n\n[patch.crates-io]\n{}",
        patches.collect::<String>()
    )
}
