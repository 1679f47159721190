//! A station by its name.

use super::cave::Cave;

/// Most names that a message shows.
const MOST_SHOWN: usize = 4;
/// How much of a long name is compared.
const COMPARED: usize = 64;

/// The node of the station that is called so, whole or by the last parts of its name; or what was expected.
pub(super) fn node_of(cave: &Cave, wanted: &str) -> Result<usize, String> {
    let named =
        || cave.nodes.iter().enumerate().flat_map(|(node, it)| it.names.iter().map(move |name| (name, node)));
    if let Some((_, node)) = named().find(|(name, _)| *name == wanted) {
        return Ok(node);
    }
    let is_end = |name: &str| name.strip_suffix(wanted).is_some_and(|head| head.ends_with(cave.separator));
    let found: Vec<(&String, usize)> =
        named().filter(|(name, _)| !wanted.is_empty() && is_end(name)).collect();
    match *found.as_slice() {
        [] => Err(format!("the name of a station, whole or its last parts{}", nearest(cave, wanted))),
        [(_, node), ref rest @ ..] if rest.iter().all(|(_, other)| *other == node) => Ok(node),
        [..] => {
            let names = found.iter().take(MOST_SHOWN).map(|(name, _)| name.as_str());
            let more = if found.len() > MOST_SHOWN { " …" } else { "" };
            let names = names.collect::<Vec<_>>().join(", ");
            Err(format!("more of the name: {} stations end in it, {names}{more}", found.len()))
        }
    }
}

fn nearest(cave: &Cave, wanted: &str) -> String {
    let short = |name: &str| name.to_lowercase().chars().take(COMPARED).collect::<String>();
    let wanted = short(wanted);
    let mut names: Vec<(usize, &str)> = Vec::new();
    for name in cave.nodes.iter().flat_map(|node| &node.names) {
        // As many parts as were given.
        let parts = wanted.matches(cave.separator).count() + 1;
        let end = name.rmatch_indices(cave.separator).nth(parts - 1).map_or(0, |(at, dot)| at + dot.len());
        let part = name.get(end..).unwrap_or(name);
        names.push((strsim::damerau_levenshtein(&wanted, &short(part)), name));
    }
    names.sort_unstable();
    let near = names.iter().filter(|(edits, _)| *edits <= 1 + wanted.chars().count() / 3).take(MOST_SHOWN);
    let near: Vec<&str> = near.map(|(_, name)| *name).collect();
    if near.is_empty() { String::new() } else { format!("; did you mean {}?", near.join(", ")) }
}
