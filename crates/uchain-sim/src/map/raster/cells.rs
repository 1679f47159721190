//! From a picture's bytes to free cells and all others.

use std::io::Cursor;

use image::{DynamicImage, ImageReader, Limits};

use super::words;
use crate::map::Unknown;

/// Most cells along a side of the picture.
pub(super) const MOST_SIDE: u32 = 16_384;
/// Most cells of the picture.
pub(super) const MOST_CELLS: u64 = 1 << 26;

/// How a pixel's darkness is read.
#[derive(Debug, Clone, Copy)]
pub(super) struct Levels {
    /// Whether light is occupied.
    pub(super) negate: bool,
    /// Darkness above which a cell is rock, 0 to 1.
    pub(super) occupied: f64,
    /// Darkness below which a cell is free, 0 to 1.
    pub(super) free: f64,
    /// Whether a cell is unknown if it is not wholly opaque, however dark.
    pub(super) by_opacity: bool,
}

impl Levels {
    fn is_free(self, mean: f64, unknown: Unknown) -> bool {
        let darkness = if self.negate { mean / 255.0 } else { (255.0 - mean) / 255.0 };
        darkness <= self.occupied && (darkness < self.free || unknown == Unknown::Free)
    }
}

/// Which cells of a picture are free. Row 0 is the lowest.
#[derive(Debug)]
pub(super) struct Cells {
    cols: usize,
    rows: usize,
    free: Vec<bool>,
}

impl Cells {
    /// `free` holds rows of `cols` cells, from the lowest row up.
    pub(super) fn new(cols: usize, free: Vec<bool>) -> Self {
        Self { cols, rows: free.len().checked_div(cols).unwrap_or(0), free }
    }

    pub(super) fn decode(bytes: &[u8], levels: Levels, unknown: Unknown) -> Result<Self, String> {
        let mut limits = Limits::default();
        limits.max_image_width = Some(MOST_SIDE);
        limits.max_image_height = Some(MOST_SIDE);
        let reader = || {
            let mut reader = ImageReader::new(Cursor::new(bytes))
                .with_guessed_format()
                .map_err(|error| error.to_string())?;
            reader.limits(limits.clone());
            Ok::<_, String>(reader)
        };
        let (width, height) = reader()?.into_dimensions().map_err(|error| words::picture(&error))?;
        if u64::from(width) * u64::from(height) > MOST_CELLS {
            return Err(format!("{width} × {height} cells: more than {MOST_CELLS}"));
        }
        let picture = reader()?.decode().map_err(|error| words::picture(&error))?;
        let cols = picture.width() as usize;
        let opaque = levels.by_opacity.then(|| opaque(&picture)).flatten();
        let mut free: Vec<bool> = match picture {
            DynamicImage::ImageLuma8(grey) => {
                grey.pixels().map(|pixel| levels.is_free(f64::from(pixel.0[0]), unknown)).collect()
            }
            // The mean is over the colours alone.
            colours => {
                let mean = |[r, g, b]: [u8; 3]| f64::from(u16::from(r) + u16::from(g) + u16::from(b)) / 3.0;
                colours.into_rgb8().pixels().map(|pixel| levels.is_free(mean(pixel.0), unknown)).collect()
            }
        };
        for (free, opaque) in free.iter_mut().zip(opaque.into_iter().flatten()) {
            if !opaque {
                *free = unknown == Unknown::Free;
            }
        }
        // Pictures start at the top.
        let rows = free.len().checked_div(cols).unwrap_or(0);
        for row in 0..rows / 2 {
            let (upper, lower) = free.split_at_mut((rows - 1 - row) * cols);
            upper[row * cols..(row + 1) * cols].swap_with_slice(&mut lower[..cols]);
        }
        Ok(Self::new(cols, free))
    }

    pub(super) fn cols(&self) -> usize {
        self.cols
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Whether a cell is free; outside the picture none is.
    pub(super) fn is_free(&self, col: isize, row: isize) -> bool {
        let (Ok(col), Ok(row)) = (usize::try_from(col), usize::try_from(row)) else { return false };
        col < self.cols && self.free.get(row * self.cols + col).copied().unwrap_or(false)
    }
}

/// Which pixels are wholly opaque; `None` for a picture without an alpha channel.
fn opaque(picture: &DynamicImage) -> Option<Vec<bool>> {
    match picture {
        DynamicImage::ImageLumaA8(grey) => Some(grey.pixels().map(|pixel| pixel.0[1] == u8::MAX).collect()),
        DynamicImage::ImageRgba8(colours) => {
            Some(colours.pixels().map(|pixel| pixel.0[3] == u8::MAX).collect())
        }
        DynamicImage::ImageLumaA16(grey) => Some(grey.pixels().map(|pixel| pixel.0[1] == u16::MAX).collect()),
        DynamicImage::ImageRgba16(colours) => {
            Some(colours.pixels().map(|pixel| pixel.0[3] == u16::MAX).collect())
        }
        _ => None,
    }
}
