//! Every key of a scenario by its full name, to find the one that was meant.
//!
//! The tables come from the missions; only those that every scenario may have are known here.

use uchain_core::params::Key;

use super::{Heading, diagnose::Choices};
use crate::map::FORMATS;

/// A table's full name and its keys; of a list of tables the first entry stands for all: `pilot.0`. The empty name is
/// the top of the file.
pub type Table = (&'static str, &'static [Key]);

/// What a mission hands in of the keys of its scenarios.
#[derive(Debug, Clone, Copy)]
pub struct Keys {
    /// The table at the top that makes a scenario one of this mission; `None` for the mission of all scenarios that
    /// have no such table.
    pub marker: Option<&'static str>,
    /// Every table with its keys, some in several parts. What is in [`Heading`] and `[map]` may be left out.
    pub tables: &'static [Table],
    /// Keys that files once had, and the one that says it now.
    pub renamed: &'static [(&'static str, &'static str)],
}

/// All keys that a reader knows: those of the missions it was given, and those that every scenario may have.
#[derive(Debug)]
pub struct KnownKeys {
    /// Each key once, with the name of its table.
    keys: Vec<(&'static str, &'static Key)>,
    renamed: Vec<(&'static str, &'static str)>,
}

impl KnownKeys {
    /// The top of the file comes first, then the map, then all other tables, each in the order of the missions. Of a key
    /// that several missions have in one table, the first counts.
    pub fn of(missions: &[&Keys]) -> Self {
        let given = || missions.iter().flat_map(|mission| mission.tables);
        let (top, below) = (given().filter(|(name, _)| name.is_empty()), given());
        // Tables that every scenario may have.
        let maps = FORMATS.iter().map(|format| (format.table, format.keys));
        let shared = std::iter::once(("", Heading::KEYS)).chain(maps);
        let mut keys: Vec<(&str, &Key)> = Vec::new();
        for (table, held) in top.copied().chain(shared).chain(below.copied()) {
            for key in held {
                if !keys.iter().any(|(known, other)| *known == table && other.name == key.name) {
                    keys.push((table, key));
                }
            }
        }
        let renamed = missions.iter().flat_map(|mission| mission.renamed).copied().collect();
        Self { keys, renamed }
    }

    /// Each key once, with the name of its table.
    pub(super) fn keys(&self) -> impl Iterator<Item = (&'static str, &'static Key)> {
        self.keys.iter().copied()
    }

    /// The tables, each once.
    pub(super) fn tables(&self) -> impl Iterator<Item = &'static str> {
        let mut tables: Vec<&'static str> = Vec::new();
        for (table, _) in self.keys() {
            if !tables.contains(&table) {
                tables.push(table);
            }
        }
        tables.into_iter()
    }

    /// The key of a table.
    pub(super) fn key(&self, table: &str, key: &str) -> Option<&'static Key> {
        self.keys().find(|(name, known)| *name == table && known.name == key).map(|(_, known)| known)
    }

    /// The table within `above` that is called so.
    pub(super) fn table_within(&self, above: &str, name: &str) -> Option<&'static str> {
        self.tables()
            .filter_map(|table| table.rsplit_once('.'))
            .find(|it| *it == (above, name))
            .map(|(_, it)| it)
    }

    /// Keys of the tables right within `above`, with their tables.
    pub(super) fn keys_within(&self, above: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
        let is_within = move |table: &str| table.rsplit_once('.').is_some_and(|(it, _)| it == above);
        self.keys().filter(move |(table, _)| is_within(table)).map(|(table, key)| (table, key.name))
    }

    /// The present name of a key that is called otherwise now, by its full name or the last part of it.
    pub(super) fn renamed(&self, key: &str) -> Option<&'static str> {
        let is_it = |old: &str| old == key || old.rsplit('.').next() == Some(key);
        self.renamed.iter().find(|(old, _)| is_it(old)).map(|(_, new)| *new)
    }

    /// Full names of the keys and tables whose last part is `word`.
    pub(super) fn called(&self, word: &str) -> Vec<String> {
        self.all().filter(|(_, name)| *name == word).map(|(table, name)| join(table, name)).collect()
    }

    /// Full name of the one key whose last part is `word` but for a slip of the finger.
    pub(super) fn nearly_called(&self, word: &str) -> Option<String> {
        let names = self.all().map(|(_, name)| name.to_owned()).collect();
        let nearest = Choices::for_word(word, names).nearest?;
        let slips = strsim::damerau_levenshtein(word, &nearest);
        let [only] = <[String; 1]>::try_from(self.called(&nearest)).ok()?;
        (slips <= 1 + word.len() / 8 || nearest.contains(word)).then_some(only)
    }

    /// Table and name of every key and table.
    fn all(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let keys = self.keys().map(|(table, key)| (table, key.name));
        // The tables of a choice are nobody's keys.
        let within = self.tables().filter_map(|table| table.rsplit_once('.'));
        keys.chain(within.filter(|(_, name)| *name != "0"))
    }
}

/// `table.key`; a key of the whole stands alone.
pub(super) fn join(table: &str, key: &str) -> String {
    if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn key(name: &'static str) -> Key {
        Key { name, range: None, doc: "" }
    }

    const fn keys(tables: &'static [Table]) -> Keys {
        Keys { marker: None, tables, renamed: &[] }
    }

    #[test]
    fn what_several_missions_have_is_known_once_and_the_top_of_the_file_comes_first() {
        const ONE: Keys = keys(&[("", &[key("name"), key("one")]), ("one", &[key("robots"), key("only")])]);
        const TWO: Keys = keys(&[("", &[key("two")]), ("two", &[key("robots")]), ("one", &[key("only")])]);
        let known = KnownKeys::of(&[&ONE, &TWO]);
        assert_eq!(known.called("name"), ["name"]);
        assert_eq!(known.called("only"), ["one.only"]);
        assert_eq!(known.called("robots"), ["one.robots", "two.robots"]);
        let tables: Vec<&str> = known.tables().collect();
        let maps: Vec<&str> = FORMATS.iter().map(|format| format.table).collect();
        assert_eq!(tables, [&[""][..], &maps, &["one", "two"]].concat());
        let top = known.keys().take_while(|(table, _)| table.is_empty()).map(|(_, key)| key.name);
        assert_eq!(top.collect::<Vec<_>>(), ["name", "one", "two", "description", "duration_s", "map"]);
        // A mission alone knows nothing of the other.
        assert_eq!(KnownKeys::of(&[&ONE]).called("two"), [""; 0]);
    }
}
