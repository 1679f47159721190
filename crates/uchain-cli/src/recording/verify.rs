//! `uchain verify`: fly a recording again.

use uchain_sim::{
    record::mcap::{AnyRecording, End},
    replay,
};

use super::{Verify, open};
use crate::exit::Failure;

/// This version.
const OURS: &str = env!("CARGO_PKG_VERSION");

pub(crate) fn verify(asked: &Verify) -> Result<(), Failure> {
    let (verdict, about) = match open(&asked.file)? {
        AnyRecording::Chain(mut recording) => (replay::verify(&mut recording), recording.about),
        AnyRecording::Explore(mut recording) => (replay::verify_exploration(&mut recording), recording.about),
    };
    let verdict = verdict.map_err(|cause| Failure::Recording { file: asked.file.clone(), cause })?;

    let theirs = &about.version;
    let versions = if theirs == OURS {
        String::new()
    } else {
        format!("recorded by uchain {theirs}, flown by {OURS}\n")
    };
    if let Some(first) = verdict.first {
        let (place, here, there) = (first.place(), first.here, first.there);
        let said = format!("{versions}differs at {place}: {here} recorded, {there} flown\n");
        asked.quiet.report(|| said)?;
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
    asked.quiet.report(|| format!("{versions}{said}\n"))
}
