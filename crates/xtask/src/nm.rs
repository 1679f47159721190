//! What a binary asks of the system, read with binutils' `nm`.

use std::{collections::BTreeSet, path::Path, process::Command};

use anyhow::{Result, bail};

use crate::house;

/// The system's mathematics: names without the suffixes `f` and `l`.
const MATHS: &[&str] = &[
    "exp", "exp2", "exp10", "expm1", "log", "log2", "log10", "log1p", "pow", "sin", "cos", "tan", "sincos",
    "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "cbrt", "hypot",
    "fma", "tgamma", "lgamma",
];

/// Whether `nm` is there; a missing one is an error when `CI=true`.
pub(crate) fn is_there() -> Result<bool> {
    let found = Command::new("nm").arg("--version").output().is_ok_and(|o| o.status.success());
    if !found && house::ci() {
        bail!("`nm` is missing: apt-get install binutils");
    }
    Ok(found)
}

/// Functions of the system's mathematics library that a dynamic binary imports.
pub(crate) fn imported_maths(binary: &Path) -> Result<Vec<String>> {
    Ok(imported(binary)?.into_iter().filter(|name| is_maths(name)).collect())
}

/// Everything that a dynamic binary imports.
pub(crate) fn imported(binary: &Path) -> Result<BTreeSet<String>> {
    Ok(names(&house::read(Command::new("nm").args(["-D", "--undefined-only"]).arg(binary))?))
}

/// Functions under the names of the system's mathematics that a program brings itself, for all its code and for
/// whatever it loads.
pub(crate) fn brought_maths(binary: &Path) -> Result<Vec<String>> {
    let listing = house::read(Command::new("nm").args(["--extern-only", "--defined-only"]).arg(binary))?;
    Ok(names(&listing).into_iter().filter(|name| is_maths(name)).collect())
}

/// The names in a listing of `nm`, without their `@GLIBC` versions.
fn names(listing: &str) -> BTreeSet<String> {
    let name_of = |line: &str| {
        // "                 U exp@GLIBC_2.29", "0000000000000000 T fly"
        let mut words = line.split_whitespace().rev();
        let (symbol, kind) = (words.next()?, words.next()?);
        (kind.len() == 1).then(|| symbol.split('@').next().unwrap_or(symbol).to_string())
    };
    listing.lines().filter_map(name_of).collect()
}

/// Whether a symbol belongs to the system's mathematics, in any precision.
fn is_maths(symbol: &str) -> bool {
    let finite = symbol.strip_prefix("__").and_then(|s| s.strip_suffix("_finite")).unwrap_or(symbol);
    let bare = finite.strip_suffix("_r").unwrap_or(finite);
    MATHS.iter().any(|name| bare.strip_prefix(name).is_some_and(|rest| ["", "f", "l"].contains(&rest)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_precision_of_the_systems_mathematics_is_seen_and_nothing_else() {
        for name in ["exp", "expf", "powl", "sincosf", "atan2f", "log1p", "fmaf", "lgamma_r", "__exp_finite"]
        {
            assert!(is_maths(name), "{name}");
        }
        for name in ["exit", "expand", "logger", "power", "memcpy", "floor", "sqrt", "syslog", "sinful"] {
            assert!(!is_maths(name), "{name}");
        }
    }

    #[test]
    fn a_listing_gives_names_without_versions_or_addresses() {
        let listing =
            "                 U exp@GLIBC_2.29\n0000000000000010 T fly\n                 w __gmon_start__\n";
        assert_eq!(names(listing).into_iter().collect::<Vec<_>>(), ["__gmon_start__", "exp", "fly"]);
    }
}
