//! What is wrong with a map's yaml, in words for people: the library speaks of its own insides.

use serde_saphyr::Error;

/// Why a yaml text cannot be read, with the line it stands in.
pub(in crate::map) fn yaml(error: &Error, text: &str) -> String {
    let error = error.without_snippet();
    let line = error.location().and_then(|at| usize::try_from(at.line()).ok());
    let place = |line: Option<usize>| line.map_or_else(String::new, |line| format!("line {line}: "));
    match error {
        Error::DuplicateMappingKey { key, .. } => {
            let key = key.as_deref().map_or_else(|| "a key".to_owned(), |key| format!("'{key}'"));
            format!("{}{key} is written a second time; expected every key once", place(line))
        }
        Error::MultipleDocuments { .. } => {
            let marks = text.lines().enumerate().filter(|(_, text)| text.starts_with("---"));
            let mark =
                marks.map(|(index, _)| index + 1).filter(|mark| line.is_none_or(|line| *mark <= line)).last();
            format!("{}a second document begins; expected one, without --- after it", place(mark.or(line)))
        }
        Error::NonFiniteFloat { value, .. } => format!("{}{value}: expected a finite number", place(line)),
        Error::UnknownAnchor { .. } => {
            format!("{}a * refers to what is named nowhere; expected the value itself", place(line))
        }
        _ => match text.lines().position(|line| line.starts_with('\t')) {
            Some(index) => format!("line {}: begins with a tab; yaml is indented by spaces", index + 1),
            None => format!(
                "{}not the yaml of a map; expected lines such as resolution: 0.05, with every bracket and quote closed",
                place(line)
            ),
        },
    }
}
