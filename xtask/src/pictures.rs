//! The pictures of README.md and docs/.

use anyhow::Result;

use crate::tool::run_cargo;

/// Makes every picture with a command that its readers have.
pub(crate) fn run() -> Result<()> {
    for arguments in [
        "catseye-cli -- render -o docs/night.png",
        "catseye-cli -- render materials/retro_sheeting.mtlx --size 480x270 --spp 64 -o docs/retro_sheeting.png",
        "catseye-cli -- furnace -o docs/furnace.png",
        "catseye-cli -- plot lobe --roughness 0.3 -o docs/lobes.png",
        "catseye-cli -- plot lobe --roughness 0.15 --theta 0,60 --axes cartesian -o docs/lobes_cartesian.png",
        "catseye-cli -- plot albedo -o docs/albedo.png",
        "catseye-cli -- plot albedo --model back-vector -o docs/albedo_back_vector.png",
        "catseye-render --example back_vector -- docs/back_vector.png",
    ] {
        run_cargo(&format!("run --release --quiet --package {arguments}"))?;
    }
    Ok(())
}
