//! Files that are committed although a program wrote them: written again on demand, and compared by tests.

use std::fs;

use anyhow::{Context as _, Result, bail};

use crate::{fit_albedo, golden, shader_albedo, tool};

/// Whether to write the files or to compare them.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Mode {
    /// Compare the committed files with what would be written
    #[arg(long)]
    check: bool,
}

/// One generator, and how far its numbers may be from the committed ones.
pub(crate) struct Generator {
    /// The chore's name.
    chore: &'static str,
    /// Paths from the workspace's root, and texts.
    generate: fn() -> Result<Vec<(&'static str, String)>>,
    tolerance: Tolerance,
}

/// The mathematical functions of another machine's C library may differ in their last digits.
#[derive(Clone, Copy)]
struct Tolerance {
    absolute: f64,
    relative: f64,
}

/// The albedo fits. The least-squares problem is ill-conditioned: relative changes of 2e-15 in its input
/// change coefficients by up to 2.7e-4, and the fit by 3.4e-6. Its error is another test's business.
pub(crate) const TABLES: Generator = Generator {
    chore: "fit-albedo",
    generate: || Ok(vec![(fit_albedo::OUTPUT, fit_albedo::generate()?)]),
    tolerance: Tolerance { absolute: 1e-3, relative: 0.0 },
};

/// The vectors, to the digits that the reference's own are compared with.
pub(crate) const VECTORS: Generator = Generator {
    chore: "golden",
    generate: golden::generate,
    tolerance: Tolerance { absolute: 1e-12, relative: 1e-9 },
};

/// The compact fit's table in the shading languages: a copy of the committed one.
pub(crate) const SHADERS: Generator = Generator {
    chore: "shaders",
    generate: shader_albedo::generate,
    tolerance: Tolerance { absolute: 0.0, relative: 0.0 },
};

impl Generator {
    /// Writes the files, or compares them.
    pub(crate) fn run(&self, mode: Mode) -> Result<()> {
        for (path, text) in (self.generate)()? {
            let file = tool::root().join(path);
            if !mode.check {
                fs::write(&file, text).with_context(|| format!("{path}: can't be written"))?;
                eprintln!("xtask: wrote {path}");
                continue;
            }
            let committed = fs::read_to_string(&file).with_context(|| format!("{path}: can't be read"))?;
            if let Some(difference) = self.tolerance.difference(&committed, &text) {
                bail!("{path}:{difference}; run `cargo xtask {}` and look at what changed", self.chore);
            }
        }
        Ok(())
    }
}

impl Tolerance {
    /// Line and nature of the first difference: in the text, or in a number beyond the tolerance.
    fn difference(self, committed: &str, generated: &str) -> Option<String> {
        let mut line = 1;
        let (mut a, mut b) = (pieces(committed), pieces(generated));
        loop {
            let (a, b) = match (a.next(), b.next()) {
                (None, None) => return None,
                (a, b) => (a.unwrap_or_default(), b.unwrap_or_default()),
            };
            if !self.alike(a, b) {
                return Some(format!(
                    "{line}: {:?} stands where {:?} is generated",
                    a.trim_end(),
                    b.trim_end()
                ));
            }
            line += usize::from(a.ends_with('\n'));
        }
    }

    fn alike(self, a: &str, b: &str) -> bool {
        let ((number_a, end_a), (number_b, end_b)) = (split_end(a), split_end(b));
        match (number_a.parse::<f64>(), number_b.parse::<f64>()) {
            // Infinities are equal, but their difference isn't 0.
            (Ok(x), Ok(y)) => {
                end_a == end_b && (x == y || (x - y).abs() <= self.absolute + self.relative * y.abs())
            }
            _ => a == b,
        }
    }
}

/// The text as words, each with the separator that ends it.
fn pieces(text: &str) -> impl Iterator<Item = &str> {
    text.split_inclusive(is_separator)
}

fn split_end(piece: &str) -> (&str, &str) {
    piece.split_at(piece.trim_end_matches(is_separator).len())
}

fn is_separator(c: char) -> bool {
    !c.is_ascii_alphanumeric() && !"+-._".contains(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn albedo_tables_are_what_the_generator_writes() -> Result<()> {
        TABLES.run(Mode { check: true })
    }

    #[test]
    fn golden_vectors_are_what_the_generator_writes() -> Result<()> {
        VECTORS.run(Mode { check: true })
    }

    #[test]
    fn shaders_are_what_the_generator_writes() -> Result<()> {
        SHADERS.run(Mode { check: true })
    }

    #[test]
    fn differences_are_found() {
        let tolerance = Tolerance { absolute: 0.0, relative: 1e-6 };
        let text = "a,b\n1.5,inf\n-2e-3,dirac\n";
        assert_eq!(tolerance.difference(text, text), None);
        assert_eq!(tolerance.difference(text, &text.replace("1.5", "1.500001")), None);
        for (from, to, place) in [
            ("1.5", "1.51", "2: \"1.5,\" stands where \"1.51,\" is generated"),
            ("inf", "1e300", "2: \"inf\" stands where \"1e300\" is generated"),
            ("-2e-3", "-2e-3 ", "3: \"-2e-3,\" stands where \"-2e-3\" is generated"),
            ("dirac", "single", "3: \"dirac\" stands where \"single\" is generated"),
            ("dirac\n", "dirac\n1", "4: \"\" stands where \"1\" is generated"),
        ] {
            assert_eq!(tolerance.difference(text, &text.replace(from, to)).as_deref(), Some(place));
        }
    }
}
