//! The slow ways that tests compare with are in no program that is released.

use anyhow::{Context as _, Result, ensure};

use super::Outcome;
use crate::house::{House, read};

/// The feature of the simulation that brings them.
const ORACLES: &str = "oracles";

pub(super) fn leave_oracles_out(house: &House) -> Result<Outcome> {
    let with = |edges: &str| -> Result<Vec<String>> {
        // As a bare `cargo build` resolves them: for the default members.
        let tree = format!("tree --locked --edges {edges} --prefix none --format {{p}}|{{f}}");
        features(&read(&mut house.cargo(&tree))?, "uchain-sim").context("no uchain-sim in the tree")
    };
    let released = with("normal")?;
    ensure!(!released.iter().any(|on| on == ORACLES), "`{ORACLES}` is on in what `cargo build` builds");
    println!("released: {}", released.join(" "));
    let tested = with("normal,dev")?;
    ensure!(tested.iter().any(|on| on == ORACLES), "control: `{ORACLES}` is not on in tests either");
    println!("control, tests: {}", tested.join(" "));
    Ok(Outcome::Passed)
}

/// The features of a package in a listing of `name version|feature,feature`.
fn features(listing: &str, package: &str) -> Option<Vec<String>> {
    let line = listing.lines().find(|line| line.split(' ').next() == Some(package))?;
    let (_, features) = line.split_once('|')?;
    // A package that was listed before ends with a mark.
    let features = features.trim_end_matches("(*)").trim();
    Some(features.split(',').map(str::to_owned).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_those_of_the_package_asked_for() {
        let listing =
            "uchain v0.1.0 (/x)|\nuchain-simple v1.0.0|oracles\nuchain-sim v0.1.0 (/x y)|default,draw (*)\n";
        assert_eq!(features(listing, "uchain-sim").unwrap(), ["default", "draw"]);
        assert_eq!(features(listing, "uchain-core"), None);
    }
}
