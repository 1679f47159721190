//! A fit for people: words, a table for a scenario, a picture.

#[cfg(feature = "draw")]
mod picture;
mod words;
