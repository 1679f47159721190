//! Rooms, who imports whom, and the circles among them.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::Write as _,
    path::{Path, PathBuf},
};

use super::{Nested, resolve::Edge, tree::Tree};

/// Places that are named for one import between rooms; the rest is counted.
const PLACES: usize = 5;

/// The imports between the rooms of one crate, or of one of its rooms.
pub(crate) struct Graph {
    /// What it is of.
    name: String,
    rooms: BTreeSet<String>,
    imports: BTreeMap<(String, String), BTreeSet<Place>>,
    /// Rooms that must not import each other, circle or not.
    strangers: BTreeSet<String>,
}

/// A path in a source.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    file: PathBuf,
    line: usize,
    text: String,
    /// It begins with a name of its own module.
    is_relative: bool,
}

impl Graph {
    /// The rooms of a crate. The root is none: it may know all of them.
    pub(super) fn of_rooms(package: &str, root: &Path, tree: &Tree, edges: &[Edge]) -> Self {
        let file = root.file_name().unwrap_or_default().to_string_lossy();
        let name = if file == "lib.rs" { package.to_owned() } else { format!("{package} ({file})") };
        Self::new(name, tree, edges, |module| tree.modules[module].path.first().cloned())
    }

    /// The rooms within a room, if the crate has it.
    pub(super) fn of_nested(nested: &Nested, tree: &Tree, edges: &[Edge]) -> Option<Self> {
        tree.modules[0].inner.get(nested.room)?;
        let room = |module: usize| match tree.modules[module].path.as_slice() {
            [outer, inner, ..] if outer == nested.room => Some(inner.clone()),
            _ => None,
        };
        let mut graph = Self::new(format!("{}, {}", nested.package, nested.room), tree, edges, room);
        let folders = tree.modules.iter().filter(|module| {
            let parent = &tree.modules[module.parent];
            module.file.ends_with("mod.rs") || (parent.path.len() == 2 && parent.file != module.file)
        });
        let names = folders.filter(|module| module.path.len() >= 2 && module.path[0] == nested.room);
        graph.strangers = names.map(|module| module.path[1].clone()).collect();
        Some(graph)
    }

    fn new(name: String, tree: &Tree, edges: &[Edge], room: impl Fn(usize) -> Option<String>) -> Self {
        let rooms = (0..tree.modules.len()).filter_map(&room).collect();
        let mut imports: BTreeMap<_, BTreeSet<Place>> = BTreeMap::new();
        for edge in edges {
            let (Some(from), Some(to)) = (room(edge.from), room(edge.to)) else { continue };
            if from != to {
                let module = &tree.modules[edge.from];
                let mention = &module.names.mentions[edge.mention];
                let is_relative = !mention
                    .names
                    .first()
                    .is_some_and(|first| ["crate", "self", "super", ""].contains(&first.as_str()));
                let (line, text) = (mention.line, mention.text());
                let place = Place { file: module.file.clone(), line, text, is_relative };
                imports.entry((from, to)).or_default().insert(place);
            }
        }
        Self { name, rooms, imports, strangers: BTreeSet::new() }
    }

    /// Who imports whom, one line a room.
    pub(crate) fn table(&self) -> String {
        let mut table = format!("{}: {} rooms\n", self.name, self.rooms.len());
        for room in &self.rooms {
            let to: Vec<&str> =
                self.imports.keys().filter(|(from, _)| from == room).map(|(_, to)| to.as_str()).collect();
            // Writing to a String cannot fail.
            let _ = writeln!(
                table,
                "  {room} -> {}",
                if to.is_empty() { "nothing".into() } else { to.join(" ") }
            );
        }
        table
    }

    /// Every circle, and every import between strangers, in words.
    pub(super) fn complaints(&self, below: &Path) -> Vec<String> {
        let mut complaints: Vec<String> = self
            .circles()
            .iter()
            .map(|circle| {
                let names: Vec<&str> = circle.iter().map(String::as_str).collect();
                let mut text =
                    format!("{}: a circle of {} rooms: {}\n", self.name, names.len(), names.join(", "));
                self.list(&mut text, below, |from, to| circle.contains(from) && circle.contains(to));
                text
            })
            .collect();
        let mut text = format!("{}: no folder in it may import another one\n", self.name);
        if self
            .list(&mut text, below, |from, to| self.strangers.contains(from) && self.strangers.contains(to))
        {
            complaints.push(text);
        }
        complaints
    }

    /// Rooms that reach each other, two and more at a time.
    fn circles(&self) -> Vec<BTreeSet<String>> {
        let reach: BTreeMap<&String, BTreeSet<&String>> =
            self.rooms.iter().map(|room| (room, self.reached_from(room))).collect();
        let mut circles = Vec::new();
        let mut done = BTreeSet::new();
        for (room, reached) in &reach {
            let circle: BTreeSet<String> = reached
                .iter()
                .filter(|other| reach[**other].contains(room))
                .map(ToString::to_string)
                .collect();
            if circle.len() > 1 && done.insert(circle.clone()) {
                circles.push(circle);
            }
        }
        circles
    }

    /// By one import or more.
    fn reached_from<'a>(&'a self, room: &'a String) -> BTreeSet<&'a String> {
        let mut reached = BTreeSet::new();
        let mut next = vec![room];
        while let Some(room) = next.pop() {
            let imported = self.imports.keys().filter(|(from, _)| from == room).map(|(_, to)| to);
            next.extend(imported.filter(|to| reached.insert(*to)));
        }
        reached
    }

    /// Writes the imports that are asked for, each with its places; whether there are any.
    fn list(&self, text: &mut String, below: &Path, asked: impl Fn(&String, &String) -> bool) -> bool {
        let mut any = false;
        for ((from, to), places) in self.imports.iter().filter(|((from, to), _)| asked(from, to)) {
            any = true;
            let _ = writeln!(text, "  {from} imports {to}:");
            // A name that an import brings in says nothing that the import does not say.
            let imports: Vec<&Place> = places.iter().filter(|place| !place.is_relative).collect();
            let shown = if imports.is_empty() { places.iter().collect() } else { imports };
            for place in shown.iter().take(PLACES) {
                let file = place.file.strip_prefix(below).unwrap_or(&place.file);
                let _ = writeln!(text, "    {}:{}: {}", file.display(), place.line, place.text);
            }
            if shown.len() > PLACES {
                let _ = writeln!(text, "    and {} more", shown.len() - PLACES);
            }
        }
        any
    }
}
