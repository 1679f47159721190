//! One number for all bits of a run.

use std::hash::Hasher;

use twox_hash::XxHash64;

use crate::record::{RecordError, Recorder, Snapshot};

/// `XxHash64` over every field of every frame, in order.
#[derive(Debug)]
pub struct Digest {
    hash: XxHash64,
    /// One frame's bytes: the hash takes its time over every call, however small.
    bytes: Vec<u8>,
}

impl Default for Digest {
    fn default() -> Self {
        Self { hash: XxHash64::with_seed(0), bytes: Vec::new() }
    }
}

impl Digest {
    /// What has been seen so far, as 16 hex digits.
    pub fn hex(&self) -> String {
        format!("{:016x}", self.hash.finish())
    }
}

impl<F: Snapshot> Recorder<F> for Digest {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.bytes.clear();
        frame.hash(&mut self.bytes);
        self.hash.write(&self.bytes);
        Ok(())
    }
}
