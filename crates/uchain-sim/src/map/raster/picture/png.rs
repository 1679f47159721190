//! PNG, whatever its colours and depth (W3C Recommendation, third edition), by the crate `png`.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};

use super::{Layout, Picture, PictureError, check_size};

/// Most bytes that decoding may take beside the picture itself.
const MOST_BYTES: usize = 512 << 20;

impl From<DecodingError> for PictureError {
    fn from(error: DecodingError) -> Self {
        match error {
            DecodingError::LimitsExceeded => Self::TooLarge,
            _ => Self::Damaged,
        }
    }
}

pub(super) fn decode(file: &[u8]) -> Result<Picture, PictureError> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(file), Limits { bytes: MOST_BYTES });
    let (cols, rows) = decoder.read_header_info()?.size();
    // Palettes become colours, samples of less than a byte become bytes.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info()?;
    check_size(cols, rows)?;
    let (color, depth) = reader.output_color_type();
    let sample_bytes = match depth {
        BitDepth::Sixteen => 2,
        _ => 1,
    };
    let layout = match color {
        ColorType::Grayscale => Layout::new(1, false, sample_bytes),
        ColorType::GrayscaleAlpha => Layout::new(1, true, sample_bytes),
        ColorType::Rgb => Layout::new(3, false, sample_bytes),
        ColorType::Rgba => Layout::new(3, true, sample_bytes),
        ColorType::Indexed => return Err(PictureError::Unknown),
    };
    let mut samples = vec![0; reader.output_buffer_size().ok_or(PictureError::TooLarge)?];
    reader.next_frame(&mut samples)?;
    Ok(Picture { cols: cols as usize, layout, samples })
}
