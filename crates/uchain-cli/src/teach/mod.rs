//! Help beyond `--help`: explanations of keys, JSON Schema, hints below errors, shell completions, manual pages.

mod completions;
mod explain;
mod hint;
mod man;

pub(crate) use completions::completions;
pub(crate) use explain::explain;
pub(crate) use hint::hint;
pub(crate) use man::man;

use uchain_sim::registry::Registry;

use crate::{exit::Failure, print};

/// `uchain schema`.
pub(crate) fn schema(registry: Registry) -> Result<(), Failure> {
    print(&(serde_json::to_string_pretty(&registry.schema())? + "\n"))
}
