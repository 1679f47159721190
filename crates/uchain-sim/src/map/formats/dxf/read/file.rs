//! A DXF file as its sections: pairs of lines, the first a number that says what the second is.
//! Format: Autodesk, DXF Reference.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::entity::{Entity, Opened};

/// Most entities of a file, those of blocks among them.
const MOST_ENTITIES: usize = 300_000;
/// Most layers and most blocks.
const MOST_NAMES: usize = 10_000;

/// What of a file counts.
#[derive(Debug, Default)]
pub(super) struct File<'a> {
    /// The unit's name and its metres.
    pub(super) unit: Option<(&'static str, f64)>,
    /// Layers that are off or frozen.
    pub(super) dark: BTreeSet<&'a str>,
    pub(super) blocks: BTreeMap<&'a str, Block<'a>>,
    pub(super) entities: Vec<Entity<'a>>,
}

/// Entities that are drawn where they are inserted.
#[derive(Debug, Default)]
pub(super) struct Block<'a> {
    pub(super) base: DVec2,
    pub(super) entities: Vec<Entity<'a>>,
}

/// Units by their number in `$INSUNITS`.
const UNITS: [(u8, &str, f64); 14] = [
    (1, "inches", 0.0254),
    (2, "feet", 0.3048),
    (3, "miles", 1609.344),
    (4, "millimetres", 1e-3),
    (5, "centimetres", 1e-2),
    (6, "metres", 1.0),
    (7, "kilometres", 1e3),
    (8, "microinches", 2.54e-8),
    (9, "mils", 2.54e-5),
    (10, "yards", 0.9144),
    (13, "micrometres", 1e-6),
    (14, "decimetres", 0.1),
    (15, "decametres", 10.0),
    (21, "US survey feet", 1200.0 / 3937.0),
];

impl<'a> File<'a> {
    pub(super) fn of(text: &'a str) -> Result<Self, String> {
        let mut file = Self::default();
        let mut section = "";
        let mut block = "";
        let mut read = 0_usize;
        for entity in Entities::of(text) {
            let entity = entity?;
            // What stands in the sections of drawn things is taken apart when it is drawn.
            let opened = || {
                entity.open().map_err(|why| format!("line {}: {}: {why}", entity.line, shown(entity.kind)))
            };
            read += 1;
            if read > MOST_ENTITIES {
                return Err(format!(
                    "more than {MOST_ENTITIES} entities; expected fewer: cut the drawing into several"
                ));
            }
            match entity.kind {
                "SECTION" => {
                    let head = opened()?;
                    section = head.text(2).unwrap_or_default();
                    if section == "HEADER" {
                        file.unit = unit(&head);
                    }
                }
                "ENDSEC" => section = "",
                "EOF" => break,
                "LAYER" if section == "TABLES" => {
                    let layer = opened()?;
                    let is_dark =
                        layer.number(62).is_some_and(|colour| colour < 0.0) || layer.flags(70) & 1 != 0;
                    file.dark.extend(layer.text(2).filter(|_| is_dark && file.dark.len() < MOST_NAMES));
                }
                "BLOCK" if section == "BLOCKS" => {
                    let head = opened()?;
                    block = head.text(2).unwrap_or_default();
                    if file.blocks.len() >= MOST_NAMES {
                        return Err(format!(
                            "more than {MOST_NAMES} blocks; expected fewer: purge those that are not used"
                        ));
                    }
                    let base = head.place(10).unwrap_or_default();
                    file.blocks.insert(block, Block { base, entities: Vec::new() });
                }
                "ENDBLK" => block = "",
                _ if section == "BLOCKS" => {
                    if let Some(block) = file.blocks.get_mut(block) {
                        block.entities.push(entity);
                    }
                }
                _ if section == "ENTITIES" => file.entities.push(entity),
                _ => {}
            }
        }
        if file.entities.is_empty() {
            return Err("no section ENTITIES with anything in it; expected a DXF drawing in text".into());
        }
        Ok(file)
    }

    /// The longer side of the box around the first places of what is drawn (units).
    pub(super) fn size(&self) -> f64 {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for at in self.entities.iter().filter_map(|entity| entity.open().ok()?.place(10)) {
            (low, high) = (low.min(at), high.max(at));
        }
        (high - low).max_element().max(0.0)
    }
}

fn shown(kind: &str) -> String {
    kind.chars().take(40).collect()
}

fn unit(header: &Opened) -> Option<(&'static str, f64)> {
    let name = header.pairs.iter().position(|&pair| pair == (9, "$INSUNITS"))?;
    let number: u8 = header.pairs.get(name + 1).filter(|&&(code, _)| code == 70)?.1.parse().ok()?;
    UNITS.iter().find(|&&(of, ..)| of == number).map(|&(_, name, unit_m)| (name, unit_m))
}

/// What begins with a pair of code 0 and ends before the next, one after the other.
struct Entities<'a> {
    rest: &'a str,
    /// The line that `rest` begins with, counted from 1.
    line: usize,
}

impl<'a> Entities<'a> {
    fn of(text: &'a str) -> Self {
        Self { rest: text, line: 1 }
    }

    /// A pair, and what follows it; `None` at the end.
    fn pair(text: &'a str, line: usize) -> Option<Result<(i32, &'a str, &'a str), String>> {
        if text.trim_start().is_empty() {
            return None;
        }
        let (code, rest) = text.split_once('\n').unwrap_or((text, ""));
        let (value, rest) = rest.split_once('\n').unwrap_or((rest, ""));
        let code = code.trim();
        Some(code.parse().map(|code| (code, value.trim(), rest)).map_err(|_| {
            let shown: String = code.chars().take(40).collect();
            format!("line {line}: {shown:?}: expected a whole number, the code of a pair")
        }))
    }
}

impl<'a> Iterator for Entities<'a> {
    type Item = Result<Entity<'a>, String>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut found: Option<(&str, &str, usize)> = None;
        loop {
            let (text, line) = (self.rest, self.line);
            let pair = match Self::pair(text, line) {
                Some(Ok(pair)) => Some(pair),
                Some(Err(why)) => {
                    (self.rest, self.line) = ("", line);
                    return Some(Err(why));
                }
                None => None,
            };
            match (pair, found) {
                (None, None) => return None,
                (None | Some((0, ..)), Some((kind, body, line))) => {
                    let body = &body[..body.len() - text.len()];
                    return Some(Ok(Entity { kind, body, line }));
                }
                (Some((code, value, rest)), _) => {
                    if code == 0 {
                        found = Some((value, rest, line));
                    }
                    (self.rest, self.line) = (rest, line + 2);
                }
            }
        }
    }
}
