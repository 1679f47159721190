//! The little of ZIP that NPZ files are made of: members that are stored or deflated, found by the directory at the end.

use std::io::Read as _;

use flate2::{Crc, read::DeflateDecoder};

use super::{BYTES_MAX, TableError};

/// A directory ends in this record and a comment of no more than so many bytes.
const END: &[u8] = b"PK\x05\x06";
const END_BYTES: usize = 22;
const COMMENT_MAX: usize = u16::MAX as usize;
/// Most members; an NPZ file has one for each array.
const MEMBERS_MAX: usize = 1000;

fn bad(why: &'static str) -> TableError {
    TableError::Archive { why }
}

fn u16_at(bytes: &[u8], at: usize) -> Option<usize> {
    let bytes = bytes.get(at..at.checked_add(2)?)?.try_into().ok()?;
    Some(u16::from_le_bytes(bytes).into())
}

fn u32_at(bytes: &[u8], at: usize) -> Option<usize> {
    let bytes = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
    Some(u32::from_le_bytes(bytes) as usize)
}

fn part(bytes: &[u8], start: usize, length: usize) -> Option<&[u8]> {
    bytes.get(start..start.checked_add(length)?)
}

/// A line of the directory.
struct Member {
    method: usize,
    crc: u32,
    packed: usize,
    whole: usize,
    at: usize,
}

/// The bytes of a member; `None` if there is none of this name.
pub(super) fn member(bytes: &[u8], name: &str) -> Result<Option<Vec<u8>>, TableError> {
    let tail = bytes.len().saturating_sub(END_BYTES + COMMENT_MAX);
    let last = bytes[tail..].windows(END.len()).rposition(|window| window == END);
    let end = tail + last.ok_or(bad("its directory is missing: is it cut short?"))?;
    let cut = || bad("its directory is cut short");
    let count = u16_at(bytes, end + 10).ok_or_else(cut)?;
    let comment = u16_at(bytes, end + 20).ok_or_else(cut)?;
    if end + END_BYTES + comment != bytes.len() {
        return Err(cut());
    }
    if count > MEMBERS_MAX {
        return Err(bad("more than 1000 members"));
    }
    let mut at = u32_at(bytes, end + 16).ok_or_else(cut)?;
    for _ in 0..count {
        let (line, next) = line(bytes, at).ok_or_else(cut)?;
        if line.0 == name.as_bytes() {
            return unpacked(bytes, &line.1).map(Some);
        }
        at = next;
    }
    Ok(None)
}

/// A line of the directory with its name, and where the next one begins.
fn line(bytes: &[u8], at: usize) -> Option<((&[u8], Member), usize)> {
    let line = part(bytes, at, 46).filter(|line| line.starts_with(b"PK\x01\x02"))?;
    let member = Member {
        method: u16_at(line, 10)?,
        crc: u32_at(line, 16)? as u32,
        packed: u32_at(line, 20)?,
        whole: u32_at(line, 24)?,
        at: u32_at(line, 42)?,
    };
    let [name, extra, comment] = [u16_at(line, 28)?, u16_at(line, 30)?, u16_at(line, 32)?];
    Some(((part(bytes, at + 46, name)?, member), at + 46 + name + extra + comment))
}

fn unpacked(bytes: &[u8], member: &Member) -> Result<Vec<u8>, TableError> {
    // What is packed may grow a thousandfold.
    if member.whole as u64 > BYTES_MAX {
        return Err(bad("an array of more than 64 MiB"));
    }
    let packed = (|| {
        let head = part(bytes, member.at, 30).filter(|head| head.starts_with(b"PK\x03\x04"))?;
        let start = member.at + 30 + u16_at(head, 26)? + u16_at(head, 28)?;
        part(bytes, start, member.packed)
    })();
    let packed = packed.ok_or(bad("an array is cut short"))?;
    let whole = match member.method {
        0 => packed.to_vec(),
        8 => {
            let mut whole = Vec::new();
            let most = member.whole as u64 + 1;
            let read = DeflateDecoder::new(packed).take(most).read_to_end(&mut whole);
            read.map_err(|_| bad("an array is damaged"))?;
            whole
        }
        _ => return Err(bad("an array is neither stored nor deflated")),
    };
    let mut crc = Crc::new();
    crc.update(&whole);
    if whole.len() != member.whole || crc.sum() != member.crc {
        return Err(bad("an array is damaged"));
    }
    Ok(whole)
}
