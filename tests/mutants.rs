//! Maps that people really have, damaged: each mutant is read or refused in words, and soon.
//!
//! `UCHAIN_MUTANTS=10000` makes so many of them; a few are made in any case. What took longest is printed: `--nocapture`.

use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use uchain_sim::config::{MapConfig, kind_of_map};

/// How many are made unless the environment says otherwise.
const FEW: usize = 120;
/// Longest that one may take to read: the largest maps of cells, with assertions, on a busy machine.
const LONGEST: Duration = Duration::from_secs(10);

/// Numbers of a generator that needs no crate: `SplitMix64`.
struct Draw(u64);

impl Draw {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % count.max(1) as u64) as usize
    }
}

/// Writes over, cuts off, cuts out, repeats or puts in; once to four times.
fn mutate(bytes: &mut Vec<u8>, draw: &mut Draw) {
    const WORDS: [&[u8]; 8] = [
        b"NaN",
        b"-1",
        b"1e309",
        b"4294967295",
        b"\xff\xff\xff\xff",
        b"\0\0\0\0",
        b"\xef\xbb\xbf",
        b"\n\n\t,;",
    ];
    for _ in 0..=draw.below(4) {
        // Heads hold the lengths that readers trust.
        let within = if draw.below(2) == 0 { bytes.len().min(200) } else { bytes.len() };
        let at = draw.below(within);
        let end = bytes.len().min(at + 1 + draw.below(64));
        match draw.below(6) {
            0 if at < bytes.len() => bytes[at] = draw.below(256) as u8,
            1 if at < bytes.len() => bytes[at] ^= 1 << draw.below(8),
            2 => bytes.truncate(at),
            3 => drop(bytes.splice(at..end, [])),
            4 => {
                let piece: Vec<u8> = bytes[at..end].repeat(1 + draw.below(20));
                bytes.splice(at..at, piece);
            }
            _ => {
                let word = WORDS[draw.below(WORDS.len())];
                bytes.splice(at..(at + draw.below(6)).min(end), word.iter().copied());
            }
        }
    }
}

/// Files below a folder, in order.
fn below(folder: &Path, files: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() { below(&path, files) } else { files.push(path) }
    }
}

fn config(kind: &str, name: &str) -> MapConfig {
    let cell = if name.ends_with("pgm") || name.ends_with("png") { "cell_m = 0.05\n" } else { "" };
    toml::from_str(&format!("[{kind}]\nfile = \"{name}\"\n{cell}")).unwrap()
}

#[expect(clippy::disallowed_methods, reason = "that nothing hangs is a matter of this machine's time")]
fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}

#[test]
fn maps_that_were_damaged_are_read_or_refused_in_words_and_soon() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if !data.is_dir() {
        assert!(std::env::var_os("CI").is_none_or(|ci| ci != "true"), "{} is absent", data.display());
        eprintln!("skipped: {} is absent", data.display());
        return;
    }
    let mut files = Vec::new();
    for folder in ["caves", "maps", "subt"] {
        below(&data.join(folder), &mut files);
    }
    files.retain(|file| kind_of_map(file).is_some());
    assert!(files.len() > 25, "{files:?}");
    let wanted = std::env::var("UCHAIN_MUTANTS").map_or(FEW, |text| text.parse().unwrap());
    let scratch = tempfile::tempdir().unwrap();
    let (mut read, mut refused, mut longest) = (0, 0, (Duration::ZERO, String::new()));
    for (index, file) in files.iter().enumerate() {
        let name = file.file_name().unwrap().to_str().unwrap();
        let kind = kind_of_map(file).unwrap();
        let whole = std::fs::read(file).unwrap();
        // What the file names beside itself.
        for picture in ["png", "pgm"] {
            let beside = file.with_extension(picture);
            if beside.is_file() && beside != *file {
                std::fs::copy(&beside, scratch.path().join(beside.file_name().unwrap())).unwrap();
            }
        }
        let (original, took) = timed(|| config(kind, name).lay(file.parent().unwrap(), [0.0; 2]));
        let outcome = original.map_or_else(|error| error.to_string(), |_| "read".to_owned());
        println!("{kind} {name}: {took:?}, {outcome}");
        for mutant in 0..wanted.div_ceil(files.len()) {
            let mut bytes = whole.clone();
            mutate(&mut bytes, &mut Draw((index * 1_000_000 + mutant) as u64));
            std::fs::write(scratch.path().join(name), &bytes).unwrap();
            let (laid, took) = timed(|| config(kind, name).lay(scratch.path(), [0.0; 2]));
            match laid {
                Ok(_) => read += 1,
                Err(error) => {
                    assert!(error.to_string().len() < 2000, "{name}, mutant {mutant}: {error}");
                    refused += 1;
                }
            }
            assert!(took < LONGEST, "{name}, mutant {mutant}: {took:?}");
            if took > longest.0 {
                longest = (took, format!("{name}, mutant {mutant}"));
            }
        }
    }
    println!("{read} read, {refused} refused, {:?} at most: {}", longest.0, longest.1);
    assert!(read > 0 && refused > 0, "{read} read, {refused} refused: both must happen");
}
