//! A proof about another version of a dependency proves nothing: the lock files of the mini-workspaces follow
//! the project's.

use std::{collections::BTreeSet, fs, path::Path};

use anyhow::{Context as _, Result, ensure};

use super::{LIBM_ONLY, NO_STD, Outcome};
use crate::house::House;

pub(super) fn agree(house: &House) -> Result<Outcome> {
    let ours = locked(&house.root.join("Cargo.lock"))?;
    for proof in [NO_STD, LIBM_ONLY] {
        let theirs = locked(&house.root.join("tests").join(proof.0).join("Cargo.lock"))?;
        let stray: Vec<_> = theirs.difference(&ours).cloned().collect();
        ensure!(
            stray.is_empty(),
            "tests/{0}/Cargo.lock has {1}, which the project's Cargo.lock has not; to mend it:\n\
             cp Cargo.lock tests/{0}/ && cargo update --workspace --manifest-path tests/{0}/Cargo.toml",
            proof.0,
            stray.join(", ")
        );
        println!("tests/{}: {} locked packages, all as in the project", proof.0, theirs.len());
    }
    Ok(Outcome::Passed)
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
}
