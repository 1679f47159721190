//! What may stand behind `cargo xtask`.

use std::{fmt::Write as _, path::PathBuf};

use crate::{
    bench::Bench,
    steps::{STEPS, Step},
    web::Effort,
};

/// What the caller wants.
pub(crate) enum Wish {
    /// To be told what there is.
    Help,
    /// These steps, in the gate's order.
    Test(Vec<&'static Step>),
    /// These benchmarks.
    Bench(Bench),
    /// Who imports whom.
    Rooms,
    /// The core on the emulated chip, and what it costs there.
    Firmware,
    /// A table of what becomes of maps of others, by a `uchain` that is built already if one is named.
    Maps(Option<PathBuf>),
    /// The page.
    Web(Effort),
}

/// What there is to do.
const TASKS: [&str; 7] = ["test", "bench", "firmware", "maps", "rooms", "web", "help"];

pub(crate) fn parse(args: impl Iterator<Item = String>) -> Result<Wish, String> {
    let args: Vec<String> = args.collect();
    if args.is_empty() || args.iter().any(|a| ["help", "--help", "-h"].contains(&a.as_str())) {
        return Ok(Wish::Help);
    }
    match args[0].as_str() {
        "test" => test(&args[1..]),
        "bench" => bench(&args[1..]),
        "rooms" => args.get(1).map_or(Ok(Wish::Rooms), |more| Err(format!("what is `{more}`?"))),
        "firmware" => args.get(1).map_or(Ok(Wish::Firmware), |more| Err(format!("what is `{more}`?"))),
        "maps" => match &args[1..] {
            [] => Ok(Wish::Maps(None)),
            [uchain] => Ok(Wish::Maps(Some(uchain.into()))),
            [_, more, ..] => Err(format!("what is `{more}`?")),
        },
        "web" => web(&args[1..]),
        other => Err(format!("unknown task `{other}`{}", meant(other, &TASKS))),
    }
}

fn web(args: &[String]) -> Result<Wish, String> {
    match args {
        [] => Ok(Wish::Web(Effort::Quick)),
        [only] if only == "--dist" => Ok(Wish::Web(Effort::Dist)),
        [more, ..] => Err(format!("`web` takes --dist or nothing; what is `{more}`?")),
    }
}

fn bench(args: &[String]) -> Result<Wish, String> {
    let mut asked = Bench { filter: None, accept: false };
    for arg in args {
        match arg.as_str() {
            "--accept" => asked.accept = true,
            flag if flag.starts_with('-') => return Err(format!("unknown option `{flag}`")),
            filter if asked.filter.is_none() => asked.filter = Some(filter.to_owned()),
            more => return Err(format!("one filter at a time; what is `{more}`?")),
        }
    }
    if asked.accept && asked.filter.is_some() {
        return Err("--accept takes no filter: it counts all workloads".to_owned());
    }
    Ok(Wish::Bench(asked))
}

fn test(named: &[String]) -> Result<Wish, String> {
    if let Some(unknown) = named.iter().find(|name| STEPS.iter().all(|s| s.name != **name)) {
        let steps: Vec<&str> = STEPS.iter().map(|step| step.name).collect();
        return Err(format!("unknown step `{unknown}`{}", meant(unknown, &steps)));
    }
    let wanted = |s: &&Step| named.is_empty() || named.iter().any(|name| s.name == *name);
    Ok(Wish::Test(STEPS.iter().filter(wanted).collect()))
}

/// A question for the name that is nearest to a word, if it is near enough.
fn meant(word: &str, known: &[&str]) -> String {
    let edits = |name: &&&str| strsim::damerau_levenshtein(word, name);
    let near = known.iter().min_by_key(edits).filter(|name| edits(name) <= 1 + name.len() / 3);
    near.map(|name| format!("; did you mean `{name}`?")).unwrap_or_default()
}

pub(crate) fn help() -> String {
    let mut text = String::from(
        "Usage: cargo xtask test [STEP]...\n       \
                cargo xtask bench [FILTER | --accept]\n       \
                cargo xtask firmware\n       \
                cargo xtask maps [UCHAIN]\n       \
                cargo xtask rooms\n       \
                cargo xtask web [--dist]\n\n\
         `test` runs the named steps, or all of them, in this order; the first failure ends it:\n\n",
    );
    for step in STEPS {
        let _ = writeln!(text, "  {:<10} {}", step.name, step.about);
    }
    text.push_str(
        "\nEverything builds in the profile `checked`: optimised, every assertion on.\n\
         With CI=true a missing tool is a failure; without, its step is skipped.\n",
    );
    text.push_str(
        "\n`bench` times everything, or what matches FILTER, and prints one table, ratios to the baselines\n\
         first. Without a filter it then counts instructions under valgrind and compares them with\n\
         benches/instructions.txt; --accept only counts, and writes that file.\n\
         \n`firmware` flies the laws on an emulated microcontroller, an STM32F405 as on a Crazyflie, and prints what\n\
         they cost there; qemu-system-arm has to be installed.\n\
         \n`maps` reads, plans and flies every map of others in ../shared/data, and writes docs/map-table.md; UCHAIN is\n\
         one that is built already.\n\
         \n`rooms` prints which module at the top of a crate imports which others.\n\
         \n`web` builds target/web/uchain.html, the page that `uchain view` opens; --dist takes longer and\n\
         makes it as small as it gets, with wasm-opt (binaryen) if that is there.\n",
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(args: &[&str]) -> Result<Vec<&'static str>, String> {
        match parse(args.iter().map(ToString::to_string))? {
            Wish::Help => Ok(vec!["help"]),
            Wish::Test(steps) => Ok(steps.iter().map(|s| s.name).collect()),
            Wish::Bench(_) => Ok(vec!["bench"]),
            Wish::Firmware => Ok(vec!["firmware"]),
            Wish::Maps(None) => Ok(vec!["maps"]),
            Wish::Maps(Some(_)) => Ok(vec!["maps", "built"]),
            Wish::Rooms => Ok(vec!["rooms"]),
            Wish::Web(Effort::Quick) => Ok(vec!["web"]),
            Wish::Web(Effort::Dist) => Ok(vec!["web", "dist"]),
        }
    }

    #[test]
    fn named_steps_run_in_the_gates_order_and_no_name_means_all() {
        assert_eq!(names(&["test", "no-std", "clippy"]), Ok(vec!["clippy", "no-std"]));
        assert_eq!(names(&["test"]).unwrap().len(), STEPS.len());
    }

    #[test]
    fn an_unknown_step_is_an_error_that_names_it_and_the_nearest_one() {
        assert_eq!(names(&["test", "clipy"]), Err("unknown step `clipy`; did you mean `clippy`?".into()));
        assert_eq!(names(&["tset"]), Err("unknown task `tset`; did you mean `test`?".into()));
        assert_eq!(names(&["test", "everything"]), Err("unknown step `everything`".into()));
        assert_eq!(names(&["test", "--help"]), Ok(vec!["help"]));
        assert_eq!(names(&["bench", "--acept"]), Err("unknown option `--acept`".into()));
    }

    #[test]
    fn a_benchmark_takes_one_filter_and_accepting_none() {
        assert_eq!(names(&["bench", "rays"]), Ok(vec!["bench"]));
        assert!(names(&["bench", "rays", "w1"]).is_err());
        assert!(names(&["bench", "rays", "--accept"]).is_err());
    }

    #[test]
    fn the_chip_takes_no_more_words() {
        assert_eq!(names(&["firmware"]), Ok(vec!["firmware"]));
        assert_eq!(names(&["firmware", "all"]), Err("what is `all`?".into()));
        assert_eq!(names(&["firmwar"]), Err("unknown task `firmwar`; did you mean `firmware`?".into()));
    }

    #[test]
    fn maps_are_read_by_the_uchain_that_is_named() {
        assert_eq!(names(&["maps"]), Ok(vec!["maps"]));
        assert_eq!(names(&["maps", "target/release/uchain"]), Ok(vec!["maps", "built"]));
        assert_eq!(names(&["maps", "a", "b"]), Err("what is `b`?".into()));
    }

    #[test]
    fn the_page_is_built_fast_or_small() {
        assert_eq!(names(&["web"]), Ok(vec!["web"]));
        assert_eq!(names(&["web", "--dist"]), Ok(vec!["web", "dist"]));
        assert_eq!(names(&["web", "dist"]), Err("`web` takes --dist or nothing; what is `dist`?".into()));
    }
}
