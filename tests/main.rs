//! The one integration binary: claims of the whole, a file each.

/// A tick asks for no memory.
mod allocation;
/// A chain keeps its promises, law by law and tunnel by tunnel.
mod chain;
/// Same seed, same bits.
mod determinism;
/// A team explores rooms by scans and messages alone.
mod explore;
/// Explorations end at home, with everything seen and nothing touched.
mod exploring;
/// Values at the ends of their ranges are flown like any other.
mod extremes;
/// The guide for firmware authors tells what the node does.
mod guide;
/// A tick in halves is the tick as a whole.
mod halves;
/// All of a run at once, flown or recorded.
mod kept;
/// The layout for Foxglove names nothing that is not there.
mod layout;
/// A log of a flight is decided again as it was.
mod log;
/// Maps that somebody drew are flown in.
mod maps;
/// What is said of files that are wrong.
mod messages;
/// Maps that were damaged are read or refused.
mod mutants;
/// The papers' figures and tables are what the report says.
mod paper;
/// A flight by hand is a scenario.
mod pilot;
/// What is recorded can be read again, and what is damaged cannot.
mod record;
/// A mission that is flown again in the memory it has flies as a new one.
mod reset;
/// A third mission, of which the library knows nothing.
mod ring;
/// What a recording says is the same wherever it goes: a file, memory, a socket.
mod sinks;
/// Many runs draw from streams of their own.
mod sweep;
/// One folder and one line in the registry are a mission.
mod third_mission;

use std::sync::Arc;

use std::path::PathBuf;

// Digests are held against each other: this program brings its own mathematics.
use uchain_libm as _;
use uchain_sim::{
    config::{Source, builtin},
    mission::chain::{Course, Scenario},
};

/// A compiled-in scenario with keys set.
fn course(name: &str, sets: &[&str]) -> Arc<Course> {
    let source = builtin(name).expect("a compiled-in scenario");
    lay(&source, sets)
}

fn lay(source: &Source, sets: &[&str]) -> Arc<Course> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::parse(source, &sets).unwrap_or_else(|e| panic!("{e}"));
    Course::lay_out(scenario, source).unwrap_or_else(|e| panic!("{e}"))
}

/// The folder of shared data; `None`, said aloud, where it is absent. In the gate absence is a failure.
fn shared_data() -> Option<PathBuf> {
    shared("data")
}

/// The folder of small inputs with their right answers; absent as [`shared_data`] is.
fn shared_cases() -> Option<PathBuf> {
    shared("cases")
}

fn shared(folder: &str) -> Option<PathBuf> {
    let shared = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared").join(folder);
    if shared.is_dir() {
        return Some(shared);
    }
    assert!(
        std::env::var("CI").as_deref() != Ok("true"),
        "{} is missing: the gate needs it",
        shared.display()
    );
    eprintln!("skipped: {} is not there", shared.display());
    None
}
