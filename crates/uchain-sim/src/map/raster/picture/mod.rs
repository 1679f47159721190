//! Pictures of map files, PNG and the PNM family (PBM, PGM, PPM, PAM), told apart by their first bytes: grey values
//! without colour management, which a map has no use for.

mod png;
mod pnm;
#[cfg(test)]
mod tests;

/// Most cells along a side of the picture.
const MOST_SIDE: u32 = 16_384;
/// Most cells of the picture.
const MOST_CELLS: u64 = 1 << 26;

/// Why a picture cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(in crate::map) enum PictureError {
    /// Another format, or a kind of PAM that its definition does not know.
    #[error("no picture that is read here; expected a PNG or PGM")]
    Unknown,
    /// A side too long, or a file that asks for too much memory.
    #[error("too large a picture; expected at most {MOST_SIDE} cells a side and {MOST_CELLS} in all")]
    TooLarge,
    /// Sides short enough, but too many cells in all.
    #[error("{cols} × {rows} cells: more than {MOST_CELLS}")]
    TooManyCells {
        /// Cells along a row.
        cols: u32,
        /// Rows.
        rows: u32,
    },
    /// Not what its own head says.
    #[error("the picture is cut short or damaged; save it anew as PNG or PGM")]
    Damaged,
}

/// A picture's samples as a file holds them, rows from the top, scaled so that the largest value is white.
#[derive(Debug)]
pub(super) struct Picture {
    cols: usize,
    layout: Layout,
    samples: Vec<u8>,
}

/// What the samples of a pixel mean.
#[derive(Debug, Clone, Copy)]
struct Layout {
    /// Grey or red, green and blue: 1 or 3 samples.
    colours: usize,
    /// Whether the opacity follows.
    alpha: bool,
    /// Bytes of a sample, 1 or 2, the higher one first.
    sample_bytes: usize,
}

impl Layout {
    const fn new(colours: usize, alpha: bool, sample_bytes: usize) -> Self {
        Self { colours, alpha, sample_bytes }
    }

    const fn samples(self) -> usize {
        self.colours + self.alpha as usize
    }

    const fn pixel_bytes(self) -> usize {
        self.samples() * self.sample_bytes
    }
}

/// A pixel of a [`Picture`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixel {
    /// Mean of its colours, each rounded to a byte first; 0 is black, 255 white.
    pub(super) mean: f64,
    /// Whether nothing shines through.
    pub(super) opaque: bool,
}

impl Picture {
    /// The picture a file holds.
    ///
    /// # Errors
    /// See [`PictureError`].
    pub(super) fn decode(file: &[u8]) -> Result<Self, PictureError> {
        match file {
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => png::decode(file),
            [b'P', kind @ b'1'..=b'7', rest @ ..] => pnm::decode(*kind, rest),
            _ => Err(PictureError::Unknown),
        }
    }

    /// Pixels of a row.
    pub(super) fn cols(&self) -> usize {
        self.cols
    }

    /// All pixels, the top row first.
    pub(super) fn pixels(&self) -> impl Iterator<Item = Pixel> {
        let layout = self.layout;
        self.samples.chunks_exact(layout.pixel_bytes()).map(move |pixel| {
            let (colours, alpha) = pixel.split_at(layout.colours * layout.sample_bytes);
            let sum: u16 =
                colours.chunks_exact(layout.sample_bytes).map(|sample| u16::from(byte(sample))).sum();
            let mean = f64::from(sum) / layout.colours as f64;
            Pixel { mean, opaque: alpha.iter().all(|&byte| byte == u8::MAX) }
        })
    }
}

/// A sample of one or two bytes, rounded to one.
fn byte(sample: &[u8]) -> u8 {
    match *sample {
        [high, low] => ((u32::from(high) << 8 | u32::from(low)) + 128).wrapping_div(257) as u8,
        _ => sample.first().copied().unwrap_or_default(),
    }
}

/// Refuses what is too large before memory is asked for.
fn check_size(cols: u32, rows: u32) -> Result<(), PictureError> {
    if cols > MOST_SIDE || rows > MOST_SIDE {
        return Err(PictureError::TooLarge);
    }
    if u64::from(cols) * u64::from(rows) > MOST_CELLS {
        return Err(PictureError::TooManyCells { cols, rows });
    }
    Ok(())
}
