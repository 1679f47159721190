//! `uchain map plot`: a map to scale.

use std::path::{Path, PathBuf};

use uchain_sim::{
    draw::plot::{Plot as Drawn, Spot, plot as draw},
    map::{GraphEdge, Map, NodeKind, UAV_MARGIN_M},
    registry::Registry,
    world::MotionParams,
};

use super::args::Plot;
use crate::{
    exit::Failure,
    output::{file, folder_name, inputs},
    waiting::spinner,
};

pub(super) fn plot(registry: Registry, asked: &Plot) -> Result<(), Failure> {
    let waiting = spinner(!asked.quiet.is_quiet(), "plotting");
    let what = &asked.read.what;
    let map = super::read(registry, &asked.read)?;
    let drawn = drawn(&map, asked)?;
    let picture = draw(&map, &drawn)?;
    // Without --out the file is ours.
    let ours = || PathBuf::from("plots").join(folder_name(what) + ".png");
    let (out, force) = asked.out.clone().map_or_else(|| (ours(), true), |out| (out, asked.force));
    if !out.extension().is_some_and(|end| end.eq_ignore_ascii_case("png")) {
        return Err(Failure::Usage(format!("{}: expected a name that ends in .png", out.display())));
    }
    file::write(&[(out.clone(), picture.png)], &inputs(what), force)?;
    waiting.finish_and_clear();
    asked.quiet.report(|| {
        let spots: String = asked.at.iter().map(|&at_m| Spot::of(&map, at_m).words() + "\n").collect();
        let unnamed = match picture.unnamed {
            0 => String::new(),
            count => format!("{count} names or coordinates have no room beside the others\n"),
        };
        format!("{spots}{unnamed}{}\n", out.display())
    })
}

fn drawn(map: &Map, asked: &Plot) -> Result<Drawn, Failure> {
    let (low, high) = map.bounds();
    let size = high - low;
    let what = Path::new(&asked.read.what).file_name().unwrap_or_default().to_string_lossy();
    let title = format!("{what}: {:.1} × {:.1} m", size.x, size.y);
    let places = map.places().iter().map(|place| (place.name.clone(), place.at_m)).collect();
    let mut drawn = Drawn { title, marks: asked.at.clone(), places, ..Drawn::default() };
    if asked.graph {
        let graph = map.tunnel_graph().map_err(|error| Failure::Map(format!("--graph: {error}")))?;
        let line = |edge: &GraphEdge| edge.line.iter().map(|&at| map.to_file(at)).collect();
        // What no UAV fits through is no way.
        let needs_m = 2.0 * (MotionParams::default().radius_m + UAV_MARGIN_M);
        let ways = graph.edges.iter().filter(|edge| edge.narrowest_m >= needs_m);
        drawn.ways = ways.map(line).collect();
        for node in &graph.nodes {
            let is_on_a_way = |edge: &usize| graph.edges[*edge].narrowest_m >= needs_m;
            let at_m = map.to_file(node.at);
            match node.kind {
                _ if !node.edges.iter().any(is_on_a_way) => {}
                NodeKind::DeadEnd => drawn.ends.push(at_m),
                _ => drawn.junctions.push(at_m),
            }
        }
    }
    Ok(drawn)
}
