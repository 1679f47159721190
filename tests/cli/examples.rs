//! Every example that README, docs and help show: each command line is run, each option and key looked up, each field
//! of a table found in the file it is said to be in, and each link to another page followed.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    os::unix::fs::symlink,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use serde_json::Value;
use tempfile::TempDir;

use crate::{folder, install_script, shared_cases, stderr, stdout, uchain};

/// A text that users read.
struct Text {
    name: String,
    text: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// README and every page in docs and the folders in it, named by the path from the root.
fn documents() -> Vec<Text> {
    fn read(root: &Path, page: &str, into: &mut Vec<Text>) {
        let path = root.join(page);
        if path.is_dir() {
            for entry in fs::read_dir(&path).unwrap() {
                read(root, &format!("{page}/{}", entry.unwrap().file_name().to_str().unwrap()), into);
            }
        } else if path.extension().is_some_and(|end| end == "md") {
            into.push(Text { name: page.to_owned(), text: fs::read_to_string(path).unwrap() });
        }
    }
    let mut documents = Vec::new();
    for page in ["README.md", "docs"] {
        read(&root(), page, &mut documents);
    }
    documents.sort_by(|a, b| a.name.cmp(&b.name));
    documents
}

/// Help of the whole and of every command.
fn helps() -> Vec<Text> {
    let here = folder();
    let help = |args: &[&str]| {
        let output = uchain(here.path(), args);
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", stderr(&output));
        Text { name: args.join(" "), text: stdout(&output).to_owned() }
    };
    let whole = help(&["--help"]);
    let lines = whole.text.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = lines.take_while(|line| !line.is_empty()).filter_map(|line| line.split_whitespace().next());
    let names: Vec<String> = names.filter(|name| *name != "help").map(str::to_owned).collect();
    let nested = crate::teach::NESTED.map(|[of, name]| help(&[of, name, "--help"]));
    [whole].into_iter().chain(names.iter().map(|name| help(&[name, "--help"]))).chain(nested).collect()
}

/// Command lines that belong together: what one leaves the next may read.
struct Block {
    name: String,
    lines: Vec<String>,
}

/// The blocks of a page that are fenced as `bash`.
fn fenced(page: &Text) -> Vec<Block> {
    let mut blocks = Vec::new();
    for part in page.text.split("\n```bash\n").skip(1) {
        let body = part.split("\n```").next().unwrap();
        let lines = body.lines().map(|line| line.split(" #").next().unwrap().trim().to_owned());
        let name = format!("{}, block {}", page.name, blocks.len() + 1);
        blocks.push(Block { name, lines: lines.filter(|line| !line.is_empty()).collect() });
    }
    blocks
}

/// The examples of a help text: a line each, what it does behind two spaces or more.
fn examples(help: &Text) -> Block {
    let lines = help.text.lines().skip_while(|line| *line != "Examples:").skip(1);
    let lines = lines.take_while(|line| !line.is_empty()).map(|line| line.trim().split("  ").next().unwrap());
    Block { name: help.name.clone(), lines: lines.map(str::to_owned).collect() }
}

/// What stands in for other programs, and for ours where an example would take minutes.
const STANDS_IN: &[(&str, &str)] = &[
    (
        "uchain",
        r#"case "$1" in
            run) exec "$UCHAIN" "$@" --set duration_s=2 ;;
            sweep) exec "$UCHAIN" "$@" --set duration_s=0.5 ;;
            paper)
                # Minutes long: as far as the folder, which is not to be written to.
                words=("$@"); out=
                for ((i = 0; i < $#; i++)); do [ "${words[i]}" = --out ] && out="${words[i + 1]}"; done
                [ "$out" ] || { out=paper; words+=(--out paper); }
                mkdir -p "$out"; echo dear > "$out/letter.txt"
                said=$("$UCHAIN" "${words[@]}" 2>&1); code=$?
                rm "$out/letter.txt"
                [ $code = 2 ] && [[ "$said" == *"holds something else (letter.txt)"* ]] || { echo "$said" >&2; exit 1; } ;;
            *) exec "$UCHAIN" "$@" ;;
        esac"#,
    ),
    (
        "cargo",
        r#"case "$*" in
            "run --release -- "*) shift 3; exec uchain "$@" ;;
            "run --release --example "*) test -f "$PROJECT/examples/$4.rs" ;;
            "install --path "*) test -f "$PROJECT/$3/src/main.rs" ;;
            "doc --open -p "*) test -f "$PROJECT/crates/$4/src/lib.rs" ;;
            "xtask test" | "xtask bench" | "xtask maps" | "xtask firmware" | "xtask web" | "xtask web --dist") ;;
            *) echo "cargo $*: what is that?" >&2; exit 1 ;;
        esac"#,
    ),
    (
        "pip",
        r#"case "$*" in
            "install ./"*) test -f "$PROJECT/$2/pyproject.toml" ;;
            *) echo "pip $*: what is that?" >&2; exit 1 ;;
        esac"#,
    ),
    ("jq", r#"asked="$ASKED/$(date +%N)$$"; printf '%s ' "$@" > "$asked.words"; cat > "$asked.json""#),
    ("man", "cat > /dev/null"),
    ("less", r#"test -s "$1""#),
    ("rerun", r#"test -s "$1""#),
    // In the place of a browser: a page is there, and there are no more examples of flights than pages with one.
    ("xdg-open", r#"[[ "$1" == /* ]] && grep -q "<main>" "$1""#),
];

/// A place to run examples in.
struct Bench {
    root: TempDir,
    blocks: usize,
}

impl Bench {
    fn new() -> Self {
        let root = folder();
        let bin = root.path().join("bin");
        for name in ["bin", "home/.zfunc", "home/.config/fish/completions", "asked", "fixtures"] {
            fs::create_dir_all(root.path().join(name)).unwrap();
        }
        for (name, script) in STANDS_IN {
            install_script(&format!("#!/usr/bin/env bash\n{script}\n"), &bin.join(name));
        }
        if let Some(cases) = shared_cases() {
            symlink(fs::canonicalize(cases.join("..")).unwrap(), root.path().join("shared")).unwrap();
        }
        fs::write(root.path().join("page.html"), crate::view::PAGE).unwrap();
        let bench = Self { root, blocks: 0 };
        bench.lay_fixtures();
        bench
    }

    /// Files that examples speak of and that no example makes.
    fn lay_fixtures(&self) {
        let here = self.root.path().join("fixtures");
        let ok = |line: &str| {
            let output = self.bash(&here, line);
            assert!(output.status.success(), "{line}: {}", stderr(&output));
        };
        ok("uchain show corner > mine.toml");
        ok("uchain node --template > log.csv");
        fs::write(here.join("design.csv"), "chain.uavs,radio.sigma_db\n2,1\n3,\n").unwrap();
        ok("uchain run corner --quiet --out runs/corner-s1 && cp -r runs/corner-s1 runs/corner-s2");
        ok("for name in run old before after a b; do cp runs/corner-s1/run.mcap $name.mcap; done");
        ok("uchain sweep corner --replicates 100 --quiet --out sweeps/corner");
        ok("for i in 1 2 3 4; do uchain sweep corner --replicates 8 --shard $i/4 --quiet --out part$i; done");
        map(&here, "map", &[[1.5, 0.0], [40.0, 0.0], [40.0, 12.5]]);
        map(&here, "basement", &[[-50.15, 34.03], [-3.0, 25.7]]);
        map(&here, "floor", &[[0.0, 0.0], [10.0, 0.0], [10.0, 8.0], [0.0, 8.0]]);
        fs::create_dir(here.join("examples")).unwrap();
        let maps = fs::canonicalize(root()).unwrap().join("examples/maps");
        symlink(maps, here.join("examples/maps")).unwrap();
        let radio = fs::canonicalize(root()).unwrap().join("examples/radio");
        for name in ["walk.csv", "theirs.csv", "poses.csv", "anchors.csv"] {
            fs::copy(radio.join(name), here.join(name)).unwrap();
        }
        symlink(radio, here.join("examples/radio")).unwrap();
        let row = ".".repeat(100) + "\n";
        fs::write(
            here.join("city.map"),
            format!("type octile\nheight 100\nwidth 100\nmap\n{}", row.repeat(100)),
        )
        .unwrap();
    }

    /// Runs the lines of a block one after the other; what went wrong.
    fn run(&mut self, block: &Block) -> Vec<String> {
        self.blocks += 1;
        let here = self.root.path().join(format!("block{}", self.blocks));
        fs::create_dir(&here).unwrap();
        let makes = |name: &str| block.lines.iter().any(|line| line.contains(&format!("--out {name}")));
        let fixtures = self.root.path().join("fixtures");
        for name in [
            "mine.toml",
            "design.csv",
            "log.csv",
            "city.map",
            "walk.csv",
            "theirs.csv",
            "poses.csv",
            "anchors.csv",
            "runs",
            "sweeps",
            "part1",
            "part2",
            "part3",
            "part4",
            "examples",
        ]
        .iter()
        .chain(&["map.yaml", "map.pgm", "basement.yaml", "basement.pgm", "floor.yaml", "floor.pgm"])
        .chain(&["run.mcap", "old.mcap", "before.mcap", "after.mcap", "a.mcap", "b.mcap"])
        .filter(|name| !makes(name))
        {
            let copied = Command::new("cp").arg("-r").arg(fixtures.join(name)).arg(&here).status().unwrap();
            assert!(copied.success(), "{name}");
        }
        let mut wrong = Vec::new();
        for line in &block.lines {
            if line.ends_with(" stata") && !self.root.path().join("shared").exists() {
                eprintln!("skipped, its map is not there: {line}");
                continue;
            }
            let output = self.bash(&here, line);
            if !output.status.success() {
                wrong.push(format!("{}: {line}\n{}", block.name, String::from_utf8_lossy(&output.stderr)));
            }
        }
        wrong
    }

    fn bash(&self, here: &Path, line: &str) -> Output {
        let bench = self.root.path();
        let path = format!("{}:{}", bench.join("bin").display(), std::env::var("PATH").unwrap());
        let mut bash = Command::new("bash");
        bash.args(["--noprofile", "--norc", "-eu", "-o", "pipefail", "-c", line]).current_dir(here);
        bash.env("PATH", path).env("HOME", bench.join("home")).env("ASKED", bench.join("asked"));
        bash.env("PROJECT", fs::canonicalize(root()).unwrap());
        bash.env("UCHAIN_PAGE", bench.join("page.html"));
        bash.env("UCHAIN", env!("CARGO_BIN_EXE_uchain")).env("fpath", "").stdin(Stdio::null());
        bash.output().unwrap()
    }

    /// Fields that jq was asked for and that were not in what it was given.
    fn fields_not_there(&self) -> Vec<String> {
        let mut missing = Vec::new();
        let entries =
            fs::read_dir(self.root.path().join("asked")).unwrap().map(|entry| entry.unwrap().path());
        for words in entries.filter(|path| path.extension().is_some_and(|end| end == "words")) {
            let json: Value =
                serde_json::from_slice(&fs::read(words.with_extension("json")).unwrap()).unwrap();
            let mut keys = BTreeSet::new();
            keys_of(&json, &mut keys);
            let asked = fs::read_to_string(&words).unwrap();
            let names = asked.split(|c: char| !(c.is_alphanumeric() || "._".contains(c)));
            let fields = names.filter_map(|name| name.strip_prefix('.')).flat_map(|path| path.split('.'));
            let fields = fields.filter(|field| !field.is_empty() && !keys.contains(*field));
            missing.extend(fields.map(|field| format!("jq {asked}: {field} is not there")));
        }
        missing
    }
}

fn keys_of(value: &Value, into: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (key, value) in fields {
                into.insert(key.clone());
                keys_of(value, into);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| keys_of(value, into)),
        _ => {}
    }
}

/// A ROS map: rock, and free ground within a metre of a line.
fn map(here: &Path, name: &str, line: &[[f64; 2]]) {
    const CELL_M: f64 = 0.1;
    let ends = |axis: usize| {
        let at = line.iter().map(|point| point[axis]);
        (at.clone().fold(f64::INFINITY, f64::min) - 2.0, at.fold(f64::NEG_INFINITY, f64::max) + 2.0)
    };
    let ((left_m, right_m), (bottom_m, top_m)) = (ends(0), ends(1));
    let cells = |length_m: f64| (length_m / CELL_M).ceil() as usize;
    let (width, height) = (cells(right_m - left_m), cells(top_m - bottom_m));
    let is_free = |x_m: f64, y_m: f64| {
        line.windows(2).any(|pair| {
            let (along, from) =
                ([pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]], [x_m - pair[0][0], y_m - pair[0][1]]);
            let length2 = along[0] * along[0] + along[1] * along[1];
            let share = ((along[0] * from[0] + along[1] * from[1]) / length2).max(0.0);
            let share = share.min(1.0);
            let off = [from[0] - share * along[0], from[1] - share * along[1]];
            off[0] * off[0] + off[1] * off[1] < 1.0
        })
    };
    let mut picture = format!("P5\n{width} {height}\n255\n").into_bytes();
    for row in 0..height {
        for column in 0..width {
            let (x_m, y_m) = (left_m + (column as f64 + 0.5) * CELL_M, top_m - (row as f64 + 0.5) * CELL_M);
            picture.push(if is_free(x_m, y_m) { 254 } else { 0 });
        }
    }
    fs::write(here.join(format!("{name}.pgm")), picture).unwrap();
    let origin_m = top_m - height as f64 * CELL_M;
    let yaml = format!(
        "image: {name}.pgm\nresolution: {CELL_M}\norigin: [{left_m}, {origin_m}, 0.0]\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    );
    fs::write(here.join(format!("{name}.yaml")), yaml).unwrap();
}

#[test]
fn every_command_line_in_readme_docs_and_help_can_be_typed_as_it_stands() {
    let blocks: Vec<Block> =
        documents().iter().flat_map(fenced).chain(helps().iter().map(examples)).collect();
    let count: usize = blocks.iter().map(|block| block.lines.len()).sum();
    assert!(blocks.len() > 20 && count > 75, "{count} lines in {} blocks", blocks.len());
    let mut bench = Bench::new();
    let mut wrong: Vec<String> = blocks.iter().flat_map(|block| bench.run(block)).collect();
    wrong.extend(bench.fields_not_there());
    assert!(wrong.is_empty(), "{} of {count} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn a_wrong_example_is_found() {
    let mut bench = Bench::new();
    let lines = [
        "uchain run corner --set chain.tolerance_db=3",
        "uchain run corner --sed 7",
        "uchain run mines.toml",
        "cargo run --release -- plan corner --two 40",
        "uchain sweep corner --vary chain.tolerance_db=0..5/6 --out s",
        "uchain paper fig4z --out again",
        "uchain paper all --aut again",
        "cargo xtask tset",
        "cargo install --path crates/uchain-cly",
        "cargo run --release --example flie",
        "pip install ./crates/uchain-pi",
        "uchain report sweeps/corners",
    ];
    for line in lines {
        let block = Block { name: "planted".to_owned(), lines: vec![line.to_owned()] };
        assert_eq!(bench.run(&block).len(), 1, "{line}");
    }
    assert_eq!(bench.fields_not_there(), Vec::<String>::new());
    let lines = vec!["uchain run corner --json | jq .sprd_db".to_owned()];
    assert_eq!(bench.run(&Block { name: "planted".to_owned(), lines }), Vec::<String>::new());
    assert_eq!(bench.fields_not_there().len(), 1);
}

/// All keys and tables there are, and all options of all commands.
struct Known {
    tables: BTreeSet<String>,
    options: BTreeMap<String, BTreeSet<String>>,
    here: TempDir,
}

impl Known {
    fn new() -> Self {
        let here = folder();
        let list = uchain(here.path(), &["explain"]);
        let keys = stdout(&list).lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
        let tables = keys.filter_map(|key| key.split_once('.')).map(|(table, _)| table.to_owned()).collect();
        let options = helps().into_iter().map(|help| {
            let words = help.text.split(|c: char| c.is_whitespace() || "[],=<>()'`".contains(c));
            let options = words.filter(|word| word.starts_with("--")).map(str::to_owned);
            (help.name.trim_end_matches("--help").trim().to_owned(), options.collect())
        });
        Self { tables, options: options.collect(), here }
    }

    /// `chain.uavs` of `chain.uavs=3`, `--set chain.uavs = 3` and `chain.uavs`, if that is what a word is.
    fn key<'w>(&self, word: &'w str) -> Option<&'w str> {
        let key = word.split(['=', ' ', ':']).next()?.trim_matches(['[', ']']);
        let (table, rest) = key.split_once('.')?;
        let is_file =
            ["yaml", "pgm", "png", "svg", "toml", "json", "mcap", "csv", "rs", "md", "proto"].contains(&rest);
        let is_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "._".contains(c);
        (self.tables.contains(table) && !is_file && !rest.is_empty() && rest.chars().all(is_name))
            .then_some(key)
    }

    fn explains(&self, key: &str) -> bool {
        let explains = |key: &str| uchain(self.here.path(), &["explain", key]).status.success();
        // A key of the map's own table, whatever kind of map it is.
        let of_a_map = key.strip_prefix("map.").filter(|rest| !rest.contains('.'));
        explains(key)
            || of_a_map.is_some_and(|rest| {
                uchain_sim::map::FORMATS.iter().any(|kind| explains(&format!("{}.{rest}", kind.table)))
            })
    }

    fn has_option(&self, command: Option<&str>, option: &str) -> bool {
        self.options
            .iter()
            .filter(|(name, _)| command.is_none_or(|command| command == *name))
            .any(|(_, options)| options.contains(option))
    }

    /// What is wrong in a piece of code within a sentence.
    fn wrong_in(&self, code: &str) -> Option<String> {
        let words: Vec<&str> = code.split_whitespace().collect();
        let command = match words.as_slice() {
            ["uchain", of @ ("map" | "radio"), command, ..] if !command.starts_with('-') => {
                let command = self.options.keys().find(|name| **name == format!("{of} {command}"));
                if command.is_none() {
                    return Some(format!("`{code}`: no command of {of} is called so"));
                }
                command.map(String::as_str)
            }
            ["uchain", command, ..] if !command.starts_with('-') => {
                if !self.options.contains_key(*command) {
                    return Some(format!("`{code}`: no command is called {command}"));
                }
                Some(*command)
            }
            ["uchain", ..] => None,
            [first, ..] if first.starts_with("--") => None,
            // `report --quiet`, `uchain` left out.
            [command, option, ..] if option.starts_with("--") && self.options.contains_key(*command) => {
                Some(*command)
            }
            [word, ..] => {
                let key = self.key(word)?;
                return (!self.explains(key)).then(|| format!("`{code}`: no key is called {key}"));
            }
            [] => return None,
        };
        let options =
            words.iter().filter(|word| word.starts_with("--")).map(|word| word.split('=').next().unwrap());
        for option in options {
            if !self.has_option(command, option) {
                return Some(format!("`{code}`: no option is called {option}"));
            }
        }
        let key = words.iter().find_map(|word| self.key(word)).filter(|key| !self.explains(key))?;
        Some(format!("`{code}`: no key is called {key}"))
    }
}

impl Known {
    /// What is wrong in some lines of a scenario: each has to be TOML, and every key one that there is, with a value it
    /// may have.
    fn wrong_lines(&self, text: &str) -> Option<String> {
        let table = match text.parse::<toml::Table>() {
            Ok(table) => table,
            Err(error) => return Some(format!("`{text}`: {error}")),
        };
        let mut sets = Vec::new();
        sets_of("", &toml::Value::Table(table), &mut sets);
        let scenario = if text.contains("explore") { "apartment" } else { "corner" };
        let wrong = sets.iter().map(|set| uchain(self.here.path(), &["check", scenario, "--set", set]));
        wrong.filter(|output| !output.status.success()).map(|output| stderr(&output).to_owned()).next()
    }

    /// Whether a piece of code is a line of a scenario.
    fn is_line(&self, code: &str) -> bool {
        let key = code.split(" = ").next().unwrap();
        code.contains(" = ") && (self.key(key).is_some() || key == "preset")
    }
}

/// `chain.uavs=3` of every value in a table.
fn sets_of(key: &str, value: &toml::Value, into: &mut Vec<String>) {
    match value {
        toml::Value::Table(table) => {
            for (step, value) in table {
                let below = if key.is_empty() { step.clone() } else { format!("{key}.{step}") };
                sets_of(&below, value, into);
            }
        }
        value => into.push(format!("{key}={value}")),
    }
}

#[test]
fn every_line_of_a_scenario_that_is_shown_can_be_written() {
    let known = Known::new();
    let documents = documents();
    let blocks = documents.iter().flat_map(|page| page.text.split("\n```toml\n").skip(1));
    let blocks = blocks.map(|rest| rest.split("\n```").next().unwrap());
    let lines = documents.iter().flat_map(code).filter(|code| known.is_line(code));
    let shown: Vec<&str> = blocks.chain(lines).collect();
    assert!(shown.len() >= 2, "{shown:?}");
    let wrong: Vec<String> = shown.iter().filter_map(|text| known.wrong_lines(text)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for planted in [
        "explore.vehicle = \"octorotor\"",
        "preset = cavemod",
        "[chain]\nuavs = 3\nbase = 1",
        "link.gap = \"helt\"",
    ] {
        assert!(known.is_line(planted) || planted.contains('\n'), "{planted}");
        assert!(known.wrong_lines(planted).is_some(), "{planted}");
    }
}

/// The pieces of code within the sentences of a page.
fn code(page: &Text) -> Vec<&str> {
    let outside = page.text.split("```").step_by(2);
    outside.flat_map(|text| text.split('`').skip(1).step_by(2)).collect()
}

#[test]
fn every_key_option_and_command_that_a_sentence_names_is_there() {
    let known = Known::new();
    assert!(known.tables.len() > 10 && known.options.len() > 15, "{:?}", known.options.keys());
    let documents = documents();
    let pieces: Vec<&str> = documents.iter().flat_map(code).collect();
    let mut wrong: Vec<String> = pieces.iter().filter_map(|code| known.wrong_in(code)).collect();
    // Help speaks of keys without marking them; so do messages, behind "such as".
    let helps = helps();
    let said =
        helps.iter().flat_map(|help| help.text.split(|c: char| c.is_whitespace() || "()'\"".contains(c)));
    let messages = sources();
    let such_as = messages.iter().flat_map(|text| text.split("such as ").skip(1));
    let such_as = such_as.flat_map(|text| {
        text.lines().next().unwrap_or_default().split(|c: char| c.is_whitespace() || "()'\"\\".contains(c))
    });
    let mut keys: Vec<&str> =
        said.chain(such_as).filter(|word| word.contains('=')).filter_map(|word| known.key(word)).collect();
    keys.sort_unstable();
    keys.dedup();
    assert!(keys.len() > 10, "{keys:?}");
    wrong.extend(keys.iter().filter(|key| !known.explains(key)).map(|key| format!("no key is called {key}")));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));

    // The controls.
    for code in ["takeoff.s_max_db", "--sett", "uchain fly", "uchain plan --shard 2/4", "--set radio.sigma=3"]
    {
        assert!(known.wrong_in(code).is_some(), "{code}");
    }
    for code in ["takeoff.s_min_db", "--set radio.sigma_db=3", "map.yaml", "uchain sweep --shard", "run.mcap"]
    {
        assert_eq!(known.wrong_in(code), None, "{code}");
    }
}

