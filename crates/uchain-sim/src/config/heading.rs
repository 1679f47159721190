//! What every scenario says first, whatever is flown in it. Field names are the file's keys.

use serde::{Deserialize, Serialize};

use super::MapConfig;

uchain_core::params! {
    /// What every scenario says first, whatever is flown in it.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Heading {
        /// Short name; it names the output folder.
        #[schemars(schema_with = "super::help::shape::name")]
        pub name: String;
        /// One line that says what happens.
        #[serde(default)]
        pub description: String;
        /// Simulated time (s); a multiple of the tick, 0.05 s.
        pub duration_s: f64, in 0.05..=86_400.0;
        /// Where it happens: one of the tables of [`FORMATS`](crate::map::FORMATS).
        #[schemars(description = format!("Where it happens: one of {}.", crate::map::tables("`")))]
        pub map: MapConfig;
    }
}
