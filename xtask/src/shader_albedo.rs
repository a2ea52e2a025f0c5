//! Writes the table of the compact albedo fit into the shading languages.

use std::fmt::Write as _;

use anyhow::Result;

#[expect(dead_code, reason = "generated; only the compact fit's table is for shading languages")]
#[path = "../../crates/catseye/src/albedo/tables.rs"]
mod tables;

use tables::{COMPACT, COMPACT_KAPPA};

/// The generated files, from the workspace's root, with their texts.
pub(crate) fn generate() -> Result<Vec<(&'static str, String)>> {
    Ok(vec![
        ("crates/catseye-materialx/libraries/catseye/genglsl/lib/mx_retro_reflective_albedo.glsl", glsl()?),
        ("crates/catseye-materialx/libraries/catseye/genosl/lib/mx_retro_reflective_albedo.osl", osl()?),
    ])
}

const GLSL_HEAD: &str = include_str!("shader_albedo/head.glsl");
const GLSL_TAIL: &str = include_str!("shader_albedo/tail.glsl");
const OSL_HEAD: &str = include_str!("shader_albedo/head.osl");
const OSL_TAIL: &str = include_str!("shader_albedo/tail.osl");

/// Chebyshev polynomials in the width (a) and the ratio (b) are unrolled: MSL and WGSL have no constant
/// arrays that MaterialX's generators could write.
fn glsl() -> Result<String> {
    let mut out = format!("{GLSL_HEAD}\n");
    writeln!(out, "#define RETRO_REFLECTIVE_ALBEDO_KAPPA {COMPACT_KAPPA:?}\n")?;
    writeln!(out, "// The sums of both for a ratio of 1, where every T_b is 1 and w is 0.")?;
    writeln!(
        out,
        "void mx_retro_reflective_contract_isotropic(vec4 t_m, float m, inout RetroReflectiveAlbedo albedo)\n{{"
    )?;
    for (a, rows) in COMPACT.iter().enumerate() {
        let sum = |i: usize| rows.iter().map(|row| row[i]).sum::<f32>();
        let factor = t("t_m", a);
        let [p0, p1, p2, p3, p4] = [0, 1, 2, 3, 4].map(sum);
        writeln!(out, "    albedo.p0 += {factor}vec4({p0:.6}, {p1:.6}, {p2:.6}, {p3:.6});")?;
        writeln!(out, "    albedo.p0_p1.x += {factor}{p4:.6};")?;
    }
    writeln!(out, "    albedo.p0 *= m;\n    albedo.p0_p1 *= m;\n}}\n")?;
    writeln!(
        out,
        "void mx_retro_reflective_contract(vec4 t_m, vec4 t_k, float m, inout RetroReflectiveAlbedo albedo)\n{{"
    )?;
    writeln!(out, "    float t;")?;
    for (a, rows) in COMPACT.iter().enumerate() {
        for (b, row) in rows.iter().enumerate() {
            let factor = match (a, b) {
                (0, 0) => "1.0".to_owned(),
                (0, _) => format!("t_k[{}]", b - 1),
                (_, 0) => format!("t_m[{}]", a - 1),
                _ => format!("t_m[{}] * t_k[{}]", a - 1, b - 1),
            };
            let numbers: Vec<String> = row.iter().map(|x| format!("{x:.6}")).collect();
            writeln!(out, "    t = {factor};")?;
            writeln!(out, "    albedo.p0 += t * vec4({});", numbers[..4].join(", "))?;
            writeln!(out, "    albedo.p0_p1 += t * vec4({});", numbers[4..8].join(", "))?;
            writeln!(out, "    albedo.p2 += t * {};", numbers[8])?;
        }
    }
    writeln!(out, "    albedo.p0 *= m;\n    albedo.p0_p1 *= m;\n    albedo.p2 *= m;\n}}\n")?;
    out.push_str(GLSL_TAIL);
    Ok(out)
}

/// `T_a * `, or nothing for the constant polynomial.
fn t(name: &str, order: usize) -> String {
    if order == 0 { String::new() } else { format!("{name}[{}] * ", order - 1) }
}

fn osl() -> Result<String> {
    let mut out = format!("{OSL_HEAD}\n");
    writeln!(out, "    float table[225] = {{")?;
    for row in COMPACT.iter().flatten() {
        let numbers: Vec<String> = row.iter().map(|x| format!("{x:.6}")).collect();
        writeln!(out, "        {},", numbers.join(", "))?;
    }
    let text = out.trim_end_matches(",\n").to_owned();
    Ok(format!("{text}\n    }};\n    float KAPPA = {COMPACT_KAPPA:?};\n{OSL_TAIL}"))
}
