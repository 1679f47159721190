//! `uchain report`: statistics of a sweep, in tables and pictures.

mod markdown;
mod pictures;

use std::{
    fs,
    io::{self, BufWriter, Write as _},
    path::Path,
};

use uchain_sim::{
    analyse::Cell,
    registry::Registry,
    sweep::{
        Sweep,
        folder::{Folder, FolderError, TABLE},
        report::{Metric, each_variant, failures, metric, metrics},
    },
};

use super::Report;
use crate::{exit::Failure, flags::Quiet, output::unfinished_file};

/// Every cell of every number, for programs.
const CSV: &str = "report.csv";
/// For people.
const MARKDOWN: &str = "report.md";
/// Folder of the pictures.
const PLOTS: &str = "plots";

pub(crate) fn report(registry: Registry, asked: &Report) -> Result<(), Failure> {
    let folder = Folder::open(&asked.folder)?.with_missions(registry);
    if !folder.is_complete() {
        let runs = folder.manifest().runs;
        let there = folder.totals(&folder.sweep()?)?.runs;
        return Err(FolderError::NoTable { folder: asked.folder.clone(), there, runs }.into());
    }
    let _alone = folder.lock()?;
    clear(folder.path())?;
    let sweep = folder.sweep()?;
    let metrics = write_csv(&folder, &sweep)?;
    let failures = failures(&folder, &sweep)?;
    let plots = folder.path().join(PLOTS);
    fs::create_dir_all(&plots).map_err(|cause| Failure::Write { file: plots.clone(), cause })?;
    for metric in metrics.iter().filter(|metric| metric.constant.is_none()) {
        let values = if sweep.variants() == 1 { Some(values(&folder, &sweep, metric)?) } else { None };
        let chart = match values {
            Some(values) => Some(pictures::distribution(&sweep, &metric.name, values)),
            None => pictures::chart(&sweep, metric),
        };
        let Some(chart) = chart else { continue };
        let picture = uchain_sim::draw::sweep::chart(&chart)?;
        write(&plots.join(format!("{}.png", metric.name)), &picture.png)?;
        write(&plots.join(format!("{}.svg", metric.name)), picture.svg.as_bytes())?;
    }
    let text = markdown::write(&folder, &sweep, &folder.totals(&sweep)?, &metrics, &failures);
    write(&folder.path().join(MARKDOWN), text.as_bytes())?;
    said(&asked.quiet, folder.path(), &text)
}

/// What a number is in every run.
fn values(folder: &Folder, sweep: &Sweep, metric: &Metric) -> Result<Vec<f64>, Failure> {
    let mut values = Vec::new();
    for column in metrics(sweep).iter().filter(|column| column.name == metric.name) {
        each_variant(folder, column, |_, cells| {
            values.extend(cells.iter().filter_map(Cell::number));
            Ok::<(), FolderError>(())
        })?;
    }
    Ok(values)
}

fn said(quiet: &Quiet, folder: &Path, text: &str) -> Result<(), Failure> {
    let at = folder.display();
    quiet.report(|| {
        format!("{text}\nfrom {at}/{TABLE}; written: {at}/{MARKDOWN}, {CSV} and the pictures in {PLOTS}\n")
    })
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let written = || {
        let mut out = unfinished_file(file.parent().unwrap_or(Path::new(".")))?;
        out.write_all(bytes)?;
        out.persist(file)?;
        Ok(())
    };
    written().map_err(|cause| Failure::Write { file: file.to_owned(), cause })
}

/// Removes an older report: what it claims first.
fn clear(folder: &Path) -> Result<(), Failure> {
    let plots = fs::read_dir(folder.join(PLOTS)).into_iter().flatten().flatten();
    let plots = plots.map(|entry| entry.path()).filter(|file| !file.is_dir());
    for file in [MARKDOWN, CSV].into_iter().map(|name| folder.join(name)).chain(plots) {
        match fs::remove_file(&file) {
            Err(cause) if cause.kind() != io::ErrorKind::NotFound => {
                return Err(Failure::Write { file, cause });
            }
            _ => {}
        }
    }
    Ok(())
}

/// All cells of all numbers, a line each, as they are read: any number of variants.
fn write_csv(folder: &Folder, sweep: &Sweep) -> Result<Vec<Metric>, Failure> {
    let file = folder.path().join(CSV);
    let failed = |cause| Failure::Write { file: file.clone(), cause };
    let mut out = BufWriter::new(unfinished_file(folder.path()).map_err(failed)?);
    let keys: Vec<String> = sweep.design().keys().map(quoted).collect();
    let head: Vec<&str> = ["metric", "variant"]
        .into_iter()
        .chain(keys.iter().map(String::as_str))
        .chain(["runs", "mean", "mean_low", "mean_high", "median"])
        .collect();
    writeln!(out, "{}", head.join(",")).map_err(failed)?;
    let mut all = Vec::new();
    for column in metrics(sweep) {
        all.push(metric(folder, &column, |variant, estimate| {
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
    let out = out.into_inner().map_err(|error| failed(error.into_error()))?;
    out.persist(&file).map_err(|error| failed(error.error))?;
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
