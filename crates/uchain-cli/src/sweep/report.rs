//! `uchain report`: statistics of a sweep, in tables and pictures.

use uchain_sim::{
    registry::Registry,
    sweep::{
        folder::{Folder, FolderError, TABLE},
        report::{CSV, MARKDOWN, PLOTS, save},
    },
};

use super::Report;
use crate::exit::Failure;

pub(crate) fn report(registry: Registry, asked: &Report) -> Result<(), Failure> {
    let folder = Folder::open(&asked.folder)?.with_missions(registry);
    if !folder.is_complete() {
        let runs = folder.manifest().runs;
        let there = folder.totals(&folder.sweep()?)?.runs;
        return Err(FolderError::NoTable { folder: asked.folder.clone(), there, runs }.into());
    }
    let _alone = folder.lock()?;
    let text = save(&folder, &folder.sweep()?, folder.path())?;
    let at = folder.path().display();
    asked.quiet.report(|| {
        format!("{text}\nfrom {at}/{TABLE}; written: {at}/{MARKDOWN}, {CSV} and the pictures in {PLOTS}\n")
    })
}
