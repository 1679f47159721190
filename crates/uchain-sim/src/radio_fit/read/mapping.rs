//! What the columns of somebody else's log are called, so that nobody has to copy it.

use super::columns::{self, COLUMNS, Column};
use crate::config::shorten;

/// Where the numbers of a column come from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Theirs {
    /// A column of the file, times a factor.
    Column {
        /// Its name; a `*` in it stands for the name of a link.
        name: String,
        /// What turns its unit into ours.
        factor: f64,
    },
    /// The same number in every row.
    Constant(f64),
}

/// Which of our columns is which of a file's: `distance_m=distance*0.01`, `rssi_dbm=rssi_*` (a link for every column that
/// is called so), `z1_m=0.2` (a number for all rows).
///
/// ```
/// use uchain_sim::radio_fit::Mapping;
/// assert!("distance_m=distance*0.01,rssi_dbm=rssiBLE".parse::<Mapping>().is_ok());
/// assert!("distance=d".parse::<Mapping>().unwrap_err().contains("did you mean 'distance_m'?"));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mapping {
    pairs: Vec<(&'static str, Theirs)>,
}

impl Mapping {
    /// Where a column's numbers come from.
    pub(super) fn theirs(&self, column: &Column) -> Option<&Theirs> {
        self.pairs.iter().find(|(ours, _)| *ours == column.name).map(|(_, theirs)| theirs)
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

impl std::str::FromStr for Mapping {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut pairs: Vec<(&'static str, Theirs)> = Vec::new();
        for pair in text.split(',').map(str::trim).filter(|pair| !pair.is_empty()) {
            let Some((ours, theirs)) = pair.split_once('=') else {
                return Err(format!(
                    "'{}': expected OURS=THEIRS, such as rssi_dbm=power or distance_m=distance*0.01",
                    shorten(pair)
                ));
            };
            let (ours, theirs) = (ours.trim(), theirs.trim());
            let Some(column) = columns::find(ours) else { return Err(unknown(ours)) };
            if pairs.iter().any(|(known, _)| *known == column.name) {
                return Err(format!("{} twice: expected it once", column.name));
            }
            pairs.push((column.name, Theirs::of(theirs)?));
        }
        Ok(Self { pairs })
    }
}

impl Theirs {
    fn of(text: &str) -> Result<Self, String> {
        if let Ok(number) = text.parse::<f64>() {
            return if number.is_finite() {
                Ok(Self::Constant(number))
            } else {
                Err(format!("'{text}': expected a number, or the name of a column"))
            };
        }
        let scaled =
            text.rsplit_once('*').and_then(|(name, factor)| Some((name, factor.parse::<f64>().ok()?)));
        let (name, factor) = scaled.unwrap_or((text, 1.0));
        if name.is_empty() || !factor.is_finite() || factor == 0.0 {
            return Err(format!("'{}': expected the name of a column, perhaps with *FACTOR", shorten(text)));
        }
        if name.matches('*').count() > 1 {
            return Err(format!("'{}': expected one * at most", shorten(name)));
        }
        Ok(Self::Column { name: name.to_owned(), factor })
    }
}

/// A name that is none of ours, with the nearest of them.
pub(super) fn unknown(name: &str) -> String {
    let known: Vec<String> = COLUMNS.iter().map(|column| column.name.to_owned()).collect();
    let all = known.join(", ");
    match crate::config::Choices::for_word(name, known).nearest {
        Some(nearest) => format!("'{}' is no column of a log; did you mean '{nearest}'?", shorten(name)),
        None => format!("'{}' is no column of a log; these are: {all}", shorten(name)),
    }
}
