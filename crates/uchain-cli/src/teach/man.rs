//! `uchain man`: the grammar as manual pages.

use std::{
    fs,
    io::{self, Write as _},
    path::Path,
};

use clap::Command;
use clap_mangen::{
    Man,
    roff::{Roff, roman},
};

use crate::{args::grammar, exit::Failure, print};

/// What the foot of every page says.
const SOURCE: &str = concat!("uchain ", env!("CARGO_PKG_VERSION"));

/// The page of the whole on stdout, or the pages of everything into a folder.
pub(crate) fn man(out: Option<&Path>) -> Result<(), Failure> {
    let mut grammar = grammar().disable_help_subcommand(true);
    grammar.build();
    let Some(folder) = out else { return print(&page(&grammar).map_err(Failure::Stdout)?) };
    fs::create_dir_all(folder).map_err(|cause| Failure::Folder { folder: folder.to_owned(), cause })?;
    let nested = grammar.get_subcommands().flat_map(Command::get_subcommands);
    for command in std::iter::once(&grammar).chain(grammar.get_subcommands()).chain(nested) {
        let file = folder.join(Man::new(command.clone()).get_filename());
        let written = page(command).and_then(|text| fs::write(&file, text));
        written.map_err(|cause| Failure::Write { file, cause })?;
    }
    Ok(())
}

/// One page. What stands below the options keeps its lines: it is examples and tables.
fn page(command: &Command) -> io::Result<String> {
    let below = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let man = Man::new(command.clone().after_help(None::<&str>)).source(SOURCE);
    let mut text = Vec::new();
    man.render(&mut text)?;
    for block in below.split("\n\n").filter(|block| !block.trim().is_empty()) {
        let (heading, body) = match block.split_once('\n') {
            Some((heading, body)) if heading.ends_with(':') => (heading.trim_end_matches(':'), body),
            _ => ("Notes", block),
        };
        let mut roff = Roff::default();
        roff.control("SH", [heading.to_uppercase().as_str()]);
        roff.control("nf", []);
        for line in body.lines() {
            roff.text([roman(line)]);
        }
        roff.control("fi", []);
        text.write_all(roff.render().as_bytes())?;
    }
    Ok(String::from_utf8_lossy(&text).into_owned())
}
