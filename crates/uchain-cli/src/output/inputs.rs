//! What a command reads, so that its results never take the place of it.

use std::path::{Path, PathBuf};

use uchain_sim::{
    config::{Source, kind_of_map},
    map::ros_picture,
};

/// The files that a map, or the map and the radio of a scenario, are read from.
pub(crate) fn inputs(what: &str) -> Vec<PathBuf> {
    let path = PathBuf::from(what);
    let mut inputs = of_map(&path);
    if kind_of_map(&path).is_none()
        && let Ok(source) = Source::find(what)
        && let Ok(scenario) = source.text.parse::<toml::Table>()
    {
        // The map file of a scenario, whatever kind it is of.
        let tables = scenario.get("map").and_then(toml::Value::as_table).into_iter().flatten();
        let files = tables.filter_map(|(_, table)| table.get("file")?.as_str());
        inputs.extend(files.flat_map(|file| of_map(&source.folder.join(file))));
        // And that of its losses.
        let losses = scenario.get("radio").and_then(|radio| radio.get("table_file")?.as_str());
        inputs.extend(losses.map(|file| source.folder.join(file)));
    }
    inputs
}

/// A map file, and the picture that it names if it is a ROS map.
fn of_map(path: &Path) -> Vec<PathBuf> {
    let mut files = vec![path.to_owned()];
    if kind_of_map(path) == Some("ros")
        && let Ok(yaml) = std::fs::read(path)
        && let Ok(picture) = ros_picture(path, &yaml)
    {
        files.push(path.parent().unwrap_or(Path::new("")).join(picture));
    }
    files
}
