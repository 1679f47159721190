//! `uchain merge`: one table of many folders.

use uchain_sim::{
    registry::Registry,
    sweep::folder::{self, Folder},
};

use super::{Merge, summary::SweepSummary};
use crate::{exit::Failure, fly::timed};

pub(crate) fn merge(registry: Registry, asked: &Merge) -> Result<(), Failure> {
    let (totals, wall_s) = timed(|| folder::merge(registry, &asked.folders, &asked.out));
    let totals = totals?;
    let folder = Folder::open(&asked.out)?.with_missions(registry);
    let summary = SweepSummary::new(&folder, &folder.sweep()?, totals, true, wall_s);
    asked.say.result(&summary.json()?, || summary.text())
}
