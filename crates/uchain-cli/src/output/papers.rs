//! What `uchain paper` leaves in a folder.

use uchain_papers::ITEMS;

/// The report of what was asked for.
pub(crate) const REPORT: &str = "REPORT.md";
/// Its rows, for programs.
pub(crate) const VERDICTS: &str = "verdicts.csv";

/// Whether a file of this name may be one of these.
pub(crate) fn leaves(name: &str) -> bool {
    let is_item = |stem: &str| {
        ITEMS.iter().any(|item| {
            stem.strip_prefix(item.id).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        })
    };
    name == REPORT
        || name == VERDICTS
        || [".png", ".svg", ".csv", ".md"].iter().any(|ending| name.strip_suffix(ending).is_some_and(is_item))
}
