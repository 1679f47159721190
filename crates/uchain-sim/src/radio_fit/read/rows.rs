//! The rows of a log: packets that were heard, packets that were not.

use super::{
    Anchors, LINKS_MAX, Log, ReadOptions, SAMPLES_MAX, Sample,
    columns::{Column, Of},
    header::{From, Header},
    notes::Counts,
    table,
};
use crate::{config::shorten, radio_fit::FitError};

/// Longest gap between two numbers that is packets not heard (packets); a longer one is a break.
const GAP_MAX: f64 = 1_000.0;
/// Names of links that are shown.
const SHOWN: usize = 12;

pub(super) fn read(
    text: &str,
    label: &str,
    anchors: Option<&Anchors>,
    options: &ReadOptions,
) -> Result<Log, FitError> {
    let mut lines = table::lines(text);
    let mut names = Vec::new();
    let line_error = |line: usize, why: String| FitError::Line { label: label.to_owned(), line, why };
    let broken = |line| line_error(line, "a quotation that does not end".to_owned());
    let Some((line, first)) = lines.next() else {
        let why = "empty: expected a table in CSV (uchain radio fit --template prints one)".to_owned();
        return Err(FitError::Whole { label: label.to_owned(), why });
    };
    table::cells(first, &mut names).ok_or_else(|| broken(line))?;
    let header = Header::of(&names, &options.mapping, anchors).map_err(|why| line_error(line, why))?;
    let mut rows = Rows::new(label, &header, anchors, options);
    let mut cells = Vec::new();
    for (line, row) in lines {
        table::cells(row, &mut cells).ok_or_else(|| broken(line))?;
        if cells.len() != names.len() {
            let why =
                format!("{} cells: expected {}, as many as there are columns", cells.len(), names.len());
            return Err(line_error(line, why));
        }
        rows.row(line, &cells)?;
    }
    if let Some(only) = options.link.as_ref().filter(|only| !rows.links.contains(only)) {
        let links = rows.others.join(", ");
        let why = format!("no link is called '{}': it has {links}", shorten(only));
        return Err(FitError::Whole { label: label.to_owned(), why });
    }
    Ok(rows.end())
}

/// The last packet of a link and a walk.
struct Last {
    walk: String,
    link: usize,
    seq: f64,
    sample: usize,
}

struct Rows<'a> {
    label: &'a str,
    header: &'a Header,
    anchors: Option<&'a Anchors>,
    options: &'a ReadOptions,
    has_places: bool,
    has_heights: bool,
    links: Vec<String>,
    /// Links that are not asked for.
    others: Vec<String>,
    samples: Vec<Sample>,
    last: Vec<Last>,
    counts: Counts,
}

impl<'a> Rows<'a> {
    fn new(
        label: &'a str,
        header: &'a Header,
        anchors: Option<&'a Anchors>,
        options: &'a ReadOptions,
    ) -> Self {
        let has = |of: Of| header.number(of).is_some();
        let has_places =
            has(Of::End(0)) && has(Of::End(1)) && (has(Of::End(3)) && has(Of::End(4)) || anchors.is_some());
        let other =
            if has(Of::End(3)) { has(Of::End(5)) } else { anchors.is_some_and(|anchors| anchors.has_height) };
        Self {
            label,
            header,
            anchors,
            options,
            has_places,
            has_heights: has(Of::End(2)) && other,
            links: Vec::new(),
            others: Vec::new(),
            samples: Vec::new(),
            last: Vec::new(),
            counts: Counts::default(),
        }
    }

    fn wrong(&self, line: usize, name: &str, got: &str, expected: &str) -> FitError {
        let (label, column) = (self.label.to_owned(), shorten(name));
        FitError::Cell { label, line, column, got: shorten(got), expected: expected.to_owned() }
    }

    /// The number that a row has for a column; `None` of an empty cell and of one that says so.
    fn number(
        &self,
        line: usize,
        cells: &[&str],
        column: &Column,
        from: &From,
    ) -> Result<Option<f64>, FitError> {
        let (value, name, got) = match from {
            From::Constant(value) => (*value, column.name, ""),
            From::Cell { place, factor, name } => {
                let got = cells.get(*place).copied().unwrap_or_default();
                if got.is_empty() {
                    return Ok(None);
                }
                let value: f64 = got.parse().map_err(|_| {
                    self.wrong(line, name, got, "expected a number, or an empty cell where there was none")
                })?;
                let is_lost = matches!(column.of, Of::Rssi | Of::Loss) && self.options.lost == Some(value);
                if value.is_nan() || is_lost {
                    return Ok(None);
                }
                (value * factor, name.as_str(), got)
            }
        };
        let (low, high, hint) = column.sound;
        if (low..=high).contains(&value) { Ok(Some(value)) } else { Err(self.wrong(line, name, got, hint)) }
    }

