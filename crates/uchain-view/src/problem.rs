//! Why something cannot be done, in words for whoever looks at the page.

use std::fmt::Display;

use serde::Serialize;
use uchain_sim::config::ConfigError;

/// Why something cannot be done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Problem {
    message: String,
    /// Line of the scenario's text, from 1.
    line: Option<usize>,
    /// The key that is wrong, with its tables.
    key: Option<String>,
    /// What may help.
    hint: Option<&'static str>,
}

/// Where a scenario names a file.
const NO_FILES: &str = "a page reads no files by their paths: drop the map's yaml file and its picture on the page, or open the \
                        scenario with `uchain view`";

impl Problem {
    pub(crate) fn new(message: impl Display) -> Self {
        Self { message: message.to_string(), line: None, key: None, hint: None }
    }

    /// Nothing has been opened yet.
    pub(crate) fn nothing_is_open() -> Self {
        Self::new("no flight is open")
    }
}

impl Display for Problem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl From<ConfigError> for Problem {
    fn from(error: ConfigError) -> Self {
        let key = error.key().map(str::to_owned);
        let names_a_file = key
            .as_deref()
            .is_some_and(|key| key.starts_with("map.") && key.split('.').next_back() == Some("file"));
        Self { line: error.line(), hint: names_a_file.then_some(NO_FILES), key, ..Self::new(error) }
    }
}
