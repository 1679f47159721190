//! The radio a scenario asks for.

use std::sync::Arc;

use super::refuse;
use crate::{
    config::{ConfigError, Document},
    map::Map,
    radio::{RadioError, RadioKind, RadioModel, RadioParams},
};

/// The model that `radio.model` names, in a map: a built-in one or one of a program's `own`. Its file, if it has one, is read
/// from the folder of the document.
///
/// # Errors
/// [`ConfigError::UnknownChoice`], naming what there is; what the model cannot do with the table or the map.
pub fn lay_radio(
    params: &RadioParams,
    map: &Map,
    own: &[RadioKind],
    document: &Document<'_>,
) -> Result<Arc<dyn RadioModel>, ConfigError> {
    let known = || RadioKind::BUILTIN.iter().chain(own);
    let mut named = known().filter(|kind| kind.word() == params.model);
    let (Some(kind), others) = (named.next(), named.count()) else {
        let words: Vec<&str> = known().map(RadioKind::word).collect();
        return Err(document.unknown_choice("radio.model", &params.model, &words));
    };
    if others > 0 {
        let expected = "this program gives the word to more than one model";
        return Err(document.invalid("radio.model", &format!("\"{}\"", kind.word()), expected));
    }
    let mut params = params.clone();
    params.table_file =
        params.table_file.map(|file| document.folder().join(file).to_string_lossy().into_owned());
    kind.make(&params, map).map_err(|error| match error {
        RadioError::Map { key, cause } => refuse(document, &format!("radio.{key}"), cause),
        RadioError::Table { file, cause } => {
            document.invalid("radio.table_file", &format!("{file:?}"), cause.to_string())
        }
        RadioError::Value { key, got, expected } => document.invalid(&format!("radio.{key}"), &got, expected),
    })
}
