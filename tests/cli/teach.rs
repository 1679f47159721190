use std::{
    fmt::Write as _,
    fs,
    process::{Command, Output},
};

use serde_json::Value;

use crate::{SHORT, folder, stderr, stdout, uchain, with_preset};

/// The commands that `uchain --help` lists.
fn commands() -> Vec<String> {
    let help = uchain(folder().path(), &["--help"]);
    let lines = stdout(&help).lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = lines.take_while(|line| !line.is_empty()).filter_map(|line| line.split_whitespace().next());
    let names: Vec<String> = names.filter(|name| *name != "help").map(str::to_owned).collect();
    assert!(names.contains(&"map".to_owned()));
    names
}

/// What `uchain map --help` and `uchain radio --help` list.
pub(crate) const NESTED: [[&str; 2]; 6] = [
    ["map", "info"],
    ["map", "plot"],
    ["map", "convert"],
    ["map", "make"],
    ["radio", "fit"],
    ["radio", "map"],
];

#[test]
fn help_texts_are_the_reviewed_ones_and_each_has_an_example() {
    let here = folder();
    let mut all = stdout(&uchain(here.path(), &["--help"])).to_owned();
    for name in commands() {
        let help = uchain(here.path(), &[&name, "--help"]);
        assert_eq!((help.status.code(), stderr(&help)), (Some(0), ""), "{name}");
        assert!(
            stdout(&help).contains(&format!("Examples:\n  uchain {name}")) || name == "completions",
            "{name}"
        );
        let _ = write!(all, "\n==== uchain {name} --help\n\n{}", stdout(&help));
    }
    for [of, name] in NESTED {
        let help = uchain(here.path(), &[of, name, "--help"]);
        assert!(stdout(&help).contains(&format!("Examples:\n  uchain {of} {name}")), "{name}");
        let _ = write!(all, "\n==== uchain {of} {name} --help\n\n{}", stdout(&help));
    }
    insta::assert_snapshot!(all);
    let version = uchain(here.path(), &["--version"]);
    assert_eq!(stdout(&version), concat!("uchain ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn explanations_read_as_reviewed() {
    let mut all = String::new();
    for key in ["radio.alpha_wall", "equalize.law", "speed_mps", "chain.goal_m", "flow"] {
        let _ = write!(
            all,
            "==== uchain explain {key}\n\n{}\n",
            stdout(&uchain(folder().path(), &["explain", key]))
        );
    }
    insta::assert_snapshot!(all);
}

#[test]
fn what_an_explanation_says_to_write_can_be_flown() {
    let here = folder();
    let list = uchain(here.path(), &["explain"]);
    let keys: Vec<&str> =
        stdout(&list).lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).collect();
    assert!(keys.len() > 90, "{keys:?}");
    let mut args = vec!["check".to_owned(), "straight".to_owned()];
    for key in keys {
        let card = uchain(here.path(), &["explain", key]);
        let set = stdout(&card).lines().find_map(|line| line.trim_start().strip_prefix("or         --set "));
        // What belongs to another map or to an exploration does not go with this one.
        if let Some(set) = set
            .filter(|_| !key.starts_with("map.") && !key.starts_with("explore."))
            .filter(|_| !["preset", "chain.goal_m"].contains(&key))
        {
            args.extend(["--set".to_owned(), set.trim_matches('\'').to_owned()]);
        }
    }
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let output = uchain(here.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(args.len() > 150, "{args:?}");
}

/// What bash offers for a line, by the script of `uchain completions bash`.
fn offered(words: &str) -> Vec<String> {
    let script = r#"
        source <("$0" completions bash) || exit 1
        compopt() { :; } # works in a completion only
        COMP_WORDS=(uchain "$@"); COMP_CWORD=$#
        _uchain uchain "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
        printf '%s\n' "${COMPREPLY[@]}""#;
    let mut bash = Command::new("bash");
    bash.args(["--noprofile", "--norc", "-c", script, env!("CARGO_BIN_EXE_uchain")]).args(words.split(' '));
    let output = bash.output().unwrap();
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""), "{words}");
    stdout(&output).lines().filter(|line| !line.is_empty()).map(str::to_owned).collect()
}

#[cfg(unix)]
#[test]
fn bash_completes_commands_options_scenarios_presets_and_keys() {
    assert_eq!(offered("ru"), ["run"]);
    assert_eq!(offered("run corr"), ["corridors"]);
    assert_eq!(offered("run corner --se"), ["--seed", "--set"]);
    assert_eq!(offered("check corner --set radio.alpha_w"), ["radio.alpha_wall="]);
    assert_eq!(offered("run corner --set preset=c"), ["preset=cavemod"]);
    assert_eq!(offered("show --preset f"), ["frontiers2021"]);
    assert_eq!(offered("explain chain.g"), ["chain.goal_m"]);
    assert_eq!(offered("map make r"), ["rooms", "room-and-pillar"]);
    assert_eq!(offered("map plot corr"), ["corridors"]);
    // No name of ours: bash goes on to the names of files.
    assert_eq!(offered("run mine"), Vec::<String>::new());
}

