//! What a drawing's names say: layers, ids and classes. Words are what is between anything but letters and digits; digits
//! at the end of a word are a number and say nothing.

/// What a name makes of what is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Free space: areas, and lines as wide as they are drawn.
    Free,
    /// Rock: areas, also those that are only outlined.
    Rock,
    /// Walls: lines.
    Wall,
    /// A place with a name.
    Place,
    /// Not of the map.
    Ignored,
}

const KINDS: [(Kind, &[&str]); 5] = [
    (Kind::Free, &["free", "passage", "passages", "room", "rooms", "tunnel", "tunnels"]),
    (Kind::Rock, &["rock", "solid", "pillar", "pillars"]),
    (Kind::Wall, &["wall", "walls"]),
    (Kind::Place, &["place", "places"]),
    (Kind::Ignored, &["ignore", "ignored", "notes", "background"]),
];

/// Words that programs call things by: no materials.
const AUTOMATIC: &[&str] = &[
    "a",
    "arc",
    "calque",
    "capa",
    "circle",
    "cls",
    "clip",
    "ebene",
    "ellipse",
    "fil",
    "flow",
    "g",
    "group",
    "image",
    "layer",
    "line",
    "livello",
    "mask",
    "object",
    "path",
    "polygon",
    "polyline",
    "rect",
    "shape",
    "st",
    "str",
    "svg",
    "text",
    "use",
    "layout",
    "defpoints",
    "xmlid",
    "clippath",
    "namedview",
    "base",
    "patch",
    "figure",
    "axes",
    "tspan",
];

/// Longest name that is kept, in letters.
const LONGEST: usize = 60;

/// What a name says of its kind: its first word that says one.
pub(crate) fn kind_of(name: &str) -> Option<Kind> {
    words(name).find_map(|word| {
        let is_it = |kind: &&(Kind, &[&str])| kind.1.contains(&word.as_str());
        KINDS.iter().find(is_it).map(|&(kind, _)| kind)
    })
}

/// The material that the name of a layer says: its words, but for those that say a kind.
pub(crate) fn material_of_layer(name: &str) -> Option<String> {
    let said: Vec<String> = words(name).filter(|word| kind_of(word).is_none()).collect();
    let automatic = |word: &String| AUTOMATIC.contains(&word.as_str());
    if said.is_empty() || said.iter().any(automatic) {
        return None;
    }
    Some(said.join(" ").chars().take(LONGEST).collect())
}

/// The material that an id says, which has to end in a number: `concrete-3`, `concrete_3` or `concrete3`.
pub(crate) fn material_of_id(id: &str) -> Option<String> {
    let stem = id.trim_end_matches(|c: char| c.is_ascii_digit());
    let stem = if stem.len() == id.len() { return None } else { stem.trim_end_matches(['-', '_', '.', ' ']) };
    let only_words = stem.chars().all(|c| c.is_alphabetic() || matches!(c, '-' | '_' | ' '));
    if only_words { material_of_layer(stem) } else { None }
}

/// The material that a class says: any word without a digit that no program makes.
pub(crate) fn material_of_class(class: &str) -> Option<String> {
    if class.chars().any(|c| c.is_ascii_digit()) { None } else { material_of_layer(class) }
}

/// Words in small letters, without the numbers at their ends.
fn words(name: &str) -> impl Iterator<Item = String> + '_ {
    let parts = name.split(|c: char| !c.is_alphanumeric());
    let bare = parts.map(|word| word.trim_end_matches(|c: char| c.is_ascii_digit()).to_lowercase());
    bare.filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_kinds_and_materials_and_what_programs_call_things_says_nothing() {
        assert_eq!(kind_of("Rooms"), Some(Kind::Free));
        assert_eq!(kind_of("free-12"), Some(Kind::Free));
        assert_eq!(kind_of("concrete walls"), Some(Kind::Wall));
        assert_eq!(kind_of("freedom"), None);
        assert_eq!(material_of_layer("concrete walls").as_deref(), Some("concrete"));
        assert_eq!(material_of_layer("Reinforced concrete 2").as_deref(), Some("reinforced concrete"));
        for name in ["Layer 1", "Ebene 3", "walls", "", "0", "g12", "svg8"] {
            assert_eq!(material_of_layer(name), None, "{name}");
        }
        assert_eq!(material_of_id("concrete-3").as_deref(), Some("concrete"));
        assert_eq!(material_of_id("wood_17").as_deref(), Some("wood"));
        for id in ["path832", "path832-5", "rect10-2", "Entrance", "3", "wall-2", "use4", "a1b2c3"] {
            assert_eq!(material_of_id(id), None, "{id}");
        }
        assert_eq!(material_of_class("brick").as_deref(), Some("brick"));
        assert!(material_of_class("cls-1").is_none() && material_of_class("st0").is_none());
    }
}
