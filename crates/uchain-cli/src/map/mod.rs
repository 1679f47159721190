//! `uchain map`: what a map is, a picture of it, the same as another kind of file, and maps out of nothing.

mod args;
mod convert;
mod ends;
mod info;
mod make;
mod plot;

use std::sync::Arc;

use uchain_sim::{
    map::Map as Walls,
    registry::{Registry, Typed},
};

use crate::exit::Failure;
pub(crate) use args::{EXAMPLES, Map};

pub(crate) fn map(registry: Registry, asked: &Map) -> Result<(), Failure> {
    match asked {
        Map::Info(asked) => info::info(registry, asked),
        Map::Plot(asked) => plot::plot(registry, asked),
        Map::Convert(asked) => convert::convert(registry, asked),
        Map::Make(asked) => make::make(asked),
    }
}

/// The map that is asked for.
fn read(registry: Registry, asked: &args::Read) -> Result<Arc<Walls>, Failure> {
    asked.map.fits(&asked.what)?;
    let station = |key: &str, option: &str, name: &str| Typed {
        assignment: format!("map.{key}={}", toml::Value::String(name.to_owned())),
        typed: format!("--{option} {name}"),
    };
    let cell = asked.map.cell.map(|cell_m| Typed {
        assignment: format!("map.cell_m={cell_m:?}"),
        typed: format!("--cell {cell_m}"),
    });
    let from = asked.map.from.as_deref().map(|name| station("from", "from", name));
    let to = asked.to.as_deref().map(|name| station("to", "to", name));
    let typed: Vec<Typed> = [cell, from, to].into_iter().flatten().collect();
    Ok(registry.map(&asked.what, &typed, &asked.sets.set)?)
}

impl args::Read {
    /// Its options as they are typed, each with a space before it.
    fn words(&self) -> String {
        let cell = self.map.cell.map(|cell_m| format!(" --cell {cell_m}"));
        let from = self.map.from.as_deref().map(|name| format!(" --from {}", make::quoted(name)));
        let to = self.to.as_deref().map(|name| format!(" --to {}", make::quoted(name)));
        let sets = self.sets.set.iter().map(|set| format!(" --set {}", make::quoted(set)));
        cell.into_iter().chain(from).chain(to).chain(sets).collect()
    }
}

/// A length in words: metres, or kilometres where those are long.
fn metres(length_m: f64) -> String {
    let decimals = match length_m {
        m if m >= 1000.0 => return format!("{:.2} km", m / 1000.0),
        m if m >= 100.0 => 0,
        m if m >= 10.0 => 1,
        _ => 2,
    };
    format!("{length_m:.decimals$} m")
}
