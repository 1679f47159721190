//! Which modules a path leads through.
//!
//! Names are looked up as the compiler does it, but for three simplifications, all on the side of finding more: a name
//! declared twice (under conditions, or as a macro and a module) means both; a glob brings in everything; and private
//! imports are passed on too. The last one finds no circle that is not there: who reaches an import of another room
//! imports that room already.

use std::collections::BTreeSet;

use anyhow::{Result, bail};

use super::{
    paths::Import,
    tokens::{Kind, Mention},
    tree::Tree,
};

/// Names that may be looked up for one path; none of ours needs a hundred.
const MAX_LOOKUPS: usize = 100_000;

/// One module needs another.
pub(super) struct Edge {
    pub(super) from: usize,
    pub(super) to: usize,
    /// Where it says so: an index into its module's mentions.
    pub(super) mention: usize,
}

/// Every module that any module needs.
pub(super) fn edges(tree: &Tree) -> Result<Vec<Edge>> {
    let mut edges = Vec::new();
    for (from, module) in tree.modules.iter().enumerate() {
        for (i, mention) in module.names.mentions.iter().enumerate() {
            let mut lookup =
                Lookup { tree, touched: BTreeSet::new(), open: BTreeSet::new(), left: MAX_LOOKUPS };
            lookup.mention(from, mention);
            if lookup.left == 0 {
                let (file, line) = (module.file.display(), mention.line);
                bail!("{file}:{line}: too many ways lead to {}", mention.text());
            }
            edges.extend(lookup.touched.into_iter().map(|to| Edge { from, to, mention: i }));
        }
    }
    Ok(edges)
}

struct Lookup<'a> {
    tree: &'a Tree,
    /// Modules in which a name was found, or that are named themselves.
    touched: BTreeSet<usize>,
    /// Names that are being looked up: globs and renamed imports may go round in circles.
    open: BTreeSet<(usize, String)>,
    left: usize,
}

/// What a name means in a module.
#[derive(Default)]
struct Meaning {
    /// It is one of these modules,
    modules: BTreeSet<usize>,
    /// or at least it is something.
    known: bool,
}

impl Lookup<'_> {
    fn mention(&mut self, from: usize, mention: &Mention) {
        match (mention.kind, mention.names.as_slice()) {
            (Kind::Glob, names) => {
                let modules = self.follow(from, names);
                self.everything_in(&modules);
            }
            // Macros without a path are seen from where they are defined on, in the modules below too, and, marked
            // so, by all that follows.
            (Kind::Macro, [name]) => {
                let defined = |module: &usize| self.tree.modules[*module].names.macros.contains(name);
                let all: Vec<usize> = (0..self.tree.modules.len()).filter(defined).collect();
                // Of several under one name, the nearest.
                let nearest = all.iter().map(|module| self.common(from, *module)).max();
                let is_nearest = |module: &usize| Some(self.common(from, *module)) == nearest;
                let all: Vec<usize> = all.into_iter().filter(is_nearest).collect();
                self.touched.extend(all);
            }
            (Kind::Macro, [root, name]) if root == "crate" && self.exported(name) => {}
            (Kind::Name | Kind::Macro, names) => {
                self.follow(from, names);
            }
        }
    }

    /// The modules that a path leads to; none if it ends at an item or outside the crate.
    fn follow(&mut self, from: usize, path: &[String]) -> BTreeSet<usize> {
        let mut here = BTreeSet::from([from]);
        let mut rest = path;
        while let Some((first, after)) = rest.split_first() {
            here = match first.as_str() {
                "crate" => BTreeSet::from([0]),
                "super" => here.iter().map(|module| self.tree.modules[*module].parent).collect(),
                "self" => here,
                "" => match after.split_first() {
                    Some((name, after)) if self.tree.modules[0].names.own.contains(name) => {
                        rest = after;
                        here = BTreeSet::from([0]);
                        continue;
                    }
                    _ => return BTreeSet::new(),
                },
                _ => break,
            };
            rest = after;
        }
        for (i, name) in rest.iter().enumerate() {
            let relative = i == 0 && rest.len() == path.len();
            let mut next = BTreeSet::new();
            for module in here {
                let meaning = self.named(module, name);
                if meaning.known {
                    self.touched.insert(module);
                } else if relative && self.tree.modules[0].names.own.contains(name) {
                    next.insert(0);
                }
                next.extend(meaning.modules);
            }
            // Also when the next name is not found in it: a macro may make it.
            self.touched.extend(&next);
            here = next;
        }
        self.touched.extend(&here);
        here
    }

    /// Looks a name up in a module.
    fn named(&mut self, module: usize, name: &str) -> Meaning {
        self.left = self.left.saturating_sub(1);
        let key = (module, name.to_owned());
        if self.left == 0 || !self.open.insert(key.clone()) {
            return Meaning::default();
        }
        let tree = self.tree;
        let (inner, names) = (&tree.modules[module].inner, &tree.modules[module].names);
        let modules: BTreeSet<usize> = inner.get(name).into_iter().flatten().copied().collect();
        let here = names.items.contains(name) || names.macros.contains(name);
        let mut meaning = Meaning { known: here || !modules.is_empty(), modules };
        for import in &names.imports {
            if import.name.as_deref() == Some(name) {
                meaning.modules.extend(self.follow(module, &import.path));
                meaning.known = true;
            }
        }
        if module == 0 && self.exported(name) {
            meaning.known = true;
        }
        if !meaning.known {
            for import in &names.imports {
                if import.name.is_none() {
                    self.through(module, import, name, &mut meaning);
                }
            }
        }
        self.open.remove(&key);
        meaning
    }

    /// Looks a name up behind a glob. What the search passes counts only if it is there.
    fn through(&mut self, module: usize, glob: &Import, name: &str, meaning: &mut Meaning) {
        let before = self.touched.clone();
        let mut found = false;
        for target in self.follow(module, &glob.path) {
            let there = self.named(target, name);
            found |= there.known;
            meaning.modules.extend(there.modules);
        }
        if found {
            meaning.known = true;
        } else {
            self.touched = before;
        }
    }

    /// Follows all that a glob over these modules brings in.
    fn everything_in(&mut self, modules: &BTreeSet<usize>) {
        for &module in modules {
            let key = (module, "*".to_owned());
            self.left = self.left.saturating_sub(1);
            // Left open on purpose: once is enough.
            if self.left == 0 || !self.open.insert(key) {
                continue;
            }
            let tree = self.tree;
            for import in &tree.modules[module].names.imports {
                let further = self.follow(module, &import.path);
                if import.name.is_none() {
                    self.everything_in(&further);
                }
            }
        }
    }

    /// Whether the root offers a macro of this name; where it is defined counts.
    fn exported(&mut self, name: &str) -> bool {
        let defined = |module: &usize| self.tree.modules[*module].names.exported.contains(name);
        let all: Vec<usize> = (0..self.tree.modules.len()).filter(defined).collect();
        self.touched.extend(&all);
        !all.is_empty()
    }

    /// How many levels from the root two modules have in common.
    fn common(&self, a: usize, b: usize) -> usize {
        let (a, b) = (&self.tree.modules[a].path, &self.tree.modules[b].path);
        a.iter().zip(b).take_while(|(a, b)| a == b).count()
    }
}
