//! `uchain node`: read a log, decide again, write, say.

mod args;

use serde::Serialize;
use uchain_sim::log::{Replay, Summary, template};

use crate::{
    exit::{Failure, OURS},
    output::NODE,
    print,
};

pub(crate) use args::Node;

/// What is left of a replay for programs.
#[derive(Debug, Serialize)]
struct Numbers<'a> {
    log: &'a str,
    #[serde(flatten)]
    summary: &'a Summary,
    notes: &'a [String],
    version: &'static str,
}

pub(crate) fn node(asked: &Node) -> Result<(), Failure> {
    let Some(log) = asked.log.as_ref().filter(|_| !asked.template) else { return print(&template()) };
    let settings = asked.settings()?;
    let replay = Replay::read(log, &settings)?;
    let label = log.display().to_string();
    replay.notes().iter().for_each(|words| asked.say.note(words));
    let (csv, picture) = (replay.csv(), replay.png(&label)?);
    let (summary, notes) = (replay.summary(), replay.notes());
    let numbers = Numbers { log: &label, summary, notes, version: OURS };
    let json = serde_json::to_string_pretty(&numbers)? + "\n";
    let folder = asked.folder(&label)?.spares(std::slice::from_ref(log))?;
    folder.write(&NODE, json.as_bytes(), &picture, &[csv.as_bytes()])?;
    if asked.csv {
        print(&csv)
    } else {
        asked.say.result(&json, || summary.text(&label, &folder.says(&NODE)))
    }
}
