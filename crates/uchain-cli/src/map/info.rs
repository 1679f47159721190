//! `uchain map info`: what a map is.

use std::fmt::Write as _;

use serde::Serialize;
use uchain_sim::{
    map::{Import, Map, MapNumbers, Material, Place},
    registry::Registry,
    world::MotionParams,
};

use super::{
    args::{Info, Read},
    ends::Ends,
    make::quoted,
    metres,
};
use crate::{exit::Failure, waiting::spinner};

/// Places that are named for people; --json has all.
const NAMED: usize = 12;

/// Everything known of a map.
#[derive(Debug, Serialize)]
struct Told<'a> {
    map: &'a str,
    #[serde(flatten)]
    import: &'a Import,
    /// Lower left and upper right corner, in the map file's own frame (m).
    bounds_m: [[f64; 2]; 2],
    size_m: [f64; 2],
    walls: usize,
    wall_loops: usize,
    wall_length_m: f64,
    places: &'a [Place],
    materials: &'a [Material],
    /// Of its passages; the reason if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    numbers: Option<MapNumbers>,
    /// A base and a goal to begin with.
    ends: Option<Ends>,
    /// The options by which it was read.
    #[serde(skip)]
    how: String,
    #[serde(skip)]
    why_not: Option<String>,
}

pub(super) fn info(registry: Registry, asked: &Info) -> Result<(), Failure> {
    let waiting = spinner(asked.say.progress(), "reading the map");
    let map = super::read(registry, &asked.read)?;
    let told = Told::of(&map, &asked.read);
    waiting.finish_and_clear();
    let json = serde_json::to_string_pretty(&told)? + "\n";
    asked.say.result(&json, || told.text())
}

impl<'a> Told<'a> {
    fn of(map: &'a Map, read: &'a Read) -> Self {
        let graph = map.tunnel_graph();
        let numbers = graph.as_ref().ok().map(|graph| map.numbers(graph, MotionParams::default().radius_m));
        let ends = graph.as_ref().ok().zip(numbers.as_ref());
        let ends = ends.and_then(|(graph, numbers)| Ends::of(map, graph, numbers.uav_needs_m));
        let (low, high) = map.bounds();
        let size = high - low;
        Self {
            map: &read.what,
            how: read.words(),
            import: map.import(),
            bounds_m: [low, high].map(|corner| map.to_file(corner).map(to_a_millimetre)),
            size_m: [size.x, size.y].map(|side| to_a_millimetre(side.into())),
            walls: map.walls().len(),
            wall_loops: map.loops().count(),
            wall_length_m: map.walls().iter().map(|wall| f64::from(wall.a.distance(wall.b))).sum(),
            places: map.places(),
            materials: map.materials(),
            numbers,
            ends,
            why_not: graph.err().map(|error| error.to_string()),
        }
    }

    fn text(&self) -> String {
        let format = if self.import.format.is_empty() { "drawn in the scenario" } else { self.import.format };
        let mut text = format!("{}: {format}\n", self.map);
        for remark in &self.import.remarks {
            // Writing to a String cannot fail, here and below.
            let _ = writeln!(text, "  {remark}");
        }
        let [[x0, y0], [x1, y1]] = self.bounds_m;
        let [across, up] = self.size_m;
        let _ = writeln!(
            text,
            "size       {across:.2} × {up:.2} m, from ({x0}, {y0}) to ({x1}, {y1}) in the map's own frame"
        );
        let s = if self.wall_loops == 1 { "" } else { "s" };
        let _ = writeln!(
            text,
            "walls      {} in {} loop{s}, {}",
            self.walls,
            self.wall_loops,
            metres(self.wall_length_m)
        );
        if let Some(why) = &self.why_not {
            let _ = writeln!(text, "passages   not known: {why}");
        }
        if let Some(numbers) = &self.numbers {
            text += &passages(numbers);
        }
        if !self.places.is_empty() {
            let words =
                self.places.iter().map(|Place { name, at_m: [x, y], .. }| format!("{name} ({x:.2}, {y:.2})"));
            let names = names(words);
            let _ = writeln!(text, "places     {}: {names}", self.places.len());
        }
        if !self.materials.is_empty() {
            let words = |material: &Material| match material.loss_db {
                Some(loss_db) => format!("{} ({loss_db} dB)", material.name),
                None => material.name.clone(),
            };
            let words: Vec<String> = self.materials.iter().map(words).collect();
            let _ = writeln!(text, "materials  {}", words.join(", "));
        }
        if let Some(Ends { base_m: [bx, by], goal_m: [gx, gy], way_m }) = self.ends {
            let _ =
                writeln!(text, "farthest   {bx},{by} and {gx},{gy}: {} apart along the way", metres(way_m));
            let _ = writeln!(
                text,
                "next       uchain plan {}{} --base={bx},{by} --goal={gx},{gy}",
                quoted(self.map),
                self.how
            );
        }
        text
    }
}

/// What there is to say of passages.
fn passages(numbers: &MapNumbers) -> String {
    let many =
        |count: usize, one: &str, more: &str| format!("{count} {}", if count == 1 { one } else { more });
    let pieces = match numbers.pieces {
        1 => "in one piece".to_owned(),
        count => format!("in {count} pieces, {:.1} % of it in the largest", 100.0 * numbers.largest_share),
    };
    let mut text = format!("free area  {:.0} m² {pieces}\n", numbers.free_area_m2);
    // Writing to a String cannot fail, here and below.
    let _ = writeln!(
        text,
        "passages   {}, {} of them; {}, {}, {}",
        numbers.passages,
        metres(numbers.length_m),
        many(numbers.dead_ends, "dead end", "dead ends"),
        many(numbers.junctions, "junction", "junctions"),
        many(numbers.loops, "way round", "ways round"),
    );
    if let Some(width) = &numbers.width_m {
        let _ = write!(
            text,
            "widths     {:.2} to {:.2} m, median {:.2} m, a tenth below {:.2} m",
            width.min, width.max, width.median, width.p10
        );
        if let Some(narrowest) = numbers.narrowest {
            let [x, y] = narrowest.at_m;
            let _ = write!(text, "; narrowest at ({x:.2}, {y:.2})");
        }
        text.push('\n');
    }
    let narrow = |length_m: f64| if length_m > 0.0 { metres(length_m) } else { "nothing".to_owned() };
    let _ = writeln!(
        text,
        "too narrow {} of passage for a UAV (it needs {:.2} m), {} for a star of the exploration (it needs {:.2} m)",
        narrow(numbers.too_narrow_m),
        numbers.uav_needs_m,
        narrow(numbers.too_narrow_for_a_star_m),
        numbers.star_needs_m,
    );
    text
}

/// The first of the names.
fn names(mut names: impl Iterator<Item = String>) -> String {
    let first: Vec<String> = names.by_ref().take(NAMED).collect();
    let more = if names.next().is_some() { ", …" } else { "" };
    first.join(", ") + more
}

fn to_a_millimetre(m: f64) -> f64 {
    (m * 1000.0).round() / 1000.0
}
