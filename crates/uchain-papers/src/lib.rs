//! Reproduction of the figures and tables of Laclau 2021 and Kim 2021 that a simulation can give, published values beside
//! ours. No parameter is tuned to make a verdict agree; a disagreement is a result.
//!
//! One file per item: scenario, design, metric, picture, verdict. [`ITEMS`] lists them, [`report`] puts them into words.
//!
//! ```no_run
//! use uchain_libm as _; // equal bits on every system
//! use uchain_papers::{Item, RunCache};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // Items that show the same runs share them through the cache.
//! let cache = RunCache::default();
//! let outcome = Item::find("fig4e").ok_or("it is one of ITEMS")?.regenerate(&cache)?;
//! for row in &outcome.rows {
//!     println!("{}: published {}, ours {}", row.what, row.published, row.ours);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! Everything here is done with the public items of [`uchain_sim`] and [`uchain_core`], as in any study of a user's own.
//! Items take seconds to minutes on all processors; a run's numbers do not depend on how many there are.

#[cfg(test)]
use uchain_libm as _;

mod ablations;
mod experiment;
mod formal;
mod kim2021;
mod laclau2021;
mod outcome;
mod radio;
mod report;

use std::sync::OnceLock;

use uchain_sim::{draw::DrawError, record::RecordError, sweep::DesignError};

use laclau2021::Exploration;

pub use outcome::{Outcome, Page, Row, Table, Verdict};
pub use report::{report, verdict_table};

/// Root seed of all runs.
const SEED: u64 = 1;

/// Why an item could not be regenerated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PaperError {
    /// Its scenario or design cannot be flown.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A run did not come to its end.
    #[error("{scenario}, variant {variant}, replicate {replicate}: {reason}")]
    Run {
        /// What was flown.
        scenario: String,
        /// Its variant.
        variant: u64,
        /// Its replicate.
        replicate: u64,
        /// In words.
        reason: String,
    },
    /// A single run did not come to its end.
    #[error(transparent)]
    Single(#[from] RecordError),
    /// No picture.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

/// Cache of the runs that several items show; they are flown when the first one asks.
#[derive(Debug, Default)]
pub struct RunCache {
    exploration: OnceLock<Exploration>,
}

impl RunCache {
    /// The exploration of Laclau 2021, Fig. 4D to F.
    pub(crate) fn exploration(&self) -> Result<&Exploration, PaperError> {
        if let Some(flown) = self.exploration.get() {
            return Ok(flown);
        }
        let flown = Exploration::fly()?;
        Ok(self.exploration.get_or_init(|| flown))
    }
}

/// A figure or table of a paper.
#[derive(Debug, Clone, Copy)]
pub struct Item {
    /// What it is called by on the command line.
    pub id: &'static str,
    /// What it shows, and where it was published.
    pub title: &'static str,
    run: fn(&RunCache) -> Result<Outcome, PaperError>,
}

impl Item {
    /// Flies it all again. Items that show the same runs share them through the cache.
    ///
    /// # Errors
    /// [`PaperError`].
    pub fn regenerate(&self, cache: &RunCache) -> Result<Outcome, PaperError> {
        (self.run)(cache)
    }

    /// The item of this name.
    ///
    /// ```
    /// assert!(uchain_papers::Item::find("fig4e").is_some());
    /// assert!(uchain_papers::Item::find("fig99").is_none());
    /// ```
    pub fn find(id: &str) -> Option<Self> {
        ITEMS.iter().find(|item| item.id == id).copied()
    }
}

/// All items, in the order of the papers.
pub const ITEMS: &[Item] = &[
    laclau2021::FIG4ABC,
    laclau2021::FIG4D,
    laclau2021::FIG4E,
    laclau2021::FIG4F,
    laclau2021::FIG6,
    kim2021::FIG9,
    kim2021::FIG10,
    kim2021::FIG11,
    kim2021::TABLE1,
    kim2021::COOPERATION,
    formal::FORMAL,
    ablations::ABLATIONS,
    radio::MODELS,
    radio::SHADOWING,
];
