//! Models around another one: what adds to the loss of whatever model a scenario names.

mod antennas;
mod field;
mod ground;
mod shadowing;

use std::sync::Arc;

use super::{RadioModel, RadioParams};

pub use shadowing::Shadowed;

use antennas::Antennas;
use ground::Ground;

/// A model with all around it that the table `[radio]` asks for; itself where it asks for nothing.
pub(crate) fn around(params: &RadioParams, model: Arc<dyn RadioModel>) -> Arc<dyn RadioModel> {
    let mut model = model;
    if params.ground_db > 0.0 {
        model = Arc::new(Ground { inner: model, ground_db: params.ground_db });
    }
    if params.antenna_offset_db > 0.0 || params.yaw_db > 0.0 {
        model = Arc::new(Antennas::new(model, params));
    }
    if params.sigma_static_db > 0.0 {
        model = Arc::new(Shadowed::new(model, params));
    }
    model
}
