//! `uchain completions`: the grammar as a completion script for a shell.

use clap::{Arg, ValueHint, builder::PossibleValuesParser};
use clap_complete::Shell;
use uchain_sim::{
    config::{PRESETS, builtin_names},
    map::make::{KINDS, Kind},
    registry::Registry,
};

use crate::{args::grammar, exit::Failure, print};

/// The script knows the scenarios, presets and keys of this version. They are offered, not demanded: a path of a
/// file is as good as the name of a scenario.
pub(crate) fn completions(registry: Registry, shell: Shell) -> Result<(), Failure> {
    let keys = registry.explain("")?;
    let keys: Vec<String> = keys.into_iter().filter(|key| !key.is_table).map(|key| key.key).collect();
    let assignments: Vec<String> = keys
        .iter()
        .map(|key| format!("{key}="))
        .chain(PRESETS.map(|p| format!("preset={}", p.name)))
        .collect();
    let scenarios = |arg: Arg| arg.value_parser(PossibleValuesParser::new(builtin_names()));
    let presets = |arg: Arg| arg.value_parser(PossibleValuesParser::new(PRESETS.map(|preset| preset.name)));
    // "Other" is what keeps bash from setting a space behind the "=".
    let sets = |arg: Arg| {
        arg.value_parser(PossibleValuesParser::new(assignments.clone())).value_hint(ValueHint::Other)
    };
    let mut grammar = grammar()
        .mut_subcommand("run", |run| run.mut_arg("scenario", scenarios).mut_arg("set", sets))
        .mut_subcommand("sweep", |sweep| {
            sweep.mut_arg("scenario", scenarios).mut_arg("set", sets).mut_arg("vary", sets)
        })
        .mut_subcommand("plan", |plan| plan.mut_arg("what", scenarios).mut_arg("set", sets))
        .mut_subcommand("map", |map| {
            let kinds = |arg: Arg| arg.value_parser(PossibleValuesParser::new(KINDS.map(Kind::name)));
            let map = map.mut_subcommand("make", |make| make.mut_arg("kind", kinds));
            ["info", "plot", "convert"].into_iter().fold(map, |map, name| {
                map.mut_subcommand(name, |one| one.mut_arg("what", scenarios).mut_arg("set", sets))
            })
        })
        .mut_subcommand("node", |node| node.mut_arg("set", sets).mut_arg("preset", presets))
        .mut_subcommand("check", |check| check.mut_arg("scenario", scenarios).mut_arg("set", sets))
        .mut_subcommand("show", |show| show.mut_arg("scenario", scenarios).mut_arg("preset", presets))
        .mut_subcommand("explain", |explain| {
            explain.mut_arg("key", |key| key.value_parser(PossibleValuesParser::new(keys.clone())))
        });
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut grammar, "uchain", &mut script);
    print(&String::from_utf8_lossy(&script))
}
