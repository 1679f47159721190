//! Hints below error messages: what to do about a mistake, in a line.

use std::path::Path;

use uchain_sim::{
    config::{ConfigError, Origin, Preset, builtin},
    log::NO_VALUE,
    registry::Registry,
};

use crate::{args::grammar, exit::Failure};

const TOML: &str =
    "every line is key = value (text in \"quotes\", lists in [ ]) or a [table]; uchain show corner is one";

/// What helps, if anything is known to.
pub(crate) fn hint(registry: Registry, failure: &Failure) -> Option<String> {
    let Failure::Input(error) = failure else { return None };
    match error {
        ConfigError::UnknownScenario { name, .. } => {
            let file = format!("{name}.toml");
            let is_here = Path::new(&file).is_file();
            if is_here { Some(format!("there is a file {file}")) } else { about_name(name) }
        }
        ConfigError::UnknownPreset { name, .. } => {
            builtin(name).map(|_| format!("'{name}' is a scenario: uchain show {name}"))
        }
        ConfigError::NoSuchKey { key, .. } => about_name(key).or_else(|| Some(about_key(registry, key))),
        ConfigError::Read { label, .. } => {
            let name = Path::new(label).file_stem()?.to_str()?;
            builtin(name).map(|_| format!("'{name}', without folder and .toml, is built in"))
        }
        ConfigError::Syntax { at: Origin::Line { .. } | Origin::Whole { .. }, .. } => Some(TOML.to_owned()),
        ConfigError::UnknownKey { key, .. } => Some(about_key(registry, key)),
        ConfigError::Invalid { expected, .. } if expected.starts_with(NO_VALUE) => None,
        ConfigError::UnknownChoice { key, .. }
        | ConfigError::Missing { key, .. }
        | ConfigError::Invalid { key, .. } => {
            registry.explain(key).is_ok().then(|| format!("what may stand there: uchain explain {key}"))
        }
        _ => None,
    }
}

/// Where the keys are that stand beside this one.
fn about_key(registry: Registry, key: &str) -> String {
    let is_option = |arg: &clap::Arg| arg.get_long() == Some(key);
    if grammar().find_subcommand("run").is_some_and(|run| run.get_arguments().any(is_option)) {
        return format!("no key of a scenario but an option: uchain run NAME --{key}");
    }
    match key.rsplit_once('.').filter(|(table, _)| registry.explain(table).is_ok()) {
        Some((table, _)) => format!("keys of {table}: uchain explain {table}"),
        None => "all keys: uchain explain".to_owned(),
    }
}

fn about_name(name: &str) -> Option<String> {
    if Preset::find(name).is_ok() {
        return Some(format!("'{name}' is a preset: uchain show --preset {name}, or --set preset={name}"));
    }
    if builtin(name).is_some() {
        return Some(format!("'{name}' is a scenario: uchain show {name}"));
    }
    None
}
