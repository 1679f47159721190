//! From tiles to a map: a tunnel from the middle of each tile to each of its openings.

use std::collections::BTreeMap;

use super::{
    SubtConfig,
    dot::Graph,
    joins::joins,
    tiles::{Kind, LEVEL_M, Layout, SIDES, TILE_M, Tile},
};
use crate::map::{
    HeardAcross, Import, Outside, Place, RemarkKind,
    drawing::{Drawing, Shape},
};

/// How far two tunnels that join reach into one another (m), and how thick the rock is behind an opening that leads nowhere.
const OVERLAP_M: f64 = 0.1;
const CLOSED_M: f64 = 0.5;
/// Edges shorter than this are drawn together (m).
const SNAP_M: f64 = 0.01;

/// What the tiles look like from above. The frame's origin is the base, as in worlds that are made of layouts.
pub(super) fn drawing(
    layout: &Layout,
    graph: Option<&Graph>,
    settings: &SubtConfig,
) -> Result<Drawing, String> {
    let tiles = &layout.tiles;
    let origin = tiles.iter().find(|tile| tile.kind == Kind::Base).or(tiles.first());
    let origin = origin.ok_or("no tile that is known is in it")?;
    let middle = |tile: &Tile| {
        let [columns, rows] = [tile.column - origin.column, origin.row - tile.row];
        [f64::from(columns) * TILE_M, f64::from(rows) * TILE_M]
    };
    let joins = joins(tiles);
    let mut drawing = Drawing {
        outside: Outside::Rock,
        snap_m: SNAP_M,
        import: Import::of(super::FORMAT.name),
        ..Drawing::default()
    };
    let mut nowhere = 0;
    for (tile, joins) in tiles.iter().zip(&joins) {
        for side in 0..4 {
            if tile.opens[side].is_none() {
                continue;
            }
            let reach_m = if joins[side].is_some() {
                TILE_M / 2.0 + OVERLAP_M
            } else {
                nowhere += usize::from(tile.blocked_m[side].is_none());
                tile.blocked_m[side].map_or(TILE_M / 2.0, |blocked_m| blocked_m.min(TILE_M / 2.0)) - CLOSED_M
            };
            drawing.free.extend(arm(middle(tile), SIDES[side], width_m(tile, settings), reach_m));
        }
        let climbs_m = if matches!(tile.kind, Kind::Ramp | Kind::Shaft) { LEVEL_M / 2.0 } else { 0.0 };
        let named = graph.and_then(|graph| graph.tiles.get(&tile.number));
        let name = match named {
            Some((_, name)) => name.clone(),
            None if tile.kind == Kind::Base => "BaseStation".to_owned(),
            None => format!("tile_{}", tile.number),
        };
        let height_m = Some(f64::from(tile.level) * LEVEL_M + climbs_m);
        if tile.kind != Kind::Blocker {
            drawing.places.push(Place { name, at_m: middle(tile), height_m });
        }
    }
    tell(layout, settings, nowhere, &mut drawing.import);
    if let Some(graph) = graph {
        compare(tiles, &joins, graph, &mut drawing.import)?;
        let at: BTreeMap<u32, [i32; 2]> = tiles
            .iter()
            .map(|tile| (tile.number, [tile.column - origin.column, origin.row - tile.row]))
            .collect();
        drawing.heard_across = graph
            .costs
            .iter()
            .filter_map(|([a, b], &cost)| Some(([*at.get(a)?, *at.get(b)?], cost)))
            .map(|(tiles, cost)| HeardAcross { tiles, tile_m: TILE_M, cost })
            .collect();
    }
    Ok(drawing)
}

fn width_m(tile: &Tile, settings: &SubtConfig) -> f64 {
    if tile.kind == Kind::Constrained { settings.constrained_width_m } else { settings.width_m }
}

/// From behind the middle, so that two arms make a corner, to the opening.
fn arm([x, y]: [f64; 2], side: [i32; 2], width_m: f64, reach_m: f64) -> Option<Shape> {
    let [dx, dy] = side.map(f64::from);
    let half_m = width_m / 2.0;
    let corner = |along_m: f64, left_m: f64| [x + along_m * dx - left_m * dy, y + along_m * dy + left_m * dx];
    let outline = vec![
        corner(-half_m, -half_m),
        corner(reach_m, -half_m),
        corner(reach_m, half_m),
        corner(-half_m, half_m),
    ];
    (reach_m > -half_m).then_some(Shape { outline, holes: Vec::new() })
}

fn tell(layout: &Layout, settings: &SubtConfig, nowhere: usize, import: &mut Import) {
    let of = |kind: Kind| layout.tiles.iter().filter(|tile| tile.kind == kind).count();
    let levels = layout.tiles.iter().map(|tile| tile.level);
    let (low, high) = (levels.clone().min().unwrap_or_default(), levels.max().unwrap_or_default());
    import.say(
        RemarkKind::Read,
        layout.tiles.len(),
        format!("tiles of {TILE_M} m, levels {low} to {high}, {LEVEL_M} m each: no two lie over one another, so all are in the map"),
    );
    let rest = layout.tiles.len() - of(Kind::Constrained) - of(Kind::Blocker);
    import.say(RemarkKind::Guessed, rest, format!("tiles' width: {} m (key width_m)", settings.width_m));
    let what =
        format!("constrained tiles' width: {} m (key constrained_width_m)", settings.constrained_width_m);
    import.say(RemarkKind::Guessed, of(Kind::Constrained), what);
    let words = layout.unknown.join(", ");
    import.say(
        RemarkKind::Dropped,
        layout.unknown_count,
        format!("tiles of a type that is not known: {words}"),
    );
    import.say(RemarkKind::Dropped, layout.things, "things that stand in tiles");
    import.say(
        RemarkKind::Dropped,
        of(Kind::Ramp),
        format!("climbs of ramps, {LEVEL_M} m each: a map is flat"),
    );
    let what =
        format!("climbs of shafts, {LEVEL_M} m straight up each: in the map they are passages like others");
    import.say(RemarkKind::Dropped, of(Kind::Shaft), what);
    import.say(RemarkKind::Guessed, nowhere, "openings onto no tile's opening: closed");
}

/// What the graph says of the same tiles.
fn compare(
    tiles: &[Tile],
    joins: &[[Option<usize>; 4]],
    graph: &Graph,
    import: &mut Import,
) -> Result<(), String> {
    for tile in tiles {
        if let Some((word, _)) = graph.tiles.get(&tile.number).filter(|(word, _)| *word != tile.word) {
            return Err(format!(
                "its graph is another layout's: tile {} is {:?} here and {word:?} there; expected a graph made of this layout, or \
                 none beside it",
                tile.number, tile.word
            ));
        }
    }
    let joined: std::collections::BTreeSet<[u32; 2]> = tiles
        .iter()
        .zip(joins)
        .flat_map(|(tile, joins)| joins.iter().flatten().map(|&other| (tile.number, tiles[other].number)))
        .map(|(a, b)| [a.min(b), a.max(b)])
        .collect();
    let cost: u64 = graph.costs.values().map(|&cost| u64::from(cost)).sum();
    let what =
        format!("passages that the graph knows, too; all of its passages cost {cost} to be heard across");
    let both = joined.iter().filter(|pair| graph.costs.contains_key(*pair)).count();
    import.say(RemarkKind::Read, both, what);
    import.say(RemarkKind::Guessed, joined.len() - both, "passages that the graph does not know: open");
    import.say(
        RemarkKind::Dropped,
        graph.costs.len() - both,
        "passages of the graph where tiles do not open onto one another",
    );
    Ok(())
}
