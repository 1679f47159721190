//! Whether C answered as the core did, bit by bit.

use std::{error::Error, fs, path::Path};

use crate::steps::REPLY;

/// What starts at which byte of a reply.
const FIELDS: [(usize, &str); 24] = [
    (0, "status of uchain_step"),
    (1, "status of uchain_explain"),
    (2, "airborne"),
    (3, "length of what it says"),
    (4, "forward_mps"),
    (8, "lateral_mps"),
    (12, "yaw_rate_radps"),
    (16, "back_filtered_db"),
    (20, "back_variance_db2"),
    (24, "back_raw_db"),
    (28, "back_silent_s"),
    (32, "front_filtered_db"),
    (36, "front_variance_db2"),
    (40, "front_raw_db"),
    (44, "front_silent_s"),
    (48, "imbalance_db"),
    (52, "wish_mps"),
    (56, "allowed_mps"),
    (60, "speed_share"),
    (64, "place"),
    (66, "role and stage"),
    (68, "overridden, follow and walls"),
    (71, "nothing"),
    (76, "what it says"),
];

pub(crate) fn compare(folder: &Path) -> Result<(), Box<dyn Error>> {
    let read = |name| fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"));
    let (expected, replies) = (read("expected.bin")?, read("replies.bin")?);
    if expected.len() != replies.len() {
        return Err(format!("{} bytes of replies, expected {}", replies.len(), expected.len()).into());
    }
    let steps = expected.len() / REPLY;
    let pairs = expected.chunks(REPLY).zip(replies.chunks(REPLY));
    let mut different = pairs.enumerate().filter(|(_, (ours, theirs))| ours != theirs);
    let Some((step, (ours, theirs))) = different.next() else {
        println!("same bits: {steps} steps, 0 differences");
        return Ok(());
    };
    let byte = ours.iter().zip(theirs).position(|(ours, theirs)| ours != theirs).unwrap_or_default();
    let field = FIELDS.iter().rev().find(|(start, _)| *start <= byte).map_or("?", |(_, name)| name);
    Err(format!(
        "other bits: {steps} steps, {} differences, the first at step {step} in {field}",
        1 + different.count()
    )
    .into())
}
