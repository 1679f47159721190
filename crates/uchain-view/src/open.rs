//! How flights come in: a scenario, with the inputs of whoever flew it by hand; a recording; a map.

use std::{io::Cursor, path::Path, sync::Arc};

use serde::Deserialize;
use uchain_sim::{
    config::Source,
    map::{Map, RosConfig, ros_in_memory, ros_picture},
    mission::{Scene, chain::Course, explore::Site},
    record::mcap::{Opened, walls_from_csv},
    registry::{AnyScene, Registry},
};

use crate::{
    flown::{Flight, Flown},
    library::source,
    problem::Problem,
    told::{FlightFile, TimedInput},
};

/// Largest recording (bytes).
const RECORDING_MAX_BYTES: usize = 64 << 20;

/// A file by its name; its bytes come behind the request, one file after the other.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NamedFile {
    name: String,
    bytes: usize,
}

/// Files, each with its name.
pub(crate) fn split<'a>(
    named: &'a [NamedFile],
    mut bytes: &'a [u8],
) -> Result<Vec<(&'a str, &'a [u8])>, Problem> {
    let mut files = Vec::new();
    for NamedFile { name, bytes: length } in named {
        let (file, rest) = bytes.split_at_checked(*length).ok_or_else(|| {
            Problem::new(format!("{name}: {length} bytes were announced, {} came", bytes.len()))
        })?;
        files.push((name.as_str(), file));
        bytes = rest;
    }
    Ok(files)
}

/// A scenario, with the walls of its map where it names a file.
pub(crate) fn scenario(file: FlightFile) -> Result<Box<dyn Flight>, Problem> {
    let walls = match &file.walls_csv {
        Some(csv) => {
            let map =
                walls_from_csv(csv.as_bytes()).map_err(|why| Problem::new(format!("walls_csv: {why}")))?;
            let offset_m = file.map_offset_m.unwrap_or_default();
            if !offset_m.iter().all(|m| m.is_finite()) {
                return Err(Problem::new("map_offset_m: expected two numbers"));
            }
            Some(map.with_offset_m(offset_m))
        }
        None => None,
    };
    let inputs = file.inputs.clone();
    let source = source(file.text, file.label)?;
    in_walls(&source, walls.as_ref(), file.seed, inputs)
}

/// A scenario, in walls that were built before if there are any.
fn in_walls(
    source: &Source,
    walls: Option<&Map>,
    seed: u64,
    inputs: Vec<TimedInput>,
) -> Result<Box<dyn Flight>, Problem> {
    let registry = Registry::default();
    let scene = match walls {
        Some(map) => registry.read_in(source, &[], map.clone())?,
        None => registry.read(source, &[])?,
    };
    let file = FlightFile::new(source, seed, walls);
    Ok(match known(&*scene)? {
        Known::Chain(course) => Box::new(Flown::live(course, file, inputs)?),
        Known::Exploration(site) => Box::new(Flown::live(site, file, inputs)?),
    })
}

enum Known {
    Chain(Arc<Course>),
    Exploration(Arc<Site>),
}

fn known(scene: &dyn AnyScene) -> Result<Known, Problem> {
    let course = scene.get::<Course>().cloned().map(Known::Chain);
    let found = course.or_else(|| scene.get::<Site>().cloned().map(Known::Exploration));
    found.ok_or_else(|| Problem::new(format!("{} is nothing that this page shows", scene.kind())))
}

/// A recording.
pub(crate) fn recording(bytes: Vec<u8>, label: &str) -> Result<Box<dyn Flight>, Problem> {
    if bytes.len() > RECORDING_MAX_BYTES {
        let mib = bytes.len() >> 20;
        return Err(Problem::new(format!(
            "{label}: {mib} MiB are too much for a page, expected at most 64; fly the scenario here instead, or look at the \
             file with `uchain inspect`"
        )));
    }
    let wrong = |why: &dyn std::fmt::Display| Problem::new(format!("{label}: {why}"));
    let opened = Opened::read(Cursor::new(bytes), label).map_err(|error| wrong(&error))?;
    let kind = Registry::default().describe(&opened.source(), &[])?.mission.kind();
    let file = FlightFile::new(&opened.source(), opened.about.seed, Some(&opened.map()));
    Ok(match kind {
        Course::KIND => Box::new(Flown::<Course>::recorded(opened, file).map_err(|why| wrong(&why))?),
        Site::KIND => Box::new(Flown::<Site>::recorded(opened, file).map_err(|why| wrong(&why))?),
        other => return Err(wrong(&format!("{other} is nothing that this page shows"))),
    })
}

/// Ends of the names of pictures.
const PICTURES: [&str; 2] = [".pgm", ".png"];

/// A ROS map, of a yaml file and its picture, or of a picture alone whose cells measure `cell_m`; for the scenario in
/// `text`, or explored.
pub(crate) fn map(
    files: &[(&str, &[u8])],
    cell_m: Option<f64>,
    text: Option<String>,
    label: Option<String>,
    seed: u64,
) -> Result<Box<dyn Flight>, Problem> {
    let ends_in = |name: &str, ends: &[&str]| ends.iter().any(|end| name.to_lowercase().ends_with(end));
    let yaml = files.iter().find(|(name, _)| ends_in(name, &[".yaml", ".yml"]));
    let pictures: Vec<_> = files.iter().filter(|(name, _)| ends_in(name, &PICTURES)).collect();
    let (name, yaml) = match (yaml, cell_m, pictures.first()) {
        (Some((name, yaml)), _, _) => (*name, yaml.to_vec()),
        (None, Some(cell_m), Some((name, _))) if cell_m > 0.0 && cell_m.is_finite() => {
            let name_in_yaml = serde_json::to_string(name).map_err(Problem::new)?;
            let yaml = format!(
                "image: {name_in_yaml}\nresolution: {cell_m}\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n\
                 free_thresh: 0.196\n"
            );
            (*name, yaml.into_bytes())
        }
        (None, _, Some((name, _))) => {
            return Err(Problem::new(format!(
                "{name}: a picture alone does not say how large its cells are: drop the yaml file of the map with it, or say \
                 how many metres a cell measures"
            )));
        }
        (None, _, None) => {
            return Err(Problem::new(
                "no map: expected the yaml file of a ROS map and its picture (pgm or png)",
            ));
        }
    };
    let file = Path::new(name);
    let wanted = ros_picture(file, &yaml).map_err(Problem::new)?;
    let base = base_name(&wanted);
    let only = match pictures[..] {
        [only] => Some(only),
        _ => None,
    };
    let picture = pictures.iter().find(|(name, _)| *name == base).copied().or(only);
    let (_, picture) = picture.ok_or_else(|| {
        Problem::new(format!("{name} names the picture {base}: drop it together with the yaml file"))
    })?;
    let config: RosConfig = toml::from_str("file = \"\"").map_err(Problem::new)?;
    let map = ros_in_memory(file, &yaml, picture, config.simplify_m).map_err(Problem::new)?;
    let source = if let Some(text) = text {
        source(text, label.unwrap_or_else(|| "scenario.toml".to_owned()))?
    } else {
        // Robots explore it; nothing is read from a disk.
        let mut source = Source::find(&base_name(file))?;
        if let Some(cell_m) = cell_m {
            source.text = source.text.replace("\n[explore]", &format!("\ncell_m = {cell_m:?}\n[explore]"));
        }
        source
    };
    in_walls(&source, Some(&map), seed, Vec::new())
}

fn base_name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
