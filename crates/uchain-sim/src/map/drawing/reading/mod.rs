//! What the readers of drawings share: curves as straight pieces, what names say, rings as areas, passages along lines.

pub(in crate::map) mod curve;
pub(in crate::map) mod names;
pub(in crate::map) mod passage;
pub(in crate::map) mod rings;
