//! What may stand behind `cargo xtask`.

use std::fmt::Write as _;

use crate::steps::{STEPS, Step};

/// What the caller wants.
pub(crate) enum Wish {
    /// To be told what there is.
    Help,
    /// These steps, in the gate's order.
    Test(Vec<&'static Step>),
}

pub(crate) fn parse(args: impl Iterator<Item = String>) -> Result<Wish, String> {
    let args: Vec<String> = args.collect();
    if args.is_empty() || args.iter().any(|a| ["help", "--help", "-h"].contains(&a.as_str())) {
        return Ok(Wish::Help);
    }
    if args[0] != "test" {
        return Err(format!("unknown task `{}`{}", args[0], meant(&args[0], &["test", "help"])));
    }
    let named = &args[1..];
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
        "Usage: cargo xtask test [STEP]...\n\n\
         Runs the named steps, or all of them, in this order; the first failure ends it:\n\n",
    );
    for step in STEPS {
        let _ = writeln!(text, "  {:<10} {}", step.name, step.about);
    }
    text.push_str(
        "\nEverything builds in the profile `checked`: optimised, every assertion on.\n\
         With CI=true a missing tool is a failure; without, its step is skipped.\n",
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
    }
}
