//! Wall loops as a table of their corners, as `map.csv` reads it.

use std::fmt::Write as _;

use crate::map::Map;

/// The table, in the map file's own frame, and how many loops are not in it: such a table has one outer wall and what
/// stands within it, so of several separate free areas it holds the largest.
pub fn write_csv(map: &Map) -> (String, usize) {
    let loops: Vec<Vec<[f64; 2]>> =
        map.loops().map(|walls| walls.iter().map(|wall| map.to_file(wall.a)).collect()).collect();
    let sizes: Vec<f64> = map.loops().map(extent_m2).collect();
    let around = map.loops_around();
    // Free space lies within an even number of other loops' insides plus its own: those with none around bound it.
    let outer = (0..loops.len()).filter(|&i| around[i].is_empty());
    let Some(outer) = outer.max_by(|&a, &b| sizes[a].total_cmp(&sizes[b])) else {
        return (String::new(), 0);
    };
    let kept: Vec<usize> = (0..loops.len()).filter(|&i| around[i][..] == [outer]).collect();
    let mut text = "loop,x_m,y_m\n".to_owned();
    for (number, &index) in std::iter::once(&outer).chain(&kept).enumerate() {
        for [x, y] in &loops[index] {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{number},{x},{y}");
        }
    }
    (text, loops.len() - 1 - kept.len())
}

/// Area that a loop surrounds (m²).
fn extent_m2(walls: &[crate::map::Segment]) -> f64 {
    let doubled = walls.iter().map(|wall| wall.a.as_dvec2().perp_dot(wall.b.as_dvec2()));
    0.5 * doubled.sum::<f64>().abs()
}
