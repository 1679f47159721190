//! Choices as words: the ones that scenarios have for them.

use pyo3::{exceptions::PyValueError, prelude::*};
use uchain_core::chain::{Follow, Role};

/// The choice of a word.
///
/// # Errors
/// `ValueError` with the words there are.
pub(super) fn choice<T: Copy>(name: &str, word: &str, known: &[(&str, T)]) -> PyResult<T> {
    if let Some((_, chosen)) = known.iter().find(|(known, _)| *known == word) {
        return Ok(*chosen);
    }
    let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
    let got: String = word.chars().take(40).collect();
    Err(PyValueError::new_err(format!("{name}: '{got}'; expected {}", words.join(", "))))
}

pub(super) const FOLLOW: [(&str, Follow); 3] =
    [("centre", Follow::Centre), ("left", Follow::Left), ("right", Follow::Right)];
pub(super) const ROLES: [(&str, Role); 2] = [("head", Role::Head), ("relay", Role::Relay)];
