//! Instructions of three workloads under callgrind: they repeat where times do not.

use std::{fmt::Write as _, fs, process::Command};

use anyhow::{Context as _, Result, bail, ensure};

use crate::house::{self, House, read};

/// As `benches/count.rs` knows them.
const WORKLOADS: &[&str] = &["rays", "w1", "mission"];
/// Where reviewed counts live.
const FILE: &str = "benches/instructions.txt";
/// What a count may change by before somebody has to look (1).
const TOLERANCE: f64 = 0.01;

/// Counts, and compares with the reviewed file or writes it.
pub(super) fn compare(house: &House, accept: bool) -> Result<()> {
    if !Command::new("valgrind").arg("--version").output().is_ok_and(|o| o.status.success()) {
        ensure!(!house::ci(), "`valgrind` is missing: apt-get install valgrind");
        println!("\ninstructions were not counted: `valgrind` is missing (apt-get install valgrind)");
        return Ok(());
    }
    let path = read(&mut house.cargo("bench --locked --bench main -- count"))?;
    let counts: Vec<(&str, u64)> =
        WORKLOADS.iter().map(|name| Ok((*name, count(house, &path, name)?))).collect::<Result<_>>()?;
    let file = house.root.join(FILE);
    if accept {
        fs::write(&file, text(house, &counts)?).with_context(|| format!("cannot write {FILE}"))?;
        println!("\nwritten: {FILE}");
        return Ok(());
    }
    let reviewed = fs::read_to_string(&file).with_context(|| format!("cannot read {FILE}"))?;
    println!("\n       change  instructions  workload ({FILE})");
    let mut off = Vec::new();
    for (name, now) in counts {
        let before = reviewed_count(&reviewed, name).with_context(|| format!("{FILE} lacks `{name}`"))?;
        let change = now as f64 / before as f64 - 1.0;
        println!("{:+12.2}% {now:>13}  {name}", 100.0 * change);
        if change.abs() > TOLERANCE {
            off.push(name);
        }
    }
    if !off.is_empty() {
        bail!(
            "instructions of {} changed by more than {} %; with another compiler than the file names that is \
             no news; otherwise find out why, then: cargo xtask bench --accept",
            off.join(", "),
            100.0 * TOLERANCE
        );
    }
    Ok(())
}

/// Instructions within the function `measured`.
fn count(house: &House, path: &str, name: &str) -> Result<u64> {
    let out = house.target.join(format!("callgrind.{name}"));
    let output = house::capture(
        Command::new("valgrind")
            .args(["--tool=callgrind", "--toggle-collect=*measured*"])
            .arg(format!("--callgrind-out-file={}", out.display()))
            .args([path, "count", name]),
    )?;
    let printed = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "valgrind on `{name}` ended with {}\n{printed}", output.status);
    let profile = fs::read_to_string(&out).with_context(|| format!("cannot read {}", out.display()))?;
    totals(&profile).filter(|count| *count > 0).with_context(|| format!("no totals in {}", out.display()))
}

fn totals(profile: &str) -> Option<u64> {
    profile.lines().find_map(|line| line.strip_prefix("totals: "))?.trim().parse().ok()
}

fn reviewed_count(reviewed: &str, name: &str) -> Option<u64> {
    let words = reviewed.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    words.into_iter().find_map(|words| match words.as_slice() {
        [workload, count] if *workload == name => count.parse().ok(),
        _ => None,
    })
}

fn text(house: &House, counts: &[(&str, u64)]) -> Result<String> {
    let compiler = read(Command::new("rustc").arg("--version").current_dir(&house.root))?;
    let mut text = format!(
        "# Instructions under callgrind, written by `cargo xtask bench --accept`; compared by `cargo xtask bench`.\n\
         # {compiler}\n"
    );
    for (name, count) in counts {
        let _ = writeln!(text, "{name:8} {count:>12}");
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn totals_are_read_from_a_profile_and_counts_from_the_reviewed_file() {
        assert_eq!(totals("# callgrind format\nevents: Ir\ntotals: 123456\n"), Some(123_456));
        assert_eq!(totals("events: Ir\n"), None);
        assert_eq!(reviewed_count("# a line\nrays 12\nw1 345\n", "w1"), Some(345));
        assert_eq!(reviewed_count("# w1 3\nrays 12\n", "w1"), None);
    }
}
