//! What became of the entities, for people.

use std::collections::BTreeMap;

use crate::map::{RemarkKind, drawing::Drawing};

/// Most kinds of entities that are told apart when they are dropped.
const MOST_KINDS: usize = 12;
/// Longest name of a kind, in letters.
const LONGEST: usize = 40;

/// Entities by what became of them.
#[derive(Debug, Default)]
pub(super) struct Counts {
    kinds: BTreeMap<String, usize>,
    others: usize,
    pub(super) dark: usize,
    pub(super) paper: usize,
    pub(super) ignored: usize,
    pub(super) small: usize,
    pub(super) blocks: usize,
}

impl Counts {
    /// Counts one of a kind that is not read.
    pub(super) fn drop(&mut self, kind: &str) {
        if self.kinds.len() < MOST_KINDS || self.kinds.contains_key(kind) {
            *self.kinds.entry(kind.chars().take(LONGEST).collect()).or_default() += 1;
        } else {
            self.others += 1;
        }
    }

    /// Says it all, or why there is nothing where there is nothing.
    pub(super) fn said(self, mut drawing: Drawing, merged: usize) -> Result<Drawing, String> {
        let counts = self;
        let import = &mut drawing.import;
        let read = [
            (drawing.walls.len(), "lines as walls"),
            (drawing.solids.len(), "areas as rock"),
            (drawing.free.len(), "areas as free space"),
        ];
        for (count, what) in read {
            import.say(RemarkKind::Read, count, what);
        }
        import.say(RemarkKind::Merged, merged, "lines that meet others end to end");
        let kinds =
            counts.kinds.into_iter().map(|(kind, count)| (count, format!("entities of the kind {kind}")));
        let dropped = [
            (counts.others, "entities of other kinds"),
            (counts.dark, "entities that are invisible, or on layers that are off or frozen"),
            (counts.paper, "entities in paper space"),
            (counts.ignored, "entities on layers called notes, background, ignore or defpoints"),
            (counts.small, "entities without an extent or a name"),
            (counts.blocks, "inserts of blocks that are not in the file"),
        ];
        let dropped: Vec<(usize, String)> =
            kinds.chain(dropped.map(|(count, what)| (count, what.to_owned()))).collect();
        if drawing.free.is_empty() && drawing.solids.is_empty() && drawing.walls.is_empty() {
            let seen =
                dropped.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
            let seen = seen.collect::<Vec<_>>().join(", ");
            return Err(format!(
                "nothing in it is a wall, rock or free space ({seen}); expected lines, polylines or arcs"
            ));
        }
        for (count, what) in dropped {
            import.say(RemarkKind::Dropped, count, what);
        }
        Ok(drawing)
    }
}
