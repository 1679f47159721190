//! What became of the elements, for people.

use crate::map::{Import, RemarkKind};

/// Elements by what became of them.
#[derive(Debug, Default)]
pub(super) struct Counts {
    pub(super) walls: usize,
    pub(super) rock: usize,
    pub(super) free: usize,
    pub(super) thin: usize,
    pub(super) texts: usize,
    pub(super) images: usize,
    pub(super) hidden: usize,
    pub(super) ignored: usize,
    pub(super) unpainted: usize,
    pub(super) white: usize,
    pub(super) points: usize,
    pub(super) damaged: usize,
    pub(super) links: usize,
    pub(super) clipped: usize,
    pub(super) unknown: usize,
    pub(super) rules: usize,
}

impl Counts {
    /// Says all that is not nothing.
    pub(super) fn say(&self, import: &mut Import, wall_m: f64) {
        let read = [
            (self.walls, "strokes as walls"),
            (self.rock, "areas as rock"),
            (self.free, "elements as free space"),
        ];
        for (count, what) in read {
            import.say(RemarkKind::Read, count, what);
        }
        let thin = format!("strokes thinner than wall_m as walls of {wall_m} m");
        import.say(RemarkKind::Guessed, self.thin, thin);
        let clipped = "elements with a clip path or a mask, which are not applied, as if whole";
        import.say(RemarkKind::Guessed, self.clipped, clipped);
        let dropped = [
            (self.texts, "text elements (those in a layer `places` name places)"),
            (self.images, "images or other embedded objects"),
            (self.hidden, "hidden elements (display none, visibility hidden, opacity 0)"),
            (self.ignored, "elements called notes, background or ignore"),
            (self.unpainted, "elements neither filled nor stroked"),
            (
                self.white,
                "white elements (white is paper; free space is what is called free, room or passage)",
            ),
            (self.points, "elements without an extent"),
            (self.damaged, "damaged pieces of path data or transforms"),
            (self.links, "uses of what is not in the file"),
            (self.unknown, "elements of unknown kinds"),
            (self.rules, "style rules whose selector is more than a tag, a class or an id"),
        ];
        for (count, what) in dropped {
            import.say(RemarkKind::Dropped, count, what);
        }
    }

    /// Why there is nothing, where there is nothing.
    pub(super) fn nothing(&self) -> String {
        let mut import = Import::default();
        self.say(&mut import, 0.0);
        let what: Vec<String> =
            import.remarks.iter().map(|said| format!("{} {}", said.count, said.what)).collect();
        let seen = if what.is_empty() { "no element is drawn".to_owned() } else { what.join(", ") };
        format!("nothing in it is a wall, rock or free space ({seen}); expected strokes or filled areas")
    }
}
