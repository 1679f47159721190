//! Runs of a design in memory, on all processors, and those that several items share.

use std::sync::OnceLock;

use uchain_sim::{
    analyse::Summary,
    config::{Course, Mission, Site, Source, builtin},
    draw::{DrawError, Picture, run_picture},
    record::History,
    run::RunError,
    sweep::{Design, DesignText, Run, Sweep},
};

use super::{PaperError, SEED, laclau2021::Exploration};

/// Runs that several items show, flown when the first one asks.
#[derive(Debug, Default)]
pub struct Flights {
    exploration: OnceLock<Exploration>,
}

impl Flights {
    /// The exploration of Laclau 2021, Fig. 4D to F.
    pub(crate) fn exploration(&self) -> Result<&Exploration, PaperError> {
        if let Some(flown) = self.exploration.get() {
            return Ok(flown);
        }
        let flown = Exploration::fly()?;
        Ok(self.exploration.get_or_init(|| flown))
    }
}

/// What is flown.
pub(crate) struct Asked<'a> {
    pub(crate) source: Source,
    pub(crate) sets: &'a [&'a str],
    pub(crate) vary: &'a [String],
    pub(crate) replicates: u64,
}

/// A compiled-in scenario.
pub(crate) fn scenario(name: &str) -> Source {
    // Names are constants; a wrong one is said by whoever reads the empty text.
    builtin(name).unwrap_or_else(|| written(name, String::new()))
}

/// A scenario of a paper's own.
pub(crate) fn written(name: &str, text: String) -> Source {
    Source { label: format!("<paper {name}>"), text, folder: std::path::PathBuf::new() }
}

/// A run with all that its picture needs.
#[derive(Debug)]
pub(crate) struct Shown {
    course: Course,
    history: History,
    summary: Summary,
}

impl Shown {
    pub(crate) fn new(course: &Course, history: History, summary: &Summary) -> Self {
        Self { course: course.clone(), history, summary: summary.clone() }
    }

    pub(crate) fn picture(&self) -> Result<Picture, DrawError> {
        run_picture(&self.course, &self.history, &self.summary)
    }
}

/// Does something with every run; results by variant, then by replicate. The first run that fails fails all.
fn each<T: Send>(
    asked: Asked<'_>,
    work: impl Fn(&Mission, Run) -> Option<Result<T, RunError>> + Sync,
) -> Result<Vec<Vec<T>>, PaperError> {
    let design = Design::parse(&DesignText { vary: asked.vary.to_vec(), table: None }, "")?;
    let sets = asked.sets.iter().map(|set| (*set).to_owned()).collect();
    let sweep = Sweep::new(asked.source, sets, design, asked.replicates, SEED)?;
    let mut variants: Vec<Vec<T>> = Vec::new();
    for (index, result) in sweep.each(work).into_iter().enumerate() {
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

/// [`each`] run of a chain.
pub(crate) fn chains<T: Send>(
    asked: Asked<'_>,
    work: impl Fn(&Course, Run) -> Result<T, RunError> + Sync,
) -> Result<Vec<Vec<T>>, PaperError> {
    each(asked, |mission, run| match mission {
        Mission::Chain(course) => Some(work(course, run)),
        Mission::Explore(_) => None,
    })
}

/// [`each`] run of an exploration.
pub(crate) fn explorations<T: Send>(
    asked: Asked<'_>,
    work: impl Fn(&Site, Run) -> Result<T, RunError> + Sync,
) -> Result<Vec<Vec<T>>, PaperError> {
    each(asked, |mission, run| match mission {
        Mission::Chain(_) => None,
        Mission::Explore(site) => Some(work(site, run)),
    })
}
