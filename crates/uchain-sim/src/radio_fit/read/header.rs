//! Which cell of a row is which of our columns.

use super::{
    Anchors, LINKS_MAX,
    columns::{self, COLUMNS, Column, Of},
    mapping::{Mapping, Theirs, unknown},
};
use crate::config::{Choices, shorten};

/// Where a number stands in a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum From {
    Cell { place: usize, factor: f64, name: String },
    Constant(f64),
}

/// A column with losses, and the link that all of them belong to if it has one of its own.
#[derive(Debug)]
pub(super) struct Losses {
    pub(super) from: From,
    pub(super) column: &'static Column,
    pub(super) link: Option<String>,
}

/// Which cell is what.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) losses: Vec<Losses>,
    pub(super) numbers: Vec<(&'static Column, From)>,
    pub(super) link: Option<usize>,
    pub(super) walk: Option<usize>,
    /// Columns that are not read.
    pub(super) left_out: Vec<String>,
}

impl Header {
    pub(super) fn number(&self, of: Of) -> Option<&(&'static Column, From)> {
        self.numbers.iter().find(|(column, _)| column.of == of)
    }

    /// Of the names in the first line, or what is wrong with them.
    pub(super) fn of(names: &[&str], mapping: &Mapping, anchors: Option<&Anchors>) -> Result<Self, String> {
        let mut header =
            Self { losses: Vec::new(), numbers: Vec::new(), link: None, walk: None, left_out: Vec::new() };
        let mut read = vec![false; names.len()];
        for column in COLUMNS {
            let own = || {
                names
                    .iter()
                    .position(|name| columns::find(name).is_some_and(|found| found.name == column.name))
            };
            let from = match mapping.theirs(column) {
                None => own().map(|place| From::Cell { place, factor: 1.0, name: names[place].to_owned() }),
                Some(Theirs::Constant(value)) => Some(From::Constant(*value)),
                Some(Theirs::Column { name, factor }) => {
                    if let Some((before, after)) = name.split_once('*') {
                        header.wide(names, column, (before, after), *factor, &mut read)?;
                        continue;
                    }
                    let place = names.iter().position(|there| there == name);
                    let place = place.ok_or_else(|| not_there(name, names))?;
                    Some(From::Cell { place, factor: *factor, name: name.clone() })
                }
            };
            let Some(from) = from else { continue };
            let place = if let From::Cell { place, .. } = &from { Some(*place) } else { None };
            if let Some(is_read) = place.and_then(|place| read.get_mut(place)) {
                *is_read = true;
            }
            match column.of {
                Of::Rssi | Of::Loss => header.losses.push(Losses { from, column, link: None }),
                Of::Link => header.link = place,
                Of::Walk => header.walk = place,
                _ => header.numbers.push((column, from)),
            }
        }
        header.left_out =
            names.iter().zip(&read).filter(|(_, read)| !**read).map(|(name, _)| shorten(name)).collect();
        header.agree(names, anchors)?;
        Ok(header)
    }

    /// A link for every column that is called so.
    fn wide(
        &mut self,
        names: &[&str],
        column: &'static Column,
        (before, after): (&str, &str),
        factor: f64,
        read: &mut [bool],
    ) -> Result<(), String> {
        if !matches!(column.of, Of::Rssi | Of::Loss) {
            return Err(format!(
                "--columns {}={before}*{after}: only losses may have a column for every link",
                column.name
            ));
        }
        let links = names.iter().enumerate().filter_map(|(place, name)| {
            let link = name.strip_prefix(before)?.strip_suffix(after)?;
            (!link.is_empty()).then(|| (place, (*name).to_owned(), link.to_owned()))
        });
        for (place, name, link) in links {
            if let Some(is_read) = read.get_mut(place) {
                *is_read = true;
            }
            self.losses.push(Losses { from: From::Cell { place, factor, name }, column, link: Some(link) });
        }
        match self.losses.len() {
            0 => Err(format!("no column is called {before}*{after}; there are {}", some(names))),
            count if count > LINKS_MAX => {
                Err(format!("more than {LINKS_MAX} columns are called {before}*{after}"))
            }
            _ => Ok(()),
        }
    }

    /// What must be there.
    fn agree(&self, names: &[&str], anchors: Option<&Anchors>) -> Result<(), String> {
        let has = |of: Of| self.number(of).is_some();
        let words = "(columns: uchain radio fit --help; other names: --columns OURS=THEIRS)";
        if self.losses.is_empty() {
            let near = names.iter().find_map(|name| nearest(name, &["rssi_dbm", "loss_db"]));
            let near =
                near.map(|(name, ours)| format!("; did you mean '{ours}' by '{name}'?")).unwrap_or_default();
            return Err(format!("no column rssi_dbm or loss_db{near}; there are {} {words}", some(names)));
        }
        if self.losses.iter().any(|losses| losses.column.of != self.losses[0].column.of) {
            return Err("rssi_dbm and loss_db are one thing: expected one of them".to_owned());
        }
        let first = has(Of::End(0)) && has(Of::End(1));
        let second = (has(Of::End(3)) && has(Of::End(4))) || anchors.is_some();
        if !(has(Of::Distance) || first && second) {
            let missing = match (first, second) {
                (true, false) => {
                    "x1_m and y1_m are there, but not where the other end is: x2_m and y2_m, or --anchors FILE"
                }
                (false, true) => "the other end is known, but not x1_m and y1_m",
                _ => "no column distance_m, and no places x1_m, y1_m, x2_m, y2_m",
            };
            return Err(format!("{missing}; there are {} {words}", some(names)));
        }
        if anchors.is_some() && self.link.is_none() && self.losses.iter().any(|losses| losses.link.is_none())
        {
            return Err(format!(
                "--anchors needs to know who was heard: no column link, nor rssi_dbm=NAME* in --columns; there are {}",
                some(names)
            ));
        }
        Ok(())
    }
}

fn nearest(name: &str, ours: &[&str]) -> Option<(String, String)> {
    let known = ours.iter().map(|&name| name.to_owned()).collect();
    let nearest = Choices::for_word(name, known).nearest?;
    Some((shorten(name), nearest))
}

fn not_there(name: &str, names: &[&str]) -> String {
    let known = names.iter().map(|&name| name.to_owned()).collect();
    match Choices::for_word(name, known).nearest {
        Some(nearest) => {
            format!("no column is called '{}'; did you mean '{}'?", shorten(name), shorten(&nearest))
        }
        None => format!("no column is called '{}'; there are {}", shorten(name), some(names)),
    }
}

fn some(names: &[&str]) -> String {
    const SHOWN: usize = 12;
    if names.iter().all(|name| name.parse::<f64>().is_ok()) {
        return "numbers only: expected a first line with names".to_owned();
    }
    for (separator, words) in [('\t', "tabs"), (';', "semicolons")] {
        if names.len() == 1 && names[0].contains(separator) {
            return format!("cells between {words}: expected commas");
        }
    }
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| shorten(name)).collect();
    let more = if names.len() > SHOWN { ", …" } else { "" };
    shown.join(", ") + more
}

/// Nothing is left of a typing error in a column's own name.
pub(super) fn looks_meant(name: &str) -> Option<String> {
    let words = unknown(name);
    words.contains("did you mean").then_some(words)
}
