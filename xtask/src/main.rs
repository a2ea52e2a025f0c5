//! Chores.
mod fit_albedo;
mod shader_albedo;
fn main() -> anyhow::Result<()> {
    match std::env::args().nth(1).as_deref() {
        Some("shaders") => {
            for (path, text) in shader_albedo::files()? {
                std::fs::write(path, text)?;
            }
        }
        _ => std::fs::write(fit_albedo::OUTPUT, fit_albedo::generate()?)?,
    }
    Ok(())
}
