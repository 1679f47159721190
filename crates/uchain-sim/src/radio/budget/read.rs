//! A budget as people write it: a name, assignments, or a file.

use std::{fs::File, io::Read as _, path::Path};

use super::LinkBudget;

/// Longest file of a budget (bytes).
const LONGEST: u64 = 65_536;

/// Why there is no budget.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct BudgetError {
    /// What was read.
    place: String,
    /// What is wrong with it, and what was expected.
    what: String,
}

impl LinkBudget {
    /// Reads a budget: "crazyflie", the path of a TOML file with the keys of [`LinkBudget`], or `key=value` with commas
    /// between.
    ///
    /// ```
    /// use uchain_sim::radio::LinkBudget;
    /// let budget = LinkBudget::read("tx_dbm=0,sensitivity_dbm=-95").unwrap();
    /// assert_eq!(budget.most_loss_db(), 85.0); // 10 dB are kept for fading
    /// let error = LinkBudget::read("tx_dbm=0").unwrap_err();
    /// assert!(error.to_string().contains("sensitivity_dbm"));
    /// ```
    ///
    /// # Errors
    /// None of these; a key that there is not, that is missing or is out of its range.
    pub fn read(text: &str) -> Result<Self, BudgetError> {
        if text == "crazyflie" {
            return Ok(Self::CRAZYFLIE);
        }
        let is_file = Path::new(text).extension().is_some_and(|end| end == "toml") && !text.contains('=');
        if is_file {
            return Self::parse(text, &content(text)?);
        }
        if !text.contains('=') {
            let what = "expected crazyflie, a file that ends in .toml, or key=value with commas between, such as \
                        tx_dbm=0,sensitivity_dbm=-95,margin_db=10";
            return Err(wrong(text, what));
        }
        Self::parse("--budget", &text.replace(',', "\n"))
    }

    fn parse(place: &str, text: &str) -> Result<Self, BudgetError> {
        let budget: Self = toml::from_str(text).map_err(|error| {
            let keys: Vec<&str> = Self::KEYS.iter().map(|key| key.name).collect();
            let message = error.message().lines().next().unwrap_or_default().to_owned();
            wrong(place, &format!("{message}; expected {}, with a number each", keys.join(", ")))
        })?;
        budget.check().map_err(|error| wrong(place, &error.to_string()))?;
        Ok(budget)
    }
}

fn wrong(place: &str, what: &str) -> BudgetError {
    BudgetError { place: place.to_owned(), what: what.to_owned() }
}

fn content(path: &str) -> Result<String, BudgetError> {
    let mut text = String::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_string(&mut text));
    match read {
        Ok(bytes) if bytes as u64 > LONGEST => Err(wrong(path, "longer than 64 KiB: no link budget")),
        Ok(_) => Ok(text),
        Err(cause) => Err(wrong(path, &cause.to_string())),
    }
}
