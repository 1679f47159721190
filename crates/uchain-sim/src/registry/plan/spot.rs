//! Places by where they are, or by the name that the map has for them.

use super::PlanRequestError;
use crate::{
    map::{Map, Place},
    mission::chain::Farthest,
    world::MotionParams,
};

/// A place as somebody gives it.
#[derive(Debug, Clone, PartialEq)]
pub enum Spot {
    /// In the map file's own frame (m).
    At([f64; 2]),
    /// A place that the map names: a station, a tile. The end of a name is enough where only one ends so.
    Named(String),
}

/// Most names in a message.
const SHOWN: usize = 5;

/// The place of this name.
pub(super) fn find(places: &[Place], name: &str) -> Result<[f64; 2], PlanRequestError> {
    if let Some(place) = places.iter().find(|place| place.name == name) {
        return Ok(place.at_m);
    }
    let mut ending = places.iter().filter(|place| {
        let before = place.name.strip_suffix(name);
        before.is_some_and(|before| before.is_empty() || before.ends_with(['.', '/', ' ']))
    });
    match (ending.next(), ending.next()) {
        (Some(place), None) => return Ok(place.at_m),
        (Some(one), Some(other)) => {
            let near = std::iter::once(one).chain([other]).chain(ending).take(SHOWN);
            return Err(no_place(name, near.map(|place| place.name.clone()).collect(), places.len()));
        }
        _ => {}
    }
    let mut by_likeness: Vec<(usize, &str)> = places
        .iter()
        .map(|place| (strsim::damerau_levenshtein(name, &place.name), place.name.as_str()))
        .collect();
    by_likeness.sort_unstable();
    let near = by_likeness.into_iter().take(SHOWN).map(|(_, name)| name.to_owned()).collect();
    Err(no_place(name, near, places.len()))
}

/// The place that is farthest from a base along the passages that a UAV fits through; `None` without a passage at the base.
pub(super) fn farthest(map: &Map, base: &Spot) -> Option<Spot> {
    let base_m = match base {
        Spot::At(at_m) => *at_m,
        Spot::Named(name) => find(map.places(), name).ok()?,
    };
    let radius_m = MotionParams::default().radius_m;
    Some(Spot::At(Farthest::of(map, map.to_local(base_m), radius_m).ok()??.at_m))
}

fn no_place(name: &str, near: Vec<String>, count: usize) -> PlanRequestError {
    PlanRequestError::NoPlace { typed: name.chars().take(80).collect(), near, count }
}

/// A few names spread over all there are.
pub(super) fn some(places: &[Place]) -> Vec<String> {
    let every = places.len().div_ceil(SHOWN).max(1);
    places.iter().step_by(every).map(|place| place.name.clone()).collect()
}

/// What could have been meant, for the end of a message.
pub(super) fn choices(near: &[String], count: usize) -> String {
    match count {
        0 => ", nor any other; expected X,Y in metres, such as --base=-50.15,34.03".to_owned(),
        _ => format!("; of its {count} places the nearest are {}", near.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_known_by_its_whole_name_or_by_an_end_that_only_one_has() {
        let place = |name: &str, x_m| Place { name: name.to_owned(), at_m: [x_m, 0.0], height_m: None };
        let places = [place("cave.main.1", 1.0), place("cave.main.12", 2.0), place("cave.side.1", 3.0)];
        assert_eq!(find(&places, "cave.side.1").unwrap(), [3.0, 0.0]);
        assert_eq!(find(&places, "12").unwrap(), [2.0, 0.0]);
        let two = find(&places, "1").unwrap_err().to_string();
        assert!(two.ends_with("of its 3 places the nearest are cave.main.1, cave.side.1"), "{two}");
        let none = find(&places, "cave.mian.1").unwrap_err().to_string();
        assert!(
            none.starts_with("cave.mian.1: the map names no such place")
                && none.contains("are cave.main.1, "),
            "{none}"
        );
        let unnamed = find(&[], "portal").unwrap_err().to_string();
        assert!(unnamed.contains("expected X,Y in metres"), "{unnamed}");
    }
}
