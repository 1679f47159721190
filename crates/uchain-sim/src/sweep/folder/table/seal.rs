//! The hash of the whole table: a page's checksum says nothing of headers and of what stands between pages.

use std::{
    fs::File,
    hash::Hasher as _,
    io::{self, Read as _, Write},
    path::Path,
};

use serde::{Deserialize, Serialize};
use twox_hash::XxHash64;

use super::super::FolderError;

/// What `sweep.json` says of the table's bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(in super::super) struct Seal {
    /// How many.
    bytes: u64,
    /// Their `XxHash64`, 16 hex digits.
    xxh64: String,
}

/// Hashes what it writes.
pub(in super::super) struct Sealing<W> {
    out: W,
    bytes: u64,
    hash: XxHash64,
}

impl<W: Write> Sealing<W> {
    pub(in super::super) fn new(out: W) -> Self {
        Self { out, bytes: 0, hash: XxHash64::with_seed(0) }
    }

    /// Of all that was written.
    pub(in super::super) fn seal(&self) -> Seal {
        Seal { bytes: self.bytes, xxh64: format!("{:016x}", self.hash.finish()) }
    }
}

impl<W: Write> Write for Sealing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.hash.write(bytes.get(..count).unwrap_or_default());
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// The seal of a file as it is now.
pub(in super::super) fn seal_of(path: &Path) -> Result<Seal, FolderError> {
    let mut file = File::open(path).map_err(FolderError::io(path, "read"))?;
    let mut sealing = Sealing::new(io::sink());
    let mut buffer = vec![0; 1 << 16];
    loop {
        let count = file.read(&mut buffer).map_err(FolderError::io(path, "read"))?;
        let Some(bytes) = buffer.get(..count).filter(|bytes| !bytes.is_empty()) else { break };
        // A sink takes all.
        sealing.write_all(bytes).map_err(FolderError::io(path, "read"))?;
    }
    Ok(sealing.seal())
}
