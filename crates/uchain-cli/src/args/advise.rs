//! Tips below usage errors (suggestions).

use std::{ffi::OsString, path::Path};

use clap::{
    builder::StyledStr,
    error::{ContextKind, ContextValue, ErrorKind},
};
use uchain_sim::{
    config::{builtin, kind_of_map},
    registry::Registry,
};

/// A usage error with a tip, if what was meant can be guessed.
pub(super) fn advise(registry: Registry, mut error: clap::Error, args: &[OsString]) -> clap::Error {
    let text = |kind: ContextKind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.as_str()),
        Some(ContextValue::Strings(words)) => words.first().map(String::as_str),
        _ => None,
    };
    let tip = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            text(ContextKind::InvalidSubcommand).and_then(|word| forgotten(registry, word))
        }
        ErrorKind::UnknownArgument => text(ContextKind::InvalidArg)
            .and_then(|key| key_as_option(registry, key))
            .or_else(|| apart(registry, args)),
        ErrorKind::MissingRequiredArgument => text(ContextKind::InvalidArg).and_then(missing),
        _ => None,
    };
    if let Some(tip) = tip {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
    }
    error
}

fn missing(argument: &str) -> Option<String> {
    if argument.contains("NAME") {
        return Some("what is there to fly: uchain list".to_owned());
    }
    argument.contains("SHELL").then(|| "one of bash, elvish, fish, powershell, zsh".to_owned())
}

/// `--uavs` where there is no such option, only a key.
fn key_as_option(registry: Registry, argument: &str) -> Option<String> {
    let word = argument.strip_prefix("--")?.split('=').next()?.replace('-', "_");
    match registry.explain(&word).ok()?.as_slice() {
        [key] => Some(format!("a key of the scenario: --set {}=VALUE", key.key)),
        _ => None,
    }
}

/// `--set key value` and `--set key = value`.
fn apart(registry: Registry, args: &[OsString]) -> Option<String> {
    let words: Vec<&str> = args.iter().filter_map(|arg| arg.to_str()).collect();
    let starts = words.iter().enumerate().filter(|(_, word)| **word == "--set");
    let mut pairs = starts.filter_map(|(start, _)| {
        let key = words.get(start + 1)?.trim_end_matches('=');
        let value = words.iter().skip(start + 2).find(|word| **word != "=")?;
        let is_pair = registry.explain(key).is_ok() && !value.starts_with("--");
        is_pair.then(|| format!("--set takes one word: --set {key}={}", value.trim_start_matches('=')))
    });
    pairs.next()
}

fn forgotten(registry: Registry, word: &str) -> Option<String> {
    if kind_of_map(Path::new(word)).is_some() {
        return Some(format!("to plan for a map: uchain plan {word} --base=X,Y --goal=X,Y"));
    }
    let is_scenario = builtin(word).is_some() || has_end(word, &["toml"]);
    if is_scenario {
        return Some(format!("to fly a scenario: uchain run {word}"));
    }
    let is_key = !word.is_empty() && registry.explain(word).is_ok();
    is_key.then(|| format!("to read about a key: uchain explain {word}"))
}

fn has_end(name: &str, ends: &[&str]) -> bool {
    let end = Path::new(name).extension().unwrap_or_default();
    ends.iter().any(|known| end.eq_ignore_ascii_case(known))
}
