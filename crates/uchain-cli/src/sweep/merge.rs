//! `uchain merge`: one table of many folders.

use uchain_sim::sweep::folder::{self, Folder};

use super::{Merge, fly::timed, summary::SweepSummary};
use crate::exit::Failure;

pub(crate) fn merge(asked: &Merge) -> Result<(), Failure> {
    let (totals, wall_s) = timed(|| folder::merge(&asked.folders, &asked.out));
    let totals = totals?;
    let folder = Folder::open(&asked.out)?;
    let summary = SweepSummary::new(&folder, &folder.sweep()?, totals, true, wall_s);
    asked.say.result(&summary.json()?, || summary.text())
}
