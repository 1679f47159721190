//! `uchain verify`: fly a recording again.

use uchain_sim::{
    mathematics::Foreign,
    record::mcap::{About, End},
    registry::Registry,
};

use super::{Verify, open};
use crate::exit::{Failure, OURS};

pub(crate) fn verify(registry: Registry, asked: &Verify) -> Result<(), Failure> {
    let mut recording = open(registry, &asked.file)?;
    let about = recording.about().clone();
    // Reasons come first, whatever is found.
    asked.quiet.report(|| reasons(&about))?;
    let verdict = recording.verify().map_err(|cause| Failure::refused(&asked.file, &about, cause))?;

    if let Some(first) = verdict.first {
        let (place, here, there) = (first.place(), first.here, first.there);
        asked.quiet.report(|| format!("differs at {place}: {here} recorded, {there} flown\n"))?;
        return Err(Failure::Differ);
    }
    let (ticks, of) = (verdict.ticks, verdict.of);
    let said = match verdict.end {
        _ if ticks == of => format!("all {ticks} ticks are the same, bit for bit"),
        Some(End::Whole) => format!("the same, bit for bit, for the {ticks} ticks of {of} it was flown"),
        _ => format!(
            "the same, bit for bit, for the {ticks} ticks of {of} that were recorded; the file is cut short"
        ),
    };
    asked.quiet.report(|| format!("{said}\n"))
}

/// Why bits may differ without anybody's fault, a line each.
fn reasons(about: &About) -> String {
    let version = Some(&about.version).filter(|theirs| *theirs != OURS);
    let version = version.map(|theirs| format!("recorded by uchain {theirs}, flown by {OURS}\n"));
    let mathematics = Foreign::of(about.mathematics.as_deref()).map(|foreign| format!("{foreign}\n"));
    version.into_iter().chain(mathematics).collect()
}
