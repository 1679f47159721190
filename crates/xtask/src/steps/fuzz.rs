//! What fuzzing has found is replayed by the tests of the fuzz targets' own workspace: without a fuzzer, on any compiler.

use anyhow::Result;

use super::Outcome;
use crate::house::{House, run};

pub(super) fn replay(house: &House) -> Result<Outcome> {
    let mut test = house.cargo("test --locked --release --manifest-path fuzz/Cargo.toml");
    run(test.env("CARGO_TARGET_DIR", house.target.join("proof/fuzz")))?;
    Ok(Outcome::Passed)
}