/// The sources of command line and simulation.
fn sources() -> Vec<String> {
    fn read(folder: &Path, into: &mut Vec<String>) {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                read(&path, into);
            } else if path.extension().is_some_and(|end| end == "rs") {
                into.push(fs::read_to_string(path).unwrap());
            }
        }
    }
    let mut sources = Vec::new();
    for room in ["uchain-cli", "uchain-sim"] {
        read(&root().join("crates").join(room).join("src"), &mut sources);
    }
    sources
}

/// Fields of the tables of all pages headed by "field of `file`", by page and file.
fn fields_in_tables() -> BTreeMap<(String, String), BTreeSet<String>> {
    let mut fields: BTreeMap<(String, String), BTreeSet<String>> = BTreeMap::new();
    let documents = documents();
    let mut file = None::<String>;
    for (page, line) in documents.iter().flat_map(|page| page.text.lines().map(|line| (&page.name, line))) {
        if let Some(rest) = line.strip_prefix("| field of `") {
            file = rest.split('`').next().map(str::to_owned);
        } else if !line.starts_with('|') {
            file = None;
        } else if let Some(file) = file.as_ref().filter(|_| !line.starts_with("|-")) {
            let first = line.split('|').nth(1).unwrap();
            let names = first.split('`').skip(1).step_by(2).map(str::to_owned);
            fields.entry((page.clone(), file.clone())).or_default().extend(names);
        }
    }
    fields
}

