//! The report as files: for people, for programs, and pictures.

use std::{
    fs,
    io::{self, Write},
    path::Path,
};

use super::{
    Metric, ReportError, Rows, failures,
    markdown::{self, markdown},
    metric, metrics, picture,
};
use crate::sweep::{
    Sweep,
    folder::{FolderError, MANIFEST, durable},
};

pub use markdown::{CSV, PLOTS};
/// For people.
pub const MARKDOWN: &str = "report.md";

/// Writes the report into a folder, each file whole or not at all, and gives what it says to people. An older one goes
/// first.
///
/// # Errors
/// Rows cannot be read, a picture cannot be drawn, a file cannot be written.
pub fn save(rows: &dyn Rows, sweep: &Sweep, folder: &Path) -> Result<String, ReportError> {
    fs::create_dir_all(folder).map_err(FolderError::io(folder, "make the folder"))?;
    clear(folder)?;
    let file = folder.join(CSV);
    let metrics = durable::replace(&file, |out| csv(rows, sweep, out, &file))?;
    let failures = failures(rows, sweep)?;
    let plots = folder.join(PLOTS);
    fs::create_dir_all(&plots).map_err(FolderError::io(&plots, "write"))?;
    let put = |file: &Path, bytes: &[u8]| {
        durable::replace(file, |out| out.write_all(bytes).map_err(FolderError::io(file, "write")))
    };
    for metric in &metrics {
        let Some(picture) = picture(rows, sweep, metric)? else { continue };
        put(&plots.join(format!("{}.png", metric.name)), &picture.png)?;
        put(&plots.join(format!("{}.svg", metric.name)), picture.svg.as_bytes())?;
    }
    let text = markdown(rows.manifest(), sweep, &rows.totals(sweep)?, &metrics, &failures);
    put(&folder.join(MARKDOWN), text.as_bytes())?;
    Ok(text)
}

/// Removes an older report: what it claims first. Pictures of others stay: whoever has some there is told.
fn clear(folder: &Path) -> Result<(), FolderError> {
    let is_ours = [MARKDOWN, CSV, MANIFEST].iter().any(|name| folder.join(name).exists());
    let is_full = || fs::read_dir(folder.join(PLOTS)).is_ok_and(|mut plots| plots.next().is_some());
    if !is_ours && is_full() {
        return Err(FolderError::Occupied { folder: folder.to_owned(), found: PLOTS.to_owned() });
    }
    let plots = fs::read_dir(folder.join(PLOTS)).into_iter().flatten().flatten();
    let plots = plots.map(|entry| entry.path()).filter(|file| !file.is_dir());
    for file in [MARKDOWN, CSV].into_iter().map(|name| folder.join(name)).chain(plots) {
        match fs::remove_file(&file) {
            Err(cause) if cause.kind() != io::ErrorKind::NotFound => {
                return Err(FolderError::io(&file, "write")(cause));
            }
            _ => {}
        }
    }
    Ok(())
}

/// All cells of all numbers, a line each, as they are read: any number of variants.
fn csv(
    rows: &dyn Rows,
    sweep: &Sweep,
    out: &mut impl Write,
    file: &Path,
) -> Result<Vec<Metric>, FolderError> {
    let failed = |cause| FolderError::io(file, "write")(cause);
    let keys: Vec<String> = sweep.design().keys().map(quoted).collect();
    let head: Vec<&str> = ["metric", "variant"]
        .into_iter()
        .chain(keys.iter().map(String::as_str))
        .chain(["runs", "mean", "mean_low", "mean_high", "median"])
        .collect();
    writeln!(out, "{}", head.join(",")).map_err(failed)?;
    let mut all = Vec::new();
    for column in metrics(sweep) {
        all.push(metric(rows, &column, |variant, estimate| {
            let values = sweep.design().values(variant);
            let values: Vec<String> =
                values.iter().map(|value| quoted(value.as_deref().unwrap_or(""))).collect();
            let values = values.iter().map(|value| [",", value]).collect::<Vec<_>>().concat().concat();
            let (low, high) = estimate.interval();
            let ends = if estimate.half_width.is_some() { format!("{low},{high}") } else { ",".to_owned() };
            let (count, mean, median) = (estimate.count, estimate.mean, estimate.median);
            writeln!(out, "{},{variant}{values},{count},{mean},{ends},{median}", column.name).map_err(failed)
        })?);
    }
    Ok(all)
}

/// A field of CSV.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
