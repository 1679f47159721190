//! Keys that are written twice, whatever way they are spelled: one of the values would not be flown, and a table that
//! names both would say what is not so.

use std::fmt;

use super::{Design, DesignError};
use crate::{
    config::{Origin, Source, shorten},
    registry::Registry,
};

/// A place that gives a key its values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// `--set radio.sigma_db`, or `column 2, 'radio . sigma_db'`.
    words: String,
    /// The line it stands in, if it is in a table.
    at: Option<Origin>,
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

/// The line two places are about, for the start of a message.
pub(super) fn line(places: &[Written; 2]) -> String {
    let at = places.iter().rev().find_map(|place| place.at.as_ref());
    at.map_or_else(String::new, |at| format!("{at}: "))
}

/// A key with the place it is written in.
struct Entry {
    written: Written,
    path: Vec<String>,
    /// Whether it is set for all variants, to a list: that can only be written as a whole, and entries of it after that.
    is_list: bool,
    is_set: bool,
}

/// Refuses a key that is written twice, and one that lies within another.
pub(crate) fn refuse(
    registry: Registry,
    design: &Design,
    source: &Source,
    sets: &[String],
) -> Result<(), DesignError> {
    let mut paths = registry.resolve(source, sets, design.keys())?.into_iter();
    let mut entries: Vec<Entry> = Vec::new();
    let mut add = |words: String, at: Option<Origin>, list: Option<bool>| {
        let written = Written { words, at };
        let path = paths.next().unwrap_or_default();
        let entry = Entry { written, path, is_list: list == Some(true), is_set: list.is_some() };
        if let Some(error) = entries.iter().find_map(|before| overlap(before, &entry)) {
            return Err(error);
        }
        entries.push(entry);
        Ok(())
    };
    for set in sets {
        let (key, value) = set.split_once('=').unwrap_or((set, ""));
        add(format!("--set {}", shorten(key.trim())), None, Some(value.trim_start().starts_with('[')))?;
    }
    for axis in &design.axes {
        for (place, key) in axis.keys.iter().enumerate() {
            let typed = shorten(&key.typed);
            let words = match axis.head() {
                Some(_) => format!("column {}, '{typed}'", place + 1),
                None => format!("--vary {typed}"),
            };
            add(words, axis.head(), None)?;
        }
    }
    Ok(())
}

/// What is wrong with writing one key after another; `None` if they are apart.
fn overlap(before: &Entry, after: &Entry) -> Option<DesignError> {
    let places = |[first, second]: [&Entry; 2]| Box::new([first.written.clone(), second.written.clone()]);
    if before.path == after.path {
        let key = shorten(&after.path.join("."));
        return Some(DesignError::Twice { key, places: places([before, after]) });
    }
    if after.path.starts_with(&before.path) {
        let is_entry = before.is_set && before.is_list;
        return (!is_entry).then(|| DesignError::Within { places: places([after, before]) });
    }
    let is_within = before.path.starts_with(&after.path);
    is_within.then(|| DesignError::Within { places: places([before, after]) })
}

#[cfg(test)]
mod tests {
    use super::{super::DesignText, *};
    use crate::config::builtin;

    /// What is said of a scenario with sets, a table and varied keys; `ok` if nothing is.
    fn said(scenario: &str, sets: &[&str], table: Option<&str>, vary: &[&str]) -> String {
        let own = |words: &[&str]| words.iter().map(ToString::to_string).collect::<Vec<_>>();
        let text = DesignText { vary: own(vary), table: table.map(str::to_owned) };
        let design = Design::parse(&text, "d.csv").unwrap();
        match refuse(Registry::default(), &design, &builtin(scenario).unwrap(), &own(sets)) {
            Ok(()) => "ok".to_owned(),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn a_key_in_two_spellings_is_written_twice_wherever_they_stand() {
        let spellings =
            ["pilot.0.speed_mps", "pilot.00.speed_mps", "pilot . 0 . speed_mps", "pilot.0.\"speed_mps\""];
        for one in spellings {
            for other in spellings {
                let [set, vary] = [format!("{one}=0.1"), format!("{other}=0.1")];
                let table = format!("{}\n0.1\n", one.replace('"', "'"));
                let doubled = format!("{one},{other}\n0.1,0.1\n").replace('"', "'");
                let all = [
                    said("corner", &[&set, &vary], None, &[]),
                    said("corner", &[&set], None, &[&vary]),
                    said("corner", &[], None, &[&set, &vary]),
                    said("corner", &[&vary], Some(&table), &[]),
                    said("corner", &[], Some(&table), &[&vary]),
                    said("corner", &[], Some(&doubled), &[]),
                ];
                for message in all {
                    assert!(
                        message.contains("pilot.0.speed_mps is written twice: "),
                        "{one} {other}: {message}"
                    );
                }
            }
        }
        assert_eq!(
            said("corner", &[], Some("radio . sigma_db,radio.sigma_db\n1,0\n"), &[]),
            "d.csv:1: radio.sigma_db is written twice: by column 1, 'radio . sigma_db', and by column 2, \
             'radio.sigma_db'; expected one of them"
        );
        assert!(
            said("stata", &["map.file=a"], None, &["map.ros.file=b,c"])
                .contains("map.ros.file is written twice")
        );
        assert_eq!(said("corner", &["pilot.0.speed_mps=0.1"], None, &["pilot.1.speed_mps=0.1"]), "ok");
    }

    #[test]
    fn a_key_within_another_is_refused_in_either_order_but_for_entries_of_a_list_that_is_set() {
        let (outer, inner) = ("radio={sigma_db=1}", "radio.alpha_free=2");
        let all = [
            said("straight", &[outer, inner], None, &[]),
            said("straight", &[inner, outer], None, &[]),
            said("straight", &[outer], None, &[inner]),
            said("straight", &[inner], None, &[outer]),
            said("straight", &[], None, &[outer, inner]),
            said("straight", &[], None, &[inner, outer]),
            said("straight", &[], Some("radio.alpha_free\n2\n"), &[outer]),
            said("straight", &[outer], Some("radio.alpha_free\n2\n"), &[]),
            said("straight", &[], Some("radio,radio.alpha_free\n{sigma_db=1},2\n"), &[]),
            said("straight", &[], Some("radio.alpha_free,radio\n2,{sigma_db=1}\n"), &[]),
        ];
        for message in all {
            assert!(message.contains(" lies within ") && message.contains("radio.alpha_free"), "{message}");
        }
        // A list has to be written before there is an entry to vary; then the entry is what is flown.
        let list = "faults.dead=[{ uav = 0, start_s = 5 }]";
        assert_eq!(said("corner", &[list], None, &["faults.dead.0.start_s=5,100"]), "ok");
        assert!(said("corner", &[], None, &[list, "faults.dead.0.start_s=5,100"]).contains("lies within"));
        assert!(said("corner", &["pilot.0.speed_mps=0.1"], None, &["pilot=[]"]).contains("lies within"));
        // Names that only begin alike are apart.
        assert_eq!(
            said("straight", &["takeoff.launch_signal=raw"], None, &["takeoff.launch=threshold"]),
            "ok"
        );
    }
}
