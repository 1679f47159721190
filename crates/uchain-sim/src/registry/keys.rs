//! What keys are, for programs that write many values under them: where they lead, and what they take.

use super::Registry;
use crate::config::{ConfigError, Document, Source};

/// What the values of a key are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ValueKind {
    /// Whole numbers.
    Whole,
    /// Numbers.
    Number,
    /// Anything else: words, true or false, lists, tables.
    Other,
}

impl Registry {
    /// The steps to where keys lead in a scenario with `sets` written over it: first those of `sets`, then those of
    /// `keys`. Two that lead to the same place are equal, and one that leads into another begins with it.
    ///
    /// # Errors
    /// The text is no TOML, or an assignment has no place to go.
    pub(crate) fn resolve<'k>(
        self,
        source: &Source,
        sets: &[String],
        keys: impl Iterator<Item = &'k str>,
    ) -> Result<Vec<Vec<String>>, ConfigError> {
        let known = self.known();
        let document = Document::parse(source, sets, &known)?;
        let written = document.paths().iter().cloned();
        Ok(written.chain(keys.map(|key| document.resolve(key))).collect())
    }

    /// What the values of a key are, in a scenario that can be read with `sets` written over it: that follows from the
    /// key, not from the values anyone gives it.
    pub(crate) fn kind_of(self, source: &Source, sets: &[String], key: &str) -> ValueKind {
        let takes = |value: &str| {
            let sets: Vec<String> = sets.iter().cloned().chain([format!("{key}={value}")]).collect();
            let known = self.known();
            let document = Document::parse(source, &sets, &known);
            document.is_ok_and(|document| self.mission_of(&document).takes(&document))
        };
        if takes("0.5") {
            ValueKind::Number
        } else if takes("1") {
            ValueKind::Whole
        } else {
            ValueKind::Other
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::builtin;

    #[test]
    fn what_a_key_takes_is_known_whatever_its_value_is() {
        let kind =
            |scenario: &str, key: &str| Registry::default().kind_of(&builtin(scenario).unwrap(), &[], key);
        let chain = [
            ("radio.sigma_db", ValueKind::Number),
            ("duration_s", ValueKind::Number),
            ("chain.uavs", ValueKind::Whole),
            ("pilot.0.follow", ValueKind::Other),
            ("link.base_flow", ValueKind::Other),
            ("chain.base_m", ValueKind::Other),
            ("radio", ValueKind::Other),
            ("preset", ValueKind::Other),
            ("name", ValueKind::Other),
        ];
        for (key, wanted) in chain {
            assert_eq!(kind("corner", key), wanted, "{key}");
        }
        // Written nowhere in the scenario, and absent by default.
        assert_eq!(kind("apartment", "explore.range_m"), ValueKind::Number);
        assert_eq!(kind("apartment", "explore.robots"), ValueKind::Whole);
        assert_eq!(kind("apartment", "explore.arc_ends"), ValueKind::Other);
        assert_eq!(kind("stata", "map.cell_m"), ValueKind::Number, "by its short name");
    }

    #[test]
    fn short_names_lead_where_long_ones_do() {
        let source = builtin("stata").unwrap();
        let sets = ["map.cell_m=0.2".to_owned()];
        let paths = Registry::default()
            .resolve(&source, &sets, ["map . ros . cell_m", "map", "map.ros.file"].into_iter())
            .unwrap();
        assert_eq!(paths[0], paths[1]);
        assert!(paths[0].starts_with(&paths[2]) && !paths[0].starts_with(&paths[3]));
    }
}
