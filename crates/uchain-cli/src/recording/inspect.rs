//! `uchain inspect`: read, sum up, say.

use uchain_sim::registry::Registry;

use super::{Inspect, open};
use crate::{exit::Failure, output::INSPECT};

pub(crate) fn inspect(registry: Registry, asked: &Inspect) -> Result<(), Failure> {
    let mut recording = open(registry, &asked.file)?;
    let folder = asked.folder()?;
    let about = recording.about().clone();
    let mut found = recording.inspect().map_err(|cause| Failure::played(&asked.file, &about, cause))?;
    let json = found.json()?;
    let mut files = asked.file.display().to_string();
    if let Some(folder) = folder {
        folder.write(&INSPECT, json.as_bytes(), &found.picture()?, &[])?;
        files = folder.says(&INSPECT);
    }
    let cut =
        if found.is_whole() { "" } else { "; the file is cut short, and read up to its last whole chunk" };
    asked.say.result(&json, || format!("flown by uchain {}{cut}\n{}", about.version, found.text(&files)))
}