    fn row(&mut self, line: usize, cells: &[&str]) -> Result<(), FitError> {
        let header = self.header;
        let number = |of: Of| match header.number(of) {
            Some((column, from)) => self.number(line, cells, column, from),
            None => Ok(None),
        };
        let seq = number(Of::Seq)?;
        let distance_m = number(Of::Distance)?;
        let mut ends_m = [None; 6];
        for (place, end_m) in ends_m.iter_mut().enumerate() {
            *end_m = number(Of::End(place))?;
        }
        let cell =
            |place: Option<usize>| place.and_then(|place| cells.get(place)).copied().unwrap_or_default();
        let (link, walk) = (cell(header.link), cell(header.walk));
        for losses in &header.losses {
            let link = losses.link.as_deref().unwrap_or(link);
            if self.options.link.as_deref().is_some_and(|only| only != link) {
                if self.others.len() < SHOWN && !self.others.iter().any(|other| other == link) {
                    self.others.push(shorten(link));
                }
                continue;
            }
            let loss_db = self.number(line, cells, losses.column, &losses.from)?;
            self.counts.zeros += usize::from(loss_db == Some(0.0));
            let loss_db = match losses.column.of {
                Of::Rssi => loss_db.map(|rssi_dbm| self.options.tx_dbm.unwrap_or(0.0) - rssi_dbm),
                _ => loss_db,
            };
            let Some((distance_m, ends_m)) = self.place(line, link, distance_m, ends_m)? else {
                self.counts.no_place += 1;
                continue;
            };
            let link = self.link(line, link)?;
            self.packet(seq, walk, Sample { line, link, loss_db, distance_m, ends_m })?;
        }
        Ok(())
    }

    /// Distance and places of a packet; `None` where they are not said.
    fn place(
        &self,
        line: usize,
        link: &str,
        distance_m: Option<f64>,
        ends_m: [Option<f64>; 6],
    ) -> Result<Option<(f64, [f64; 6])>, FitError> {
        let said = |distance_m: f64| (distance_m, [distance_m, 0.0, 0.0, 0.0, 0.0, 0.0]);
        if !self.has_places {
            return Ok(distance_m.map(said));
        }
        let [x1, y1, z1, x2, y2, z2] = ends_m;
        let other = match (x2.zip(y2), self.anchors) {
            (Some((x, y)), _) => Some([x, y, z2.unwrap_or(0.0)]),
            (None, None) => None,
            (None, Some(anchors)) => Some(anchors.at(link).ok_or_else(|| FitError::Line {
                label: self.label.to_owned(),
                line,
                why: format!(
                    "no anchor '{}' in {}: it has {}",
                    shorten(link),
                    anchors.label,
                    anchors.names()
                ),
            })?),
        };
        let (Some((x1, y1)), Some([x2, y2, z2])) = (x1.zip(y1), other) else { return Ok(None) };
        let (z1, z2) = if self.has_heights { (z1.unwrap_or(0.0), z2) } else { (0.0, 0.0) };
        let apart_m = libm::hypot(libm::hypot(x2 - x1, y2 - y1), z2 - z1);
        Ok(Some((distance_m.unwrap_or(apart_m), [x1, y1, z1, x2, y2, z2])))
    }

    /// The number of a link, a new one for a new name.
    fn link(&mut self, line: usize, name: &str) -> Result<usize, FitError> {
        if let Some(known) = self.links.iter().position(|known| known == name) {
            return Ok(known);
        }
        if self.links.len() == LINKS_MAX {
            let why = format!("more than {LINKS_MAX} links: is the right column called link?");
            return Err(FitError::Line { label: self.label.to_owned(), line, why });
        }
        self.links.push(shorten(name));
        Ok(self.links.len() - 1)
    }

    /// Takes a packet in, and before it those that its number says were sent and not heard, on the straight way between.
    fn packet(&mut self, seq: Option<f64>, walk: &str, sample: Sample) -> Result<(), FitError> {
        if let Some(seq) = seq {
            let known = self.last.iter().position(|last| last.link == sample.link && last.walk == walk);
            if let Some(last) = known.and_then(|known| self.last.get(known)) {
                let missing = seq - last.seq - 1.0;
                if (1.0..=GAP_MAX).contains(&missing) {
                    let before = self.samples.get(last.sample).cloned();
                    for nth in 1..=missing as usize {
                        let share = nth as f64 / (missing + 1.0);
                        let Some(before) = &before else { break };
                        let between = |a: f64, b: f64| a + share * (b - a);
                        let ends_m = std::array::from_fn(|i| between(before.ends_m[i], sample.ends_m[i]));
                        let distance_m = between(before.distance_m, sample.distance_m);
                        self.push(Sample { loss_db: None, distance_m, ends_m, ..sample.clone() })?;
                        self.counts.gaps += 1;
                    }
                } else if missing != 0.0 {
                    self.counts.breaks += 1;
                }
            }
            let last = Last { walk: walk.to_owned(), link: sample.link, seq, sample: self.samples.len() };
            if let Some(known) = known.and_then(|known| self.last.get_mut(known)) {
                *known = last;
            } else if self.last.len() < LINKS_MAX {
                self.last.push(last);
            }
        }
        self.push(sample)
    }

    fn push(&mut self, sample: Sample) -> Result<(), FitError> {
        if self.samples.len() == SAMPLES_MAX {
            let why = format!("more than {SAMPLES_MAX} packets: cut the log, or leave every second row out");
            return Err(FitError::Line { label: self.label.to_owned(), line: sample.line, why });
        }
        self.samples.push(sample);
        Ok(())
    }

    fn end(self) -> Log {
        let notes = self.counts.words(self.header, self.options, self.has_places);
        let (label, links) = (self.label.to_owned(), self.links);
        Log { label, links, samples: self.samples, has_places: self.has_places, notes }
    }
}
