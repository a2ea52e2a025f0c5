//! The pictures of README.md and docs/.

use anyhow::Result;

use crate::tool::run_cargo;

/// Makes every picture with a command that its readers have.
pub(crate) fn run() -> Result<()> {
    for arguments in [
        "render --labels --size 1200x675 --spp 32 -o docs/night.png",
        "render materials/retro_sheeting.mtlx --lamp-deg 0.2,5 --size 720x405 --spp 48 -o docs/retro_sheeting.png",
        "furnace -o docs/furnace.png",
        "plot lobe --roughness 0.006 0.3 --theta 0 --axes log -o docs/lobes.png",
        "plot lobe --roughness 0.15 --theta 0,60 --axes cartesian -o docs/lobes_cartesian.png",
        "plot albedo -o docs/albedo.png",
        "plot albedo --model back-vector -o docs/albedo_back_vector.png",
        "plot spheres -o docs/back_vector.png",
        "drive materials/sheeting.mtlx materials/sheeting_astm_type_i_white.mtlx astm-d4956:iii:white --required 2.4 \
         --plot docs/drive.png",
        "plot optics -o docs/optics.png",
    ] {
        run_cargo(&format!("run --release --quiet --package catseye-cli -- {arguments}"))?;
    }
    Ok(())
}
