//! Experiments: a scenario flown with every combination of some values (a factorial design), several replicates of each,
//! on all processors, results in memory.

use std::sync::Arc;

use uchain_sim::{
    config::{Source, builtin},
    draw::{DrawError, Picture},
    mission::{
        Scene,
        chain::{Course, History, Summary, run_picture},
    },
    record::RecordError,
    sweep::{Design, DesignText, Run, Sweep},
};

use super::{PaperError, SEED};

/// A factorial design over one scenario.
pub(crate) struct Experiment<'a> {
    pub(crate) source: Source,
    /// `key=value`, the same in all runs.
    pub(crate) sets: &'a [&'a str],
    /// `key=value,value,…`: every combination is a variant.
    pub(crate) vary: &'a [String],
    /// Runs of each variant; those of the same number share their noise (common random numbers).
    pub(crate) replicates: u64,
}

/// A compiled-in scenario.
pub(crate) fn scenario(name: &str) -> Source {
    // Names are constants; a wrong one is said by whoever reads the empty text.
    builtin(name).unwrap_or_else(|| inline_scenario(name, String::new()))
}

/// A scenario that is not compiled in: its TOML text.
pub(crate) fn inline_scenario(name: &str, text: String) -> Source {
    Source { label: format!("<paper {name}>"), text, folder: std::path::PathBuf::new() }
}

/// A run with the frames that its picture is drawn from.
#[derive(Debug)]
pub(crate) struct RecordedRun {
    course: Arc<Course>,
    history: History,
    summary: Summary,
}

impl RecordedRun {
    pub(crate) fn new(course: &Arc<Course>, history: History, summary: &Summary) -> Self {
        Self { course: course.clone(), history, summary: summary.clone() }
    }

    pub(crate) fn picture(&self) -> Result<Picture, DrawError> {
        run_picture(&self.course, &self.history, &self.summary)
    }
}

/// Does something with every run of a mission of one kind, on all processors; results by variant, then by replicate. The
/// first run that fails fails all.
pub(crate) fn each_run<S: Scene, T: Send>(
    experiment: Experiment<'_>,
    work: impl Fn(&Arc<S>, Run) -> Result<T, RecordError> + Sync,
) -> Result<Vec<Vec<T>>, PaperError> {
    let design = Design::parse(&DesignText { vary: experiment.vary.to_vec(), table: None }, "")?;
    let sets = experiment.sets.iter().map(|set| (*set).to_owned()).collect();
    let sweep = Sweep::new(experiment.source, sets, design, experiment.replicates, SEED)?;
    let mut variants: Vec<Vec<T>> = Vec::new();
    for (index, result) in
        sweep.each(|scene, run| scene.get().map(|scene| work(scene, run))).into_iter().enumerate()
    {
        let run = sweep.run(index as u64);
        let failed = |reason: String| PaperError::Run {
            scenario: sweep.about().name.clone(),
            variant: run.variant,
            replicate: run.replicate,
            reason,
        };
        let result = result.map_err(&failed)?;
        let value = result.ok_or_else(|| failed("a mission of the other kind".to_owned()))??;
        if run.replicate == 0 {
            variants.push(Vec::new());
        }
        if let Some(variant) = variants.last_mut() {
            variant.push(value);
        }
    }
    Ok(variants)
}
