//! A proof about another version of a dependency proves nothing: the lock files of the mini-workspaces follow
//! the project's.

use std::{collections::BTreeSet, fs, path::Path};

use anyhow::{Context as _, Result, ensure};

use super::Outcome;
use crate::house::House;

/// What a workspace of its own may depend on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum May {
    /// What the project depends on, and nothing else.
    TheSame,
    /// More than that; of what both depend on, a version that the project has.
    More,
}

/// The workspaces of their own.
const WORKSPACES: &[(&str, May)] = &[
    ("tests/no_std", May::TheSame),
    ("tests/libm_only", May::TheSame),
    ("crates/uchain-ffi", May::TheSame),
    // What reads marks and drives a fuzzer.
    ("tests/no_panic", May::More),
    ("fuzz", May::More),
    // A chip's start-up code.
    ("tests/firmware", May::More),
];

pub(super) fn agree(house: &House) -> Result<Outcome> {
    let ours = locked(&house.root.join("Cargo.lock"))?;
    for &(folder, may) in WORKSPACES {
        let theirs = locked(&house.root.join(folder).join("Cargo.lock"))?;
        let stray = stray(&theirs, &ours, may);
        ensure!(
            stray.is_empty(),
            "{folder}/Cargo.lock has {}, which the project's Cargo.lock has not; to mend it:\n{}",
            stray.join(", "),
            remedy(folder, &stray, may)
        );
        println!(
            "{folder}: {} locked packages, what it shares with the project as in the project",
            theirs.len()
        );
    }
    Ok(Outcome::Passed)
}

/// Packages of a lock file that differ from ours.
fn stray(theirs: &BTreeSet<String>, ours: &BTreeSet<String>, may: May) -> Vec<String> {
    let name = |package: &String| package.split(' ').next().unwrap_or_default().to_owned();
    let known: BTreeSet<String> = ours.iter().map(name).collect();
    let counts = |package: &&String| may == May::TheSame || known.contains(&name(package));
    theirs.difference(ours).filter(counts).cloned().collect()
}

fn remedy(folder: &str, stray: &[String], may: May) -> String {
    match may {
        May::TheSame => {
            format!("cp Cargo.lock {folder}/ && cargo update --workspace --manifest-path {folder}/Cargo.toml")
        }
        May::More => {
            let name = stray.first().and_then(|package| package.split(' ').next()).unwrap_or_default();
            format!(
                "cargo update --manifest-path {folder}/Cargo.toml {name} --precise VERSION, one that Cargo.lock has"
            )
        }
    }
}

/// `name version` of every package of a lock file that comes from a registry.
fn locked(path: &Path) -> Result<BTreeSet<String>> {
    let text = fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(registry_packages(&text))
}

fn registry_packages(lock: &str) -> BTreeSet<String> {
    let field = |block: &str, key: &str| {
        let line = block.lines().find_map(|l| l.strip_prefix(key)?.strip_prefix(" = "))?;
        Some(line.trim_matches('"').to_string())
    };
    let package = |block: &str| {
        field(block, "source")?;
        Some(format!("{} {}", field(block, "name")?, field(block, "version")?))
    };
    lock.split("[[package]]").filter_map(package).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_of_a_registry_are_listed_and_our_own_are_not() {
        let lock = "version = 4\n\n\
                    [[package]]\nname = \"libm\"\nversion = \"0.2.16\"\nsource = \"registry+x\"\n\n\
                    [[package]]\nname = \"uchain-core\"\nversion = \"0.1.0\"\n";
        assert_eq!(registry_packages(lock).into_iter().collect::<Vec<_>>(), ["libm 0.2.16"]);
    }

    #[test]
    fn a_package_that_both_have_has_to_be_one_of_the_projects_versions() {
        let set = |packages: &[&str]| packages.iter().map(ToString::to_string).collect();
        let ours = set(&["libm 0.2.16", "syn 2.0.1", "syn 3.0.1"]);
        let same = set(&["libm 0.2.16", "syn 2.0.1"]);
        assert!(stray(&same, &ours, May::TheSame).is_empty() && stray(&same, &ours, May::More).is_empty());
        let other = set(&["libm 0.2.15", "syn 3.0.1"]);
        for may in [May::TheSame, May::More] {
            assert_eq!(stray(&other, &ours, may), ["libm 0.2.15"], "the control");
        }
        let more = set(&["cortex-m-rt 0.7.7", "libm 0.2.16"]);
        assert_eq!(stray(&more, &ours, May::TheSame), ["cortex-m-rt 0.7.7"]);
        assert!(stray(&more, &ours, May::More).is_empty());
    }
}
