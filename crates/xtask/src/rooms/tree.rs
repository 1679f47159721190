//! A crate's modules, read from its files the way the compiler finds them.

use std::{
    collections::BTreeMap,
    io,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, bail, ensure};
use proc_macro2::{TokenStream, TokenTree};
use syn::{Expr, Item, ItemMod, Lit, Meta, ext::IdentExt as _};

use super::{
    Read,
    paths::{Names, names_of, only_in_tests},
    tokens::{Kind, Mention},
};

/// Modules within modules; a file that declares itself would go on for ever.
const MAX_DEPTH: usize = 50;
/// Brackets within brackets. The parser works on the stack.
const MAX_NESTING: usize = 200;

/// All modules of one crate that some build without tests compiles.
pub(super) struct Tree {
    /// The first is the root; every other stands behind the one that declares it.
    pub(super) modules: Vec<Module>,
}

pub(super) struct Module {
    /// Names from the root, which has none.
    pub(super) path: Vec<String>,
    /// The module it is declared in; the root's is the root.
    pub(super) parent: usize,
    pub(super) file: PathBuf,
    /// Under conditions, one name may be declared more than once.
    pub(super) inner: BTreeMap<String, Vec<usize>>,
    pub(super) names: Names,
}

/// Where the files of a module's modules are looked for.
struct Place {
    /// For those that are found by their name.
    by_name: PathBuf,
    /// For those with a `#[path]`.
    by_path: PathBuf,
}

impl Tree {
    /// Reads the root's file and all that it declares.
    pub(super) fn read(root: &Path, read: Read) -> Result<Self> {
        let mut tree = Self { modules: Vec::new() };
        let text = read(root).with_context(|| format!("cannot read {}", root.display()))?;
        let items = parse(root, &text)?.items;
        let here = root.parent().unwrap_or(Path::new("")).to_path_buf();
        let place = Place { by_name: here.clone(), by_path: here };
        tree.add(&[], 0, root, &items, &place, read)?;
        Ok(tree)
    }

    fn add(
        &mut self,
        path: &[String],
        parent: usize,
        file: &Path,
        items: &[Item],
        place: &Place,
        read: Read,
    ) -> Result<usize> {
        ensure!(path.len() <= MAX_DEPTH, "{}: more than {MAX_DEPTH} modules within modules", file.display());
        let (names, declared) = names_of(items);
        let hidden = |mention: &&Mention| {
            mention.kind == Kind::Macro && mention.names.last().is_some_and(|name| name == "include")
        };
        if let Some(hidden) = names.mentions.iter().find(hidden) {
            bail!("{}:{}: code behind `include!` cannot be checked", file.display(), hidden.line);
        }
        let id = self.modules.len();
        self.modules.push(Module {
            path: path.to_vec(),
            parent,
            file: file.into(),
            inner: BTreeMap::new(),
            names,
        });
        for module in declared {
            let name = module.ident.unraw().to_string();
            let path = [path, std::slice::from_ref(&name)].concat();
            let inner = if let Some((_, items)) = &module.content {
                let below = place.by_name.join(path_attribute(module).unwrap_or_else(|| name.clone()));
                let place = Place { by_name: below.clone(), by_path: below };
                self.add(&path, id, file, items, &place, read)?
            } else {
                let (file, text) = find(module, &name, place, read).with_context(|| {
                    let line = module.ident.span().start().line;
                    format!("{}:{line}: no file for `mod {name}`", file.display())
                })?;
                let parsed = parse(&file, &text)?;
                if only_in_tests(&parsed.attrs) {
                    continue;
                }
                let place = place_of(&file, path_attribute(module).is_some());
                self.add(&path, id, &file, &parsed.items, &place, read)?
            };
            self.modules[id].inner.entry(name).or_default().push(inner);
        }
        Ok(id)
    }
}

/// The file of a module, and what stands in it.
fn find(module: &ItemMod, name: &str, place: &Place, read: Read) -> Result<(PathBuf, String)> {
    let files = match path_attribute(module) {
        Some(path) => vec![tidy(&place.by_path.join(path))],
        None => vec![place.by_name.join(format!("{name}.rs")), place.by_name.join(name).join("mod.rs")],
    };
    for file in &files {
        match read(file) {
            Ok(text) => return Ok((file.clone(), text)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error).with_context(|| format!("cannot read {}", file.display())),
        }
    }
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    bail!("looked for {}", files.join(" and "))
}

/// `mod.rs`, and a file that is named by `#[path]`, have their modules beside them; other files in a folder of their
/// name.
fn place_of(file: &Path, named: bool) -> Place {
    let here = file.parent().unwrap_or(Path::new("")).to_path_buf();
    let beside = named || file.file_name().is_some_and(|name| name == "mod.rs");
    let by_name = if beside { here.clone() } else { file.with_extension("") };
    Place { by_name, by_path: here }
}

/// Without `..`, so that one file has one name.
fn tidy(path: &Path) -> PathBuf {
    let mut tidied = PathBuf::new();
    for part in path.components() {
        if part.as_os_str() != ".." || !tidied.pop() {
            tidied.push(part);
        }
    }
    tidied
}

fn path_attribute(module: &ItemMod) -> Option<String> {
    let attribute = module.attrs.iter().find(|attribute| attribute.path().is_ident("path"))?;
    let Meta::NameValue(pair) = &attribute.meta else { return None };
    let Expr::Lit(value) = &pair.value else { return None };
    let Lit::Str(text) = &value.lit else { return None };
    Some(text.value())
}

fn parse(file: &Path, text: &str) -> Result<syn::File> {
    let wrong = |what: String, line: usize| format!("{}:{line}: {what}", file.display());
    let tokens: TokenStream = text.parse().map_err(|error: proc_macro2::LexError| {
        anyhow::anyhow!(wrong(error.to_string(), error.span().start().line))
    })?;
    if let Some(line) = nested_too_deeply(tokens.clone()) {
        bail!(wrong(format!("more than {MAX_NESTING} brackets within brackets"), line));
    }
    syn::parse2(tokens).map_err(|error| anyhow::anyhow!(wrong(error.to_string(), error.span().start().line)))
}

/// The line where it is.
fn nested_too_deeply(tokens: TokenStream) -> Option<usize> {
    let mut levels = vec![tokens.into_iter()];
    while let Some(level) = levels.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) if levels.len() > MAX_NESTING => {
                return Some(group.span().start().line);
            }
            Some(TokenTree::Group(group)) => levels.push(group.stream().into_iter()),
            Some(_) => {}
            None => {
                levels.pop();
            }
        }
    }
    None
}
