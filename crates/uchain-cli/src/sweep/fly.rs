//! `uchain sweep`: check everything, fly what is missing, make the table.

use std::path::Path;

use uchain_sim::{
    config::Source,
    registry::Registry,
    sweep::{
        self, Design, DesignText,
        folder::{Folder, FolderError, Job, Manifest, Shard, Totals},
        on_threads,
    },
};

use super::{Sweep, progress::Progress, summary::SweepSummary};
use crate::{
    exit::Failure,
    fly::timed,
    monitor::{interrupted, listen_for_interrupt},
};

pub(crate) fn fly(registry: Registry, asked: &Sweep) -> Result<(), Failure> {
    let source = Source::find(&asked.scenario)?;
    let text = DesignText::read(asked.vary.clone(), asked.design.as_deref())?;
    let label = asked.design.as_ref().map(|path| path.display().to_string()).unwrap_or_default();
    let design = Design::parse(&text, &label)?;
    let scenes = source.folder.clone();
    let sweep =
        sweep::Sweep::of(registry, source, asked.sets.set.clone(), design, asked.replicates, asked.seed)?;
    listen_for_interrupt();
    let (done, wall_s) = timed(|| on_threads(asked.threads, || work(asked, &sweep, &scenes)));
    let (folder, sweep, totals, is_complete) = done.map_err(FolderError::from)??;
    let summary = SweepSummary::new(&folder, &sweep, totals, is_complete, wall_s);
    asked.say.result(&summary.json()?, || summary.text())
}

/// Everything that takes long; says in the end whether all runs are there.
fn work(
    asked: &Sweep,
    sweep: &sweep::Sweep,
    scenes: &Path,
) -> Result<(Folder, sweep::Sweep, Totals, bool), Failure> {
    let walls = sweep.check()?;
    if interrupted() {
        return Err(Failure::Interrupted);
    }
    let folder = Folder::begin(&asked.out, Manifest::of(sweep, walls), scenes, asked.resume)?
        .with_missions(sweep.registry());
    // From here on as the folder has it: a row says nothing of where the files lie that were read.
    let sweep = folder.sweep()?;
    match complete(asked, &folder, &sweep) {
        Ok((totals, is_complete)) => Ok((folder, sweep, totals, is_complete)),
        Err(error) => Err(Failure::Incomplete(error)),
    }
}

/// Flies what is missing; says in the end whether all runs are there, or only those of a shard.
fn complete(asked: &Sweep, folder: &Folder, sweep: &sweep::Sweep) -> Result<(Totals, bool), FolderError> {
    let shard = asked.shard.unwrap_or(Shard { number: 1, of: 1 });
    let progress = Progress::new(sweep.runs() / shard.of, asked.say.progress());
    let flown = folder.fly(sweep, Job { shard, record: asked.record.into(), watch: &progress });
    progress.clear();
    flown?;
    match folder.finish(sweep)? {
        Some(totals) => Ok((totals, true)),
        None => folder.totals(sweep).map(|totals| (totals, false)),
    }
}