#[test]
fn every_field_of_a_result_is_in_the_table_of_its_page_and_every_field_of_the_table_is_in_a_result() {
    let here = folder();
    let fields_of = |args: &[&str], out: &str| -> BTreeSet<String> {
        let output = uchain(here.path(), &[args, &["--json", "--out", out]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let json: Value = serde_json::from_str(stdout(&output)).unwrap();
        json.as_object().unwrap().keys().cloned().collect()
    };
    let tables = fields_in_tables();
    fs::write(here.path().join("log.csv"), uchain(here.path(), &["node", "--template"]).stdout).unwrap();
    let walk = root().join("examples/radio/walk.csv").display().to_string();
    let expected = [
        (
            "docs/guide/results.md",
            "summary.json",
            fields_of(&["run", "corner", "--set", "duration_s=5"], "chain"),
        ),
        (
            "docs/guide/exploration.md",
            "summary.json",
            fields_of(&["run", "apartment", "--set", "duration_s=5"], "rooms"),
        ),
        ("docs/guide/planning.md", "plan.json", fields_of(&["plan", "corner"], "plan")),
        ("docs/guide/firmware.md", "node.json", fields_of(&["node", "log.csv"], "node")),
        ("docs/guide/radio-fit.md", "fit.json", fields_of(&["radio", "fit", &walk], "fit")),
    ];
    assert_eq!(tables.len(), expected.len(), "{:?}", tables.keys());
    for (page, file, fields) in expected {
        let table = &tables[&(page.to_owned(), file.to_owned())];
        let (only_there, only_here): (Vec<_>, Vec<_>) =
            (fields.difference(table).collect(), table.difference(&fields).collect());
        assert!(
            only_there.is_empty() && only_here.is_empty(),
            "{page}: {file} has {only_there:?} besides, and the table {only_here:?}"
        );
    }
}

/// Links of a page to files of the project that are not there; anchors and other sites are not looked at.
fn broken_links(page: &Text) -> Vec<String> {
    let folder = root().join(&page.name).parent().unwrap().to_owned();
    let links = page.text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let files = links.filter(|link| !link.contains("://") && !link.starts_with('#'));
    let files = files.map(|link| link.split('#').next().unwrap());
    files.filter(|file| !folder.join(file).exists()).map(|file| format!("{}: {file}", page.name)).collect()
}

#[test]
fn every_link_from_a_page_to_another_file_leads_somewhere() {
    let documents = documents();
    let broken: Vec<String> = documents.iter().flat_map(broken_links).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    let planted = |text: &str| Text { name: "docs/guide/planted.md".to_owned(), text: text.to_owned() };
    assert_eq!(broken_links(&planted("[a](../limits.md#the-radio) and [b](../limit.md)")).len(), 1);
}

#[test]
fn what_the_guide_shows_of_a_plan_is_what_it_says() {
    let guide = fs::read_to_string(root().join("docs/guide/planning.md")).unwrap();
    let shown: Vec<&str> =
        guide.split("\n```text\n").skip(1).map(|rest| rest.split("\n```").next().unwrap()).collect();
    let [shown] = shown.as_slice() else { panic!("{} texts, of which one is known", shown.len()) };
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let plan = uchain(folder().path(), &["plan", "staircase"]);
    let (mut said, mut pieces) = (words(stdout(&plan)), 0);
    // What is left out stands as dots.
    for piece in shown.split('…').map(words).filter(|piece| !piece.is_empty()) {
        let Some(at) = said.find(&piece) else { panic!("not said, or not there: {piece}\nin {said}") };
        said = said.split_off(at + piece.len());
        pieces += 1;
    }
    assert!(pieces > 5, "{pieces}");
    assert!(said.starts_with(" files: "), "the answer is shown to its end: {said}");
}

#[test]
fn every_program_that_is_shown_and_flies_brings_its_own_mathematics() {
    let mut flying = 0;
    for source in sources() {
        // Examples in the documentation of items, and of whole modules.
        let examples = ["/// ```\n", "//! ```\n"].map(|fence| source.split(fence).skip(1).step_by(2));
        for example in examples.into_iter().flatten().filter(|text| !text.is_empty()) {
            let flies = ["run(&", "replay::", ".fly(", ".step(", "McapRecorder::start"];
            if flies.iter().any(|call| example.contains(call)) {
                flying += 1;
                assert!(example.contains("use uchain_libm as _;"), "{example}");
            }
        }
    }
    assert!(flying >= 5, "{flying}");
    let guide = fs::read_to_string(root().join("docs/guide/results.md")).unwrap();
    assert!(guide.contains("`use uchain_libm as _;`"));
}
