//! Any file for a surveyed map: read, or refused in words.

use std::path::Path;

use uchain_sim::map::{SubtConfig, SurvexConfig, subt_in_memory, survex_in_memory};

use crate::drawing::judge;

/// Where a layout ends and its graph begins.
const GRAPH: &str = "\n---\n";

/// Bytes as a survey of Survex.
///
/// # Panics
/// As [`svg`](crate::svg).
pub fn survex(bytes: &[u8]) {
    let Ok(settings) = serde_json::from_str::<SurvexConfig>(r#"{"file": "a.3d"}"#) else { unreachable!() };
    judge(survex_in_memory(Path::new("a.3d"), bytes, &settings));
}

/// Bytes as a layout of SubT tiles, and after a line of dashes its graph.
///
/// # Panics
/// As [`svg`](crate::svg).
pub fn subt(bytes: &[u8]) {
    let Ok(settings) = serde_json::from_str::<SubtConfig>(r#"{"file": "a.tsv"}"#) else { unreachable!() };
    let text = String::from_utf8_lossy(bytes);
    let (layout, graph) = match text.split_once(GRAPH) {
        Some((layout, graph)) => (layout, Some(graph)),
        None => (&*text, None),
    };
    judge(subt_in_memory(Path::new("a.tsv"), layout, graph, &settings));
}
