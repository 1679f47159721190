//! `uchain merge`: one table of many folders.

use uchain_sim::sweep::folder::{self, Folder};

use super::{Merge, conclude::Conclusion, fly::timed};
use crate::exit::Failure;

pub(crate) fn merge(asked: &Merge) -> Result<(), Failure> {
    let (totals, wall_s) = timed(|| folder::merge(&asked.folders, &asked.out));
    let totals = totals?;
    let folder = Folder::open(&asked.out)?;
    let conclusion = Conclusion::new(&folder, &folder.sweep()?, totals, true, wall_s);
    asked.say.result(&conclusion.json()?, || conclusion.text())
}
