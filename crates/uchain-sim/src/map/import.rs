//! What a map's file says besides its walls, and how the map came out of it.

use std::fmt;

use serde::Serialize;

/// How a map came out of its file.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Import {
    /// What kind of file it was: "SVG"; empty for a map that was no file.
    pub format: &'static str,
    /// What was read, dropped, guessed, merged or separated on the way.
    pub remarks: Vec<Remark>,
}

/// What happened to a part of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RemarkKind {
    /// It was taken as it is.
    Read,
    /// It is not in the map.
    Dropped,
    /// The file does not say it; this was assumed.
    Guessed,
    /// Several of the file are one in the map.
    Merged,
    /// What lies over one another in the file is apart in the map.
    Separated,
}

/// So many parts of a file, what happened to them, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Remark {
    /// What happened.
    pub kind: RemarkKind,
    /// To how many.
    pub count: usize,
    /// What they are, and why: "text elements: a map has no words".
    pub what: String,
}

/// A place that a file has a name for: a station of a survey, a tile.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Where it lies in the file's own frame (m).
    pub at_m: [f64; 2],
    /// How high it lies (m), if the file says so.
    pub height_m: Option<f64>,
}

/// What walls are made of.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// What the file calls it.
    pub name: String,
    /// What a wall of it takes from a link (dB), if the file says so.
    pub loss_db: Option<f32>,
}

impl Import {
    /// Nothing to tell of a file of this kind yet.
    pub fn of(format: &'static str) -> Self {
        Self { format, remarks: Vec::new() }
    }

    /// What one should know of the map before a start: all that was not read as it is.
    pub fn note(&self) -> Option<String> {
        let other = self.remarks.iter().filter(|remark| remark.kind != RemarkKind::Read);
        let words: Vec<String> = other.map(ToString::to_string).collect();
        (!words.is_empty()).then(|| format!("the map, read as {}: {}", self.format, words.join("; ")))
    }

    /// Adds a remark, unless it is about nothing.
    pub fn say(&mut self, kind: RemarkKind, count: usize, what: impl Into<String>) {
        if count > 0 {
            self.remarks.push(Remark { kind, count, what: what.into() });
        }
    }
}

impl fmt::Display for RemarkKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Read => "read",
            Self::Dropped => "dropped",
            Self::Guessed => "guessed",
            Self::Merged => "merged",
            Self::Separated => "separated",
        })
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.kind, self.count, self.what)
    }
}
