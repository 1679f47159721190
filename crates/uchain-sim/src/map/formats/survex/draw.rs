//! From a survey to a map: which passages, with which words, and their outlines.

use std::path::Path;

use super::{
    SurvexConfig,
    cave::Cave,
    choose::{Choice, NoChoice, all, way},
    name,
    read::Survey,
};
use crate::map::{
    Import, Map, MapError, Outside, Place, RemarkKind,
    drawing::{Drawing, Shape},
};

/// Edges shorter than this are drawn together (m).
const SNAP_M: f64 = 0.02;
/// Most passages of a map.
const MOST_PASSAGES: usize = 50_000;

/// The map of a survey. Messages call the file by its path.
pub(super) fn map(survey: Survey, settings: &SurvexConfig, file: &Path) -> Result<Map, MapError> {
    let wrong = |why: String| MapError::Read { file: file.to_owned(), why };
    let mut import = Import::of(super::FORMAT.name);
    let cave = Cave::new(survey, settings.missing_width_m, &mut import);
    if cave.passages.is_empty() {
        return Err(wrong("no leg below ground is in it".to_owned()));
    }
    let station = |key: &'static str, wanted: &str| {
        let wrong =
            |expected| MapError::Key { file: file.to_owned(), key, got: format!("\"{wanted}\""), expected };
        name::node_of(&cave, wanted).map_err(wrong)
    };
    let from = settings.from.as_ref().map(|from| station("from", from)).transpose()?;
    let to = settings.to.as_ref().map(|to| station("to", to)).transpose()?;
    let chosen = match (from, to) {
        (Some(from), Some(to)) if from == to => {
            let expected = "another station than from".to_owned();
            let got = settings.to.clone().unwrap_or_default();
            return Err(MapError::Key { file: file.to_owned(), key: "to", got, expected });
        }
        (Some(from), Some(to)) => way(&cave, from, to, settings.branch_m, settings.level_gap_m),
        _ if cave.passages.len() > MOST_PASSAGES => {
            let many = cave.passages.len();
            let why = format!(
                "{many} passages, more than the {MOST_PASSAGES} of a map; cut a part out with the keys from and to"
            );
            return Err(wrong(why));
        }
        (from, _) => all(&cave, from.unwrap_or_else(|| first(&cave)), settings.level_gap_m),
    };
    let choice = chosen.map_err(|no| wrong(words(&cave, &no, settings)))?;
    tell(&cave, &choice, settings, &mut import);
    let mut drawing = Drawing { outside: Outside::Rock, snap_m: SNAP_M, import, ..Drawing::default() };
    draw(&cave, &choice, &mut drawing);
    drawing.into_map()
}

/// An entrance, or else the first station with a passage.
fn first(cave: &Cave) -> usize {
    cave.nodes.iter().position(|node| node.entrance).unwrap_or_default()
}

/// Passages, the rooms in which they meet, and the stations by name: each in the middle of its passage.
fn draw(cave: &Cave, choice: &Choice, drawing: &mut Drawing) {
    let mut ends: Vec<Vec<usize>> = vec![Vec::new(); cave.nodes.len()];
    for &passage in &choice.passages {
        drawing.free.push(Shape { outline: cave.outline(passage), holes: Vec::new() });
        for end in cave.passages[passage].ends {
            ends[end].push(passage);
        }
    }
    for (node, passages) in ends.into_iter().enumerate().filter(|(_, passages)| !passages.is_empty()) {
        let middles: Vec<[f64; 2]> = passages.iter().map(|&passage| cave.end(passage, node).0).collect();
        let mean_m =
            |axis: usize| middles.iter().map(|middle| middle[axis]).sum::<f64>() / middles.len() as f64;
        let (at_m, [_, _, z_m]) = ([mean_m(0), mean_m(1)], cave.nodes[node].at_m);
        let names = cave.nodes[node].names.iter().cloned();
        drawing.places.extend(names.map(|name| Place { name, at_m, height_m: Some(z_m) }));
        if passages.len() > 1 {
            let outline = cave.joint(node, passages.into_iter());
            drawing.free.push(Shape { outline, holes: Vec::new() });
        }
    }
}

fn tell(cave: &Cave, choice: &Choice, settings: &SurvexConfig, import: &mut Import) {
    let level_gap_m = settings.level_gap_m;
    let sum = |metres: fn(&super::cave::Passage) -> f64| -> f64 {
        choice.passages.iter().map(|&passage| metres(&cave.passages[passage])).sum()
    };
    let ends = choice.passages.iter().flat_map(|&passage| cave.passages[passage].ends);
    let heights_m = ends.map(|node| cave.nodes[node].at_m[2]);
    let (low_m, high_m) = heights_m
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low_m, high_m), z_m| (low_m.min(z_m), high_m.max(z_m)));
    let what = if choice.way.is_empty() {
        "legs".to_owned()
    } else {
        let [from, to] = [&settings.from, &settings.to].map(|name| name.clone().unwrap_or_default());
        format!("legs on the way from {from} to {to} and beside it")
    };
    let what = format!(
        "{what}: {:.1} m long, {:.1} m in plan, where depth is counted; heights of {low_m:.1} to {high_m:.1} m are left away",
        sum(|passage| passage.length_m),
        sum(|passage| passage.plan_m),
    );
    import.say(RemarkKind::Read, choice.passages.len(), what);
    let guessed = choice.passages.iter().filter(|&&passage| cave.passages[passage].is_made_up).count();
    let what = format!("legs whose width was not measured at both ends: {}", cave.made_up);
    import.say(RemarkKind::Guessed, guessed, what);
    import.say(RemarkKind::Dropped, choice.beyond, "legs farther from that way than branch_m");
    let what = format!(
        "places where passages cross at heights less than {level_gap_m} m apart (key level_gap_m): there they meet"
    );
    import.say(RemarkKind::Merged, choice.merged, what);
    let what = format!(
        "legs that cross others more than {level_gap_m} m above or below (key level_gap_m): a map is flat, so of two the \
         farther one is left out, and no way leads there"
    );
    import.say(RemarkKind::Separated, choice.separated.len(), what);
}

fn words(cave: &Cave, no: &NoChoice, settings: &SurvexConfig) -> String {
    match no {
        NoChoice::TooMuch(why) => why.clone(),
        NoChoice::NoWay => {
            let [from, to] = [&settings.from, &settings.to].map(|name| name.clone().unwrap_or_default());
            format!("no legs lead from {from} to {to}; expected two stations of one cave")
        }
        &NoChoice::CrossesItself { first, second, gap_m, before } => {
            let [a, b, c, d, before] =
                [first[0], first[1], second[0], second[1], before].map(|node| called(cave, Some(node)));
            format!(
                "the way crosses itself: between {c} and {d} it lies {gap_m:.1} m above or below itself between {a} and {b}, \
                 and a map is flat; end it before, to = \"{before}\", or say level_gap_m = {} and both become one",
                gap_m.ceil()
            )
        }
    }
}

/// A station in words.
fn called(cave: &Cave, node: Option<usize>) -> String {
    let Some(node) = node.and_then(|node| cave.nodes.get(node)) else { return "nowhere".to_owned() };
    node.names.first().cloned().unwrap_or_else(|| {
        let [x_m, y_m, z_m] = node.at_m;
        format!("a station without a name at ({x_m}, {y_m}, {z_m}) m")
    })
}
