//! Circles of imports between rooms (cyclic dependencies of modules), found in the sources.
//!
//! A room is a module at the top of a crate. Two rooms that import each other, even through a third or through names
//! that the crate's root passes on, are one room with a wall in it: neither can be read, tested or moved alone. The
//! compiler allows it, so this reads every file of a crate and asks which module each path leads to.
//!
//! Seen are `use`, paths in the middle of code, types and attributes, the tokens of macro calls and definitions,
//! `self` and `super`, re-exports under the same or another name, globs, `#[path]`, and paths in the text of serde's
//! attributes. A glob counts as an import of all it can see. Code of tests and documentation does not count.

mod circles;
mod paths;
mod resolve;
#[cfg(test)]
mod tests;
mod tokens;
mod tree;

use std::{fs, io, path::Path};

use anyhow::{Context as _, Result, bail, ensure};

use circles::Graph;
use tree::Tree;

/// Rooms within a room.
struct Nested {
    package: &'static str,
    room: &'static str,
}

/// Where the modules of one room are rooms among themselves. Those that are folders must not import each other at all:
/// what two missions share belongs to a file beside them.
const NESTED: &[Nested] = &[Nested { package: "uchain-sim", room: "mission" }];

/// Reads one file.
type Read<'a> = &'a dyn Fn(&Path) -> io::Result<String>;

/// The imports between the rooms of every crate below a folder, one graph for each root and each nested room.
pub(crate) fn graphs(crates: &Path) -> Result<Vec<Graph>> {
    let mut graphs = Vec::new();
    let mut folders: Vec<_> = entries(crates)?.into_iter().filter(|path| path.join("src").is_dir()).collect();
    folders.sort();
    for folder in folders {
        let package = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for root in roots(&folder.join("src"))? {
            graphs.extend(of_root(&package, &root, &|path| fs::read_to_string(path))?);
        }
    }
    ensure!(!graphs.is_empty(), "no crate in {}", crates.display());
    Ok(graphs)
}

/// Ends with every circle in words, if there is one.
pub(crate) fn check(graphs: &[Graph], below: &Path) -> Result<()> {
    let wrong: Vec<String> = graphs.iter().flat_map(|graph| graph.complaints(below)).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    bail!(
        "{}\nWhat to do: move what both need into the lower of the rooms, or into one of its own; or hand it in as an \
         argument, so that the lower room need not know where it comes from.",
        wrong.join("\n")
    );
}

fn of_root(package: &str, root: &Path, read: Read) -> Result<Vec<Graph>> {
    let tree = Tree::read(root, read)?;
    let edges = resolve::edges(&tree)?;
    let mut graphs = vec![Graph::of_rooms(package, root, &tree, &edges)];
    for nested in NESTED.iter().filter(|nested| nested.package == package) {
        graphs.extend(Graph::of_nested(nested, &tree, &edges));
    }
    Ok(graphs)
}

/// The files that are compiled on their own: the library, the program and further programs.
fn roots(src: &Path) -> Result<Vec<std::path::PathBuf>> {
    let mut roots = vec![src.join("lib.rs"), src.join("main.rs")];
    if src.join("bin").is_dir() {
        for path in entries(&src.join("bin"))? {
            roots.push(if path.is_dir() { path.join("main.rs") } else { path });
        }
    }
    roots.retain(|path| path.is_file() && path.extension().is_some_and(|ext| ext == "rs"));
    roots.sort();
    Ok(roots)
}

fn entries(folder: &Path) -> Result<Vec<std::path::PathBuf>> {
    let read = || fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>();
    read().with_context(|| format!("cannot list {}", folder.display()))
}
