//! Names of result folders (sanitized file names): valid on every file system, and another one for every input file.

use std::{fs, path::Path};

use twox_hash::XxHash64;
use uchain_sim::config::builtin;

/// Longest name (bytes), before seed and hash: some file systems take 143 bytes, and letters are up to four.
const LONGEST_BYTES: usize = 96;
/// Names that belong to devices on Windows, in any case.
const RESERVED: [&str; 4] = ["con", "prn", "aux", "nul"];
/// And those that do so with a digit behind them.
const NUMBERED: [&str; 2] = ["com", "lpt"];

/// Of what was asked for: a built-in scenario goes by its name, a file by its own, whatever the scenario in it says it
/// is called.
pub(crate) fn folder_name(asked: &str) -> String {
    if builtin(asked).is_some() {
        return asked.to_owned();
    }
    plain(&Path::new(asked).file_stem().unwrap_or_default().to_string_lossy())
}

/// Letters and digits of all scripts stay, and so do - and _; a space becomes a -, so that nobody has to quote. Where
/// anything else was, or the name is too long or reserved, a hash of the whole name tells it from its likes.
fn plain(stem: &str) -> String {
    let mut name = String::new();
    let spaceless = stem.replace(' ', "-");
    for c in spaceless.chars() {
        let is_plain = c.is_alphanumeric() || c == '_' || c == '-';
        name.push(if is_plain { c } else { '-' });
        if name.len() > LONGEST_BYTES {
            name.pop();
            break;
        }
    }
    if name == spaceless && !name.is_empty() && !is_reserved(&name) { name } else { hashed(&name, stem) }
}

fn is_reserved(name: &str) -> bool {
    let name = name.to_lowercase();
    let is_digit = |rest: &str| rest.chars().count() == 1 && rest.chars().all(char::is_numeric);
    RESERVED.contains(&name.as_str())
        || NUMBERED.iter().any(|device| name.strip_prefix(device).is_some_and(is_digit))
}

fn hashed(name: &str, whole: &str) -> String {
    format!("{name}-{:08x}", XxHash64::oneshot(0, whole.as_bytes()) as u32)
}

/// The name with an ending, for a folder within `above`. Where a folder stands there whose name differs in case only,
/// another name: some disks would take the two for one.
pub(super) fn beside_others(above: &Path, name: &str, ending: &str) -> String {
    let above = if above.as_os_str().is_empty() { Path::new(".") } else { above };
    let entries = fs::read_dir(above).into_iter().flatten().flatten();
    let names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    let wanted = format!("{name}{ending}");
    let is_alike = |there: &String| there.to_lowercase() == wanted.to_lowercase();
    if names.contains(&wanted) || !names.iter().any(is_alike) {
        wanted
    } else {
        format!("{}{ending}", hashed(name, name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_goes_by_its_name_and_a_file_by_its_own() {
        for (asked, name) in [
            ("corner", "corner"),
            ("mine.toml", "mine"),
            ("./far/mine.toml", "mine"),
            ("old hall.yaml", "old-hall"),
            ("карта.png", "карта"),
            ("schéma_2-b.yaml", "schéma_2-b"),
            ("地図.map", "地図"),
        ] {
            assert_eq!(folder_name(asked), name);
        }
    }

    #[test]
    fn names_that_no_disk_or_not_every_disk_takes_get_a_hash_that_tells_them_apart() {
        let long = |end: &str| "ш".repeat(300) + end + ".toml";
        let files = [
            "my.map.png",
            "my_map?.png",
            "my-map\t.png",
            "floor.v2.toml",
            "con.toml",
            "NUL.toml",
            "Com3.toml",
            "lpt¹.yaml",
            ".toml",
            "a\u{301}.toml",
            "a\u{300}.toml",
            "\u{202e}gnp.toml",
            &long("a"),
            &long("b"),
        ];
        let mut names: Vec<String> = files.iter().map(|file| folder_name(file)).collect();
        for name in &names {
            let (_, hash) = name.rsplit_once('-').unwrap();
            assert!(hash.len() == 8 && hash.chars().all(|c| c.is_ascii_hexdigit()), "{name}");
            assert!(name.chars().all(|c| c.is_alphanumeric() || c == '-' || c == '_'), "{name}");
            assert!(!is_reserved(name) && name.len() + "-s18446744073709551615".len() <= 143, "{name}");
        }
        names.sort();
        names.dedup();
        assert_eq!(names.len(), files.len());
        assert_eq!(folder_name("context.toml"), "context", "only whole names are reserved");
    }

    #[test]
    fn a_name_that_differs_from_one_that_is_there_in_case_only_becomes_another_one() {
        let above = tempfile::tempdir().unwrap();
        let beside = |name: &str| beside_others(above.path(), name, "-s1");
        assert_eq!(beside("Mine"), "Mine-s1");
        fs::create_dir(above.path().join("mine-s1")).unwrap();
        let other = beside("Mine");
        assert!(other.starts_with("Mine-") && other.ends_with("-s1") && other.len() > 12, "{other}");
        assert_eq!(beside("mine"), "mine-s1");
        fs::create_dir(above.path().join("Mine-s1")).unwrap();
        assert_eq!(beside("Mine"), "Mine-s1", "a folder that is there keeps its name");
    }
}
