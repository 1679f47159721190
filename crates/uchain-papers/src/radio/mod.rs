//! What radio does to a chain: every model beside the others, and shadows that stay in place.

mod models;
mod shadowing;

pub(super) use models::MODELS;
pub(super) use shadowing::SHADOWING;
