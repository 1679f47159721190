//! `uchain map make`: a map out of nothing but a seed.

use uchain_sim::map::make::{Extent, Wish};

use super::{args::Make, convert::Written, metres};
use crate::{exit::Failure, waiting::spinner};

pub(super) fn make(asked: &Make) -> Result<(), Failure> {
    let waiting = spinner(!asked.quiet.is_quiet(), "making the map");
    let extent = asked.length.map(Extent::Length).or(asked.size.map(Extent::Size));
    let (kind, seed) = (asked.kind, asked.seed);
    let wish = Wish { kind, seed, extent, width_m: asked.width, roughness: asked.roughness };
    let made = wish.make().map_err(|error| Failure::Usage(error.to_string()))?;
    let written = Written::of(&made.map, &asked.out, asked.out_cell)?;
    written.write(&[], asked.force)?;
    waiting.finish_and_clear();
    asked.quiet.report(|| {
        let size = made.map.bounds().1 - made.map.bounds().0;
        let [bx, by] = made.base_m;
        let [gx, gy] = made.goal_m;
        format!(
            "{}, seed {seed}: {:.1} × {:.1} m, passages {} m wide, {} of them\n{}\
             base {bx},{by} and goal {gx},{gy}: {} apart, along the way\n\
             next: uchain plan {} --base={bx},{by} --goal={gx},{gy}\n",
            kind.name(),
            size.x,
            size.y,
            made.width_m,
            metres(made.length_m),
            written.words,
            metres(made.way_m),
            quoted(&written.main.to_string_lossy()),
        )
    })
}

/// As a shell takes it.
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "._-/+,=:@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
