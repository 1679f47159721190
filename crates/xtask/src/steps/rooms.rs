//! No room of a crate imports one that imports it.

use anyhow::Result;

use super::Outcome;
use crate::{
    house::House,
    rooms::{check, graphs},
};

pub(super) fn have_no_circle(house: &House) -> Result<Outcome> {
    let graphs = graphs(&house.root.join("crates"))?;
    check(&graphs, &house.root)?;
    println!("{} crates, programs and rooms with rooms in them: no circle", graphs.len());
    Ok(Outcome::Passed)
}
