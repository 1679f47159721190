//! From a picture's bytes to free cells and all others.

#[cfg(feature = "maps")]
use super::picture::{Picture, PictureError, Pixel};
#[cfg(feature = "maps")]
use crate::map::Unknown;

/// How a pixel's darkness is read.
#[cfg(feature = "maps")]
#[derive(Debug, Clone, Copy)]
pub(in crate::map) struct Levels {
    /// Whether light is occupied.
    pub(in crate::map) negate: bool,
    /// Darkness above which a cell is rock, 0 to 1.
    pub(in crate::map) occupied: f64,
    /// Darkness below which a cell is free, 0 to 1.
    pub(in crate::map) free: f64,
    /// Whether a cell is unknown if it is not wholly opaque, however dark.
    pub(in crate::map) by_opacity: bool,
}

#[cfg(feature = "maps")]
impl Levels {
    /// Whether a cell is free; `None` where nobody knows.
    fn is_free(self, pixel: Pixel) -> Option<bool> {
        if self.by_opacity && !pixel.opaque {
            return None;
        }
        let darkness = if self.negate { pixel.mean / 255.0 } else { (255.0 - pixel.mean) / 255.0 };
        if darkness > self.occupied { Some(false) } else { (darkness < self.free).then_some(true) }
    }
}

/// Which cells of a picture are free. Row 0 is the lowest.
#[derive(Debug)]
pub(in crate::map) struct Cells {
    cols: usize,
    rows: usize,
    /// Cells of unknown state.
    #[cfg(feature = "maps")]
    unknown: usize,
    free: Vec<bool>,
}

impl Cells {
    /// `free` holds rows of `cols` cells, from the lowest row up.
    pub(in crate::map) fn new(cols: usize, free: Vec<bool>) -> Self {
        Self {
            cols,
            rows: free.len().checked_div(cols).unwrap_or(0),
            #[cfg(feature = "maps")]
            unknown: 0,
            free,
        }
    }

    #[cfg(feature = "maps")]
    pub(in crate::map) fn decode(
        file: &[u8],
        levels: Levels,
        unknown: Unknown,
    ) -> Result<Self, PictureError> {
        let picture = Picture::decode(file)?;
        let cols = picture.cols();
        let mut unknown_cells = 0;
        let is_free = |pixel: Pixel| {
            levels.is_free(pixel).unwrap_or_else(|| {
                unknown_cells += 1;
                unknown == Unknown::Free
            })
        };
        let mut free: Vec<bool> = picture.pixels().map(is_free).collect();
        // Pictures start at the top.
        let rows = free.len().checked_div(cols).unwrap_or(0);
        for row in 0..rows / 2 {
            let (upper, lower) = free.split_at_mut((rows - 1 - row) * cols);
            upper[row * cols..(row + 1) * cols].swap_with_slice(&mut lower[..cols]);
        }
        Ok(Self { unknown: unknown_cells, ..Self::new(cols, free) })
    }

    /// How many cells are of unknown state.
    #[cfg(feature = "maps")]
    pub(in crate::map) fn unknown(&self) -> usize {
        self.unknown
    }

    pub(in crate::map) fn cols(&self) -> usize {
        self.cols
    }

    pub(in crate::map) fn rows(&self) -> usize {
        self.rows
    }

    /// Whether a cell is free; outside the picture none is.
    pub(in crate::map) fn is_free(&self, col: isize, row: isize) -> bool {
        let (Ok(col), Ok(row)) = (usize::try_from(col), usize::try_from(row)) else { return false };
        col < self.cols && self.free.get(row * self.cols + col).copied().unwrap_or(false)
    }
}
