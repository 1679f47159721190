//! The steps that ask Python: whether others read what we write, and whether the module is what it says; and
//! the one that drives a browser.

mod environment;
mod results;
mod web;
mod wheel;

pub(super) use results::are_read;
pub(super) use web::flies_in_a_browser;
pub(super) use wheel::is_what_it_says;
pub(crate) use wheel::{PACKS_WITH, build_for_maturin};
