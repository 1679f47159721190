//! The graph beside a layout: `17 [label="17::tunnel_tile_5::tile_17"];` and `16 -- 17 [label=1];`, line by line.

use std::collections::BTreeMap;

/// Most vertices and edges of a graph, each.
const MOST: usize = 100_000;

/// Tiles by their numbers, and which of them see each other.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Graph {
    /// Type and name.
    pub(super) tiles: BTreeMap<u32, (String, String)>,
    /// Two tiles, the lower number first, and what the passage between them costs: SubT's measure of how hard it is to be heard.
    pub(super) costs: BTreeMap<[u32; 2], u32>,
}

/// What a graph says, or what is wrong with which line.
pub(super) fn graph(text: &str) -> Result<Graph, String> {
    let mut graph = Graph::default();
    for (index, line) in text.lines().enumerate() {
        let line = without_comments(line);
        let line = line.trim();
        if line.is_empty() || line == "}" || line.ends_with('{') {
            continue;
        }
        let wrong = |expected: &str| {
            let shown: String = line.chars().take(60).collect();
            format!("line {}: {shown:?}: expected {expected}", index + 1)
        };
        let expected = "a tile, 1 [label=\"1::type::name\"];, or a passage, 1 -- 2 [label=3];";
        if statement(line, &mut graph).is_none() {
            return Err(wrong(expected));
        }
        if graph.tiles.len() > MOST || graph.costs.len() > MOST {
            return Err(wrong(&format!("at most {MOST} tiles and passages")));
        }
    }
    Ok(graph)
}

fn statement(line: &str, graph: &mut Graph) -> Option<()> {
    let (head, rest) = line.split_once('[')?;
    let label =
        rest.trim_end().trim_end_matches(';').trim_end().strip_suffix(']')?.trim().strip_prefix("label")?;
    let label = label.trim_start().strip_prefix('=')?.trim().trim_matches('"');
    if let Some((a, b)) = head.split_once("--") {
        let [a, b]: [u32; 2] = [a.trim().parse().ok()?, b.trim().parse().ok()?];
        graph.costs.insert([a.min(b), a.max(b)], label.parse().ok()?);
    } else {
        let number = head.trim().parse().ok()?;
        let mut parts = label.splitn(3, "::");
        parts.next().filter(|part| part.parse() == Ok(number))?;
        graph.tiles.insert(number, (parts.next()?.to_owned(), parts.next()?.to_owned()));
    }
    Some(())
}

/// Comments stand within lines.
fn without_comments(line: &str) -> String {
    let mut kept = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once("/*") {
        kept.push_str(before);
        rest = after.split_once("*/").map_or("", |(_, after)| after);
    }
    kept + rest
}
