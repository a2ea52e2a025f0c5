//! The pictures of README.md.

use anyhow::Result;

use crate::tool::run_cargo;

/// Makes every picture with the command that its readers have.
pub(crate) fn run() -> Result<()> {
    for arguments in [
        "render -o docs/night.png",
        "furnace -o docs/furnace.png",
        "plot lobe --roughness 0.3 -o docs/lobes.png",
    ] {
        run_cargo(&format!("run --release --quiet --package catseye-cli -- {arguments}"))?;
    }
    Ok(())
}
