//! Runs the binary in a folder of its own.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// What a run left.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// A temporary folder that commands run in.
#[derive(Debug)]
pub(crate) struct Bench(TempDir);

impl Bench {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// A folder with the repository's `materials`.
    pub(crate) fn with_materials() -> Self {
        let bench = Self::new();
        let materials = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../materials");
        fs::create_dir(bench.path("materials")).unwrap();
        for entry in fs::read_dir(materials).unwrap() {
            let entry = entry.unwrap();
            if entry.path().is_file() {
                fs::copy(entry.path(), bench.path("materials").join(entry.file_name())).unwrap();
            }
        }
        bench
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// Names of everything in the folder, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs `catseye` with arguments separated by spaces.
    pub(crate) fn catseye(&self, args: &str, stdin: &str) -> Outcome {
        let mut command = Command::new(env!("CARGO_BIN_EXE_catseye"));
        command.args(args.split_whitespace());
        self.finish(command, stdin)
    }

    /// Runs a line of shell in which `catseye` is the binary under test.
    pub(crate) fn shell(&self, line: &str) -> Outcome {
        let folder = Path::new(env!("CARGO_BIN_EXE_catseye")).parent().unwrap();
        let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap_or_default());
        let mut command = Command::new("sh");
        command.arg("-c").arg(line).env("PATH", path);
        self.finish(command, "")
    }

    fn finish(&self, mut command: Command, stdin: &str) -> Outcome {
        command
            .current_dir(self.0.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // A command that fails before it reads leaves the pipe broken.
        child.stdin.take().unwrap().write_all(stdin.as_bytes()).ok();
        let output = child.wait_with_output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Outcome {
            code: output.status.code().unwrap(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

/// Runs `catseye` where nothing but its output matters, and expects success.
pub(crate) fn output(args: &str, stdin: &str) -> String {
    let outcome = Bench::new().catseye(args, stdin);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "catseye {args}");
    outcome.stdout
}

/// The cells of a CSV text without quotes.
pub(crate) fn cells(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

/// The numbers of one column of a CSV text without quotes.
pub(crate) fn column(text: &str, name: &str) -> Vec<f64> {
    let rows = cells(text);
    let field =
        rows[0].iter().position(|&other| other == name).unwrap_or_else(|| panic!("no {name} in {text}"));
    rows[1..].iter().map(|row| row[field].parse().unwrap()).collect()
}

/// Equal texts; numbers up to the rounding that another machine's mathematical functions may do.
pub(crate) fn alike(a: &str, b: &str) -> bool {
    alike_within(a, b, 1e-9)
}

/// Whether two texts are the same but for numbers, which may differ by a share of their size.
pub(crate) fn alike_within(a: &str, b: &str, share: f64) -> bool {
    let words = |text: &str| text.split([',', ':', '}', ' ', '\n']).map(str::to_owned).collect::<Vec<_>>();
    let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(x), Ok(y)) => a == b || (x - y).abs() <= share * x.abs(),
        _ => a == b,
    };
    let (a, b) = (words(a), words(b));
    a.len() == b.len() && a.iter().zip(&b).all(same)
}
