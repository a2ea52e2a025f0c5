//! Chores.
mod fit_albedo;
fn main() -> anyhow::Result<()> {
    let text = fit_albedo::generate()?;
    std::fs::write(fit_albedo::OUTPUT, text)?;
    Ok(())
}
