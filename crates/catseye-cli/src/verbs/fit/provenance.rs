//! Where a result comes from: the time, the program, the command, and what it read.

use std::time::{Duration, SystemTime};

use anyhow::bail;
use sha2::{Digest as _, Sha256};

use crate::failure::Usage;

/// The last second of the year 9999: dates have four digits.
const LAST_SECOND: u64 = 253_402_300_799;
/// Options of `fit` that say where its result goes, and those that say how much of it is printed.
const FILES: [&str; 3] = ["-o", "--output", "--report"];
const SILENT: [&str; 3] = ["--json", "-q", "--quiet"];

/// The time in UTC, as `2026-11-24 20:31:00 UTC`: that of `SOURCE_DATE_EPOCH` where it is set, so that a
/// report can be made again byte by byte (reproducible-builds.org/specs/source-date-epoch).
pub(crate) fn date() -> anyhow::Result<String> {
    let time = match std::env::var("SOURCE_DATE_EPOCH") {
        Err(_) => SystemTime::now(),
        Ok(text) => match text.parse() {
            Ok(seconds @ 0..=LAST_SECOND) => SystemTime::UNIX_EPOCH + Duration::from_secs(seconds),
            _ => bail!(Usage(format!(
                "SOURCE_DATE_EPOCH is {text:?}: it must be seconds since 1970, up to the year 9999"
            ))),
        },
    };
    let stamp = humantime::format_rfc3339_seconds(time).to_string();
    Ok(stamp.replace('T', " ").replace('Z', " UTC"))
}

/// The SHA-256 digest of some bytes, in hexadecimal as `sha256sum` prints it.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The command as it was given, as a shell takes it.
pub(crate) fn command_line() -> String {
    words().map(|word| quoted(&word)).collect::<Vec<_>>().join(" ")
}

/// The same without what it was to write and print: what makes the result again.
pub(crate) fn command_of_result() -> String {
    let (mut kept, mut words) = (Vec::new(), words());
    while let Some(word) = words.next() {
        if FILES.contains(&word.as_str()) {
            words.next();
        } else if !SILENT.contains(&word.as_str())
            && !FILES.iter().any(|file| word.starts_with(&format!("{file}=")))
        {
            kept.push(quoted(&word));
        }
    }
    kept.join(" ")
}

/// The arguments of the command; those that are no text with a sign for what is none.
fn words() -> impl Iterator<Item = String> {
    std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned())
}

/// A word in single quotes where a shell would take it for something else.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.:,/=+%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::{quoted, sha256};

    /// FIPS 180-2, appendix B.1.
    #[test]
    fn the_digest_is_that_of_the_standard() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn a_shell_reads_the_words_that_were_given() {
        for (word, expected) in [("a.csv", "a.csv"), ("", "''"), ("a b", "'a b'"), ("it's", r"'it'\''s'")] {
            assert_eq!(quoted(word), expected);
        }
    }
}