#[test]
fn every_shell_gets_a_script_that_knows_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = uchain(folder().path(), &["completions", shell]);
        assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""), "{shell}");
        for name in commands() {
            assert!(stdout(&output).contains(&name), "{shell}: {name}");
        }
    }
}

/// What groff has to say about a page, if it is here.
fn groff(page: &str) -> Option<Output> {
    let here = folder();
    let file = here.path().join("page.1");
    fs::write(&file, page).unwrap();
    Command::new("groff").args(["-man", "-Tascii", "-ww", "-z"]).arg(&file).output().ok()
}

#[test]
fn there_is_a_manual_page_for_every_command_and_it_is_well_formed() {
    let here = folder();
    let output = uchain(here.path(), &["man", "--out", "pages"]);
    assert_eq!((output.status.code(), stdout(&output), stderr(&output)), (Some(0), "", ""));
    let nested = NESTED.map(|[of, name]| format!("{of}-{name}"));
    let names = commands().into_iter().chain(nested).map(|name| format!("uchain-{name}.1"));
    let files = names.chain(["uchain.1".to_owned()]);
    for file in files {
        let page = fs::read_to_string(here.path().join("pages").join(&file)).unwrap();
        assert!(page.contains(".TH uchain") && page.contains(".SH EXAMPLES\n.nf\n"), "{file}");
        assert!(page.is_ascii(), "{file}: troff without preconv reads ASCII only");
        let known = ["ie", "el", "TH", "SH", "TP", "IP", "PP", "RS", "RE", "nf", "fi", "br"];
        let macros = page.lines().filter_map(|line| line.strip_prefix('.'));
        assert!(macros.clone().all(|line| known.iter().any(|name| line.starts_with(name))), "{file}");
        if let Some(output) = groff(&page) {
            assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""), "{file}");
        }
    }
    let page = uchain(here.path(), &["man"]);
    assert_eq!(stdout(&page), fs::read_to_string(here.path().join("pages/uchain.1")).unwrap());
    // A control: groff does find fault.
    if let Some(output) = groff(".SH A\n.unknown\n") {
        assert_ne!(stderr(&output), "");
    }
}

#[test]
fn quiet_says_nothing_and_exits_as_ever() {
    let here = folder();
    for (args, code) in [
        (&["check", "corner", "--quiet"][..], 0),
        (&["run", "corner", "--set", crate::SHORT, "--quiet"], 0),
        (&["plan", "corner", "--quiet"], 0),
    ] {
        let output = uchain(here.path(), args);
        let said = (output.status.code(), stdout(&output), stderr(&output));
        assert_eq!(said, (Some(code), "", ""), "{args:?}");
    }
    let output = uchain(here.path(), &["check", "cornr", "--quiet"]);
    assert!(stderr(&output).starts_with("error: ") && output.status.code() == Some(3), "errors are said");
    let output = uchain(here.path(), &["run", "corner", "--set", crate::SHORT, "--quiet", "--json"]);
    assert!(stdout(&output).starts_with('{'), "what is asked for is printed");
}

#[test]
fn a_preset_is_listed_shown_named_by_check_and_changes_the_flight() {
    let here = folder();
    let list = uchain(here.path(), &["list"]);
    for name in ["cavemod", "frontiers2021"] {
        assert!(stdout(&list).contains(&format!("preset={name}")), "{}", stdout(&list));
        let check = uchain(here.path(), &["check", "corner", "--set", &format!("preset={name}")]);
        assert!(stdout(&check).starts_with(&format!("ok: corner, preset {name}: ")), "{}", stdout(&check));
    }

    // What is shown, written by hand, flies as the preset does.
    let shown =
        [&["show", "corner"][..], &["show", "--preset", "cavemod"]].map(|args| uchain(here.path(), args));
    let [scenario, preset] = shown.each_ref().map(stdout);
    fs::write(here.path().join("mine.toml"), with_preset(scenario, preset)).unwrap();
    let digest = |args: &[&str]| {
        let output = uchain(here.path(), &[&["run", "--json", "--set", SHORT], args].concat());
        let summary: Value = serde_json::from_str(stdout(&output)).unwrap();
        summary["digest"].as_str().unwrap().to_owned()
    };
    let by_name = digest(&["corner", "--set", "preset=cavemod"]);
    assert_eq!(by_name, digest(&["mine.toml"]));
    assert_ne!(by_name, digest(&["corner"]));
    assert_ne!(by_name, digest(&["corner", "--set", "preset=frontiers2021"]));
    // A key written by hand wins.
    assert_ne!(by_name, digest(&["corner", "--set", "preset=cavemod", "--set", "equalize.decision_s=0.2"]));
}
