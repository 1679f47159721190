//! `cargo xtask bench`: all benchmarks, one table, ratios first; and instruction counts to review.

mod count;
mod table;

use anyhow::Result;

use crate::house::{House, run};

/// What to measure.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Bench {
    /// Only benchmarks whose name matches; all without.
    pub(crate) filter: Option<String>,
    /// Write the instruction counts into the reviewed file.
    pub(crate) accept: bool,
}

/// Times first; a filter leaves the counts out.
pub(crate) fn bench(house: &House, asked: &Bench) -> Result<()> {
    if !asked.accept {
        let begun = crate::system_now();
        let mut command = house.cargo("bench --locked --bench main --");
        command.args(&asked.filter);
        run(&mut command)?;
        print!("\n{}", table::table(&table::read(&house.target.join("criterion"), begun)?));
    }
    if asked.filter.is_none() {
        count::compare(house, asked.accept)?;
    }
    Ok(())
}
