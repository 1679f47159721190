//! `cargo xtask web`: the page to fly in, with the engine inside, as one file that opens from disk.

mod engine;
mod pack;

use std::{
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, bail};

use crate::house::House;

pub(crate) use engine::is_ready;

/// How much work goes into the engine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effort {
    /// Built fast, for tests and for working on the page.
    Quick,
    /// As small as it gets, to be given away.
    Dist,
}

/// Builds the page, and prints how large it is; an error in one line if Rust cannot build for wasm here.
pub(crate) fn web(house: &House, effort: Effort) -> Result<PathBuf> {
    if let Err(remedy) = is_ready()? {
        bail!(remedy);
    }
    build(house, effort)
}

/// Builds the page, and prints how large it is. Where it is.
pub(crate) fn build(house: &House, effort: Effort) -> Result<PathBuf> {
    let wasm = engine::build(house, effort)?;
    let zipped = match effort {
        Effort::Quick => pack::gzip(&wasm)?,
        Effort::Dist => pack::gzip_small(&wasm)?,
    };
    let page = pack::page(&house.root.join("crates/uchain-view/web"), &zipped)?;
    let file = house.target.join("web/uchain.html");
    write_whole(&file, page.as_bytes())?;
    println!("engine: {} of wasm, {} gzipped", kilobytes(wasm.len()), kilobytes(zipped.len()));
    println!("page:   {} in {}", kilobytes(page.len()), file.display());
    Ok(file)
}

/// A page that is read meanwhile is the old one or the new one.
fn write_whole(file: &Path, bytes: &[u8]) -> Result<()> {
    let part = file.with_extension("part");
    let write = || {
        fs::create_dir_all(file.parent().unwrap_or(Path::new(".")))?;
        fs::write(&part, bytes)?;
        fs::rename(&part, file)
    };
    write().with_context(|| format!("cannot write {}", file.display()))
}

fn kilobytes(bytes: usize) -> String {
    format!("{} kB", bytes.div_ceil(1000))
}
