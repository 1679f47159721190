//! The PNM family, as netpbm defines it: P1 to P6 (PBM, PGM, PPM, as text and as bytes) and P7 (PAM).
//! Formats: <https://netpbm.sourceforge.net/doc/pnm.html>, <https://netpbm.sourceforge.net/doc/pam.html>.

mod pam;

use super::{Layout, Picture, PictureError, check_size};

/// What stands between numbers.
const BLANKS: [u8; 6] = *b"\t\n\x0b\x0c\r ";

/// What is said of the samples before they come.
struct Head {
    cols: u32,
    rows: u32,
    /// The sample that stands for white.
    white: u32,
    /// Whether larger samples than that are refused; elsewhere they are white.
    strict: bool,
    layout: Layout,
}

/// Reads what follows a `P` and the digit `kind`, `b'1'` to `b'7'`.
pub(super) fn decode(kind: u8, rest: &[u8]) -> Result<Picture, PictureError> {
    let mut rest = Rest(rest);
    let head = match kind {
        b'7' => pam::head(&mut rest)?,
        _ => rest.head(kind)?,
    };
    check_size(head.cols, head.rows)?;
    let (cols, rows) = (head.cols as usize, head.rows as usize);
    let count = cols * rows * head.layout.samples();
    let mut samples = match kind {
        b'1' => rest.digits(count)?,
        b'2' | b'3' => rest.numbers(count, head.layout.sample_bytes)?,
        b'4' => rest.bits(cols, rows)?,
        _ => rest.take(count * head.layout.sample_bytes)?.to_vec(),
    };
    if head.strict && samples.iter().any(|&sample| u32::from(sample) > head.white) {
        return Err(PictureError::Damaged);
    }
    brighten(&mut samples, &head);
    Ok(Picture { cols, layout: head.layout, samples })
}

/// Makes the largest value of a sample's bytes stand for white.
fn brighten(samples: &mut [u8], head: &Head) {
    let two_bytes = head.layout.sample_bytes == 2;
    let full: u32 = if two_bytes { 0xffff } else { 0xff };
    if head.white == full {
        return;
    }
    let factor = full as f32 / head.white as f32;
    if two_bytes {
        for sample in samples.as_chunks_mut::<2>().0 {
            let scaled = (f32::from(u16::from_be_bytes(*sample)) * factor).round() as u16;
            *sample = scaled.to_be_bytes();
        }
    } else {
        for sample in samples {
            *sample = (f32::from(*sample) * factor).round() as u8;
        }
    }
}

/// What has not been read yet.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    /// The head of P1 to P6: columns, rows and, but for bitmaps, the sample that stands for white.
    fn head(&mut self, kind: u8) -> Result<Head, PictureError> {
        let (cols, rows) = (self.number()?, self.number()?);
        let white = if matches!(kind, b'1' | b'4') { 1 } else { self.number()? };
        let sample_bytes = match white {
            1..=0xff => 1,
            0x100..=0xffff => 2,
            _ => return Err(PictureError::Damaged),
        };
        let colours = if matches!(kind, b'3' | b'6') { 3 } else { 1 };
        Ok(Head { cols, rows, white, strict: false, layout: Layout::new(colours, false, sample_bytes) })
    }

    fn byte(&mut self) -> Option<u8> {
        let (&first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(first)
    }

    fn take(&mut self, bytes: usize) -> Result<&'a [u8], PictureError> {
        let (taken, rest) = self.0.split_at_checked(bytes).ok_or(PictureError::Damaged)?;
        self.0 = rest;
        Ok(taken)
    }

    /// A number of the head and the one blank after it. A `#` begins a comment, which lasts to the end of the line and
    /// does not end a number.
    fn number(&mut self) -> Result<u32, PictureError> {
        let (mut value, mut comment) = (None, false);
        while let Some(byte) = self.byte() {
            if comment {
                comment = !matches!(byte, b'\r' | b'\n');
            } else if byte == b'#' {
                comment = true;
            } else if !BLANKS.contains(&byte) {
                value = Some(with_digit(value.unwrap_or(0), byte)?);
            } else if value.is_some() {
                break;
            }
        }
        value.ok_or(PictureError::Damaged)
    }

    /// Samples written as numbers with blanks between them.
    fn numbers(&mut self, count: usize, sample_bytes: usize) -> Result<Vec<u8>, PictureError> {
        // Each takes a digit and a blank: what a head promises beyond that gets no memory.
        let mut samples = Vec::with_capacity(count.min(self.0.len() / 2 + 1) * sample_bytes);
        for _ in 0..count {
            let mut value = None;
            while let Some(byte) = self.byte() {
                if !BLANKS.contains(&byte) {
                    value = Some(with_digit(value.unwrap_or(0), byte)?);
                } else if value.is_some() {
                    break;
                }
            }
            let value = value.and_then(|value| u16::try_from(value).ok()).ok_or(PictureError::Damaged)?;
            match (sample_bytes, u8::try_from(value)) {
                (2, _) => samples.extend(value.to_be_bytes()),
                (_, Ok(byte)) => samples.push(byte),
                _ => return Err(PictureError::Damaged),
            }
        }
        Ok(samples)
    }

    /// Cells written as `0`, white, or `1`, black, with or without blanks between them.
    fn digits(&mut self, count: usize) -> Result<Vec<u8>, PictureError> {
        let mut samples = Vec::with_capacity(count.min(self.0.len()));
        while samples.len() < count {
            match self.byte() {
                Some(b'0') => samples.push(1),
                Some(b'1') => samples.push(0),
                Some(byte) if BLANKS.contains(&byte) => {}
                _ => return Err(PictureError::Damaged),
            }
        }
        Ok(samples)
    }

    /// Cells of a bit each, 0 for white, every row padded to whole bytes.
    fn bits(&mut self, cols: usize, rows: usize) -> Result<Vec<u8>, PictureError> {
        let row_bytes = cols.div_ceil(8);
        let bytes = self.take(row_bytes * rows)?;
        let mut samples = Vec::with_capacity(cols * rows);
        // A picture without columns has no rows either.
        for row in bytes.chunks_exact(row_bytes.max(1)) {
            let bits = row.iter().flat_map(|byte| (0..8).rev().map(move |bit| 1 - (byte >> bit & 1)));
            samples.extend(bits.take(cols));
        }
        Ok(samples)
    }
}

/// `value` with one more decimal digit.
fn with_digit(value: u32, digit: u8) -> Result<u32, PictureError> {
    let digit = char::from(digit).to_digit(10).ok_or(PictureError::Damaged)?;
    value.checked_mul(10).and_then(|tens| tens.checked_add(digit)).ok_or(PictureError::Damaged)
}
