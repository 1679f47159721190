//! `uchain diff`: two recordings side by side.

use std::fmt::Write as _;

use uchain_sim::{record::Comparison, registry::Registry, replay};

use super::{Diff, open};
use crate::exit::Failure;

/// Most keys that are listed.
const MOST_KEYS: usize = 30;

pub(crate) fn diff(registry: Registry, asked: &Diff) -> Result<(), Failure> {
    let (mut here, mut there) = (open(registry, &asked.here)?, open(registry, &asked.there)?);
    let comparison = here.diff(&mut *there).map_err(|error| match error {
        replay::DiffError::Here(cause) => Failure::refused(&asked.here, here.about(), cause),
        replay::DiffError::There(cause) => Failure::refused(&asked.there, there.about(), cause),
    })?;
    let Some(comparison) = comparison else {
        let (here, there) = (here.kind(), there.kind());
        asked.quiet.report(|| format!("one is of {here}, the other of {there}\n"))?;
        return Err(Failure::Differ);
    };

    let mut text = String::new();
    let mut line = |words: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{words}");
    };
    let keys = here.about().differences(there.about());
    for (key, a, b) in keys.iter().take(MOST_KEYS) {
        let shown = |value: &Option<String>| value.clone().unwrap_or_else(|| "not there".to_owned());
        line(&format!("{key}: {} and {}", shown(a), shown(b)));
    }
    if keys.len() > MOST_KEYS {
        line(&format!("… and {} more keys", keys.len() - MOST_KEYS));
    }
    let ticks = (here.ticks(), there.ticks());
    if ticks.0 != ticks.1 {
        line(&format!("ticks: {} and {}", ticks.0, ticks.1));
    }
    let same = comparison.first.is_none() && ticks.0 == ticks.1;
    line(&flights(&comparison));
    asked.quiet.report(|| text)?;
    if same { Ok(()) } else { Err(Failure::Differ) }
}

fn flights(comparison: &Comparison) -> String {
    let Comparison { ticks, differing, first, largest } = comparison;
    let Some(first) = first else {
        return format!("the flights are the same, bit for bit, for {ticks} ticks");
    };
    let mut text = format!(
        "the flights part at {}: {} and {}\n{differing} of {ticks} ticks differ; the largest differences:",
        first.place(),
        first.here,
        first.there
    );
    for (field, found) in largest {
        let size = found.size().map_or_else(|| "-".to_owned(), |size| format!("{size:.6}"));
        // Writing to a String cannot fail.
        let _ =
            write!(text, "\n  {field:14} {size:>12}  {}: {} and {}", found.place(), found.here, found.there);
    }
    text
}
