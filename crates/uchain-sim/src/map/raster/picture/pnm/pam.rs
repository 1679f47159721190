//! The head of a PAM: lines of a word and its value, up to `ENDHDR`.

use super::{Head, PictureError, Rest};
use crate::map::raster::picture::Layout;

/// What the lines said so far.
#[derive(Default)]
struct Lines {
    cols: Option<u32>,
    rows: Option<u32>,
    depth: Option<u32>,
    white: Option<u32>,
    /// Several lines of it are one name with blanks.
    tuple_type: Option<String>,
}

pub(super) fn head(rest: &mut Rest) -> Result<Head, PictureError> {
    if rest.byte() != Some(b'\n') {
        return Err(PictureError::Damaged);
    }
    let mut lines = Lines::default();
    while lines.read(rest.line()?)? {}
    lines.head()
}

impl Rest<'_> {
    /// Up to the end of the line, or of the file, which is an error where nothing is left.
    fn line(&mut self) -> Result<&str, PictureError> {
        let end = self.0.iter().position(|&byte| byte == b'\n').unwrap_or(self.0.len());
        let line = std::str::from_utf8(self.take(end)?).map_err(|_| PictureError::Damaged)?;
        self.byte();
        if line.is_empty() { Err(PictureError::Damaged) } else { Ok(line) }
    }
}

impl Lines {
    /// Whether another line follows.
    fn read(&mut self, line: &str) -> Result<bool, PictureError> {
        if line.starts_with('#') {
            return Ok(true);
        }
        if !line.is_ascii() {
            return Err(PictureError::Damaged);
        }
        let (word, value) = line.split_at(line.find(char::is_whitespace).unwrap_or(line.len()));
        let value = value.trim();
        let number = match word {
            "ENDHDR" => return Ok(false),
            "TUPLTYPE" => {
                self.tuple_type = Some(match self.tuple_type.take() {
                    Some(before) => format!("{before} {value}"),
                    None => value.to_owned(),
                });
                return Ok(true);
            }
            "WIDTH" => &mut self.cols,
            "HEIGHT" => &mut self.rows,
            "DEPTH" => &mut self.depth,
            "MAXVAL" => &mut self.white,
            _ => return Err(PictureError::Damaged),
        };
        let value = value.parse().map_err(|_| PictureError::Damaged)?;
        if number.replace(value).is_some() { Err(PictureError::Damaged) } else { Ok(true) }
    }

    fn head(self) -> Result<Head, PictureError> {
        let (Some(cols), Some(rows), Some(depth), Some(white)) =
            (self.cols, self.rows, self.depth, self.white)
        else {
            return Err(PictureError::Damaged);
        };
        let strict = self.tuple_type.as_deref().is_some_and(|name| name.starts_with("BLACKANDWHITE"));
        let layout = layout(self.tuple_type.as_deref(), depth, white)?;
        Ok(Head { cols, rows, white, strict, layout })
    }
}

/// What the samples mean: by their name or, without one, by how many there are; those are a byte each.
fn layout(tuple_type: Option<&str>, depth: u32, white: u32) -> Result<Layout, PictureError> {
    if white == 0 {
        return Err(PictureError::Damaged);
    }
    let (colours, alpha, depths, most_white) = match (tuple_type, depth) {
        (None, 1) => return Ok(Layout::new(1, false, 1)),
        (None, 2) => return Ok(Layout::new(1, true, 1)),
        (None, 3) => return Ok(Layout::new(3, false, 1)),
        (None, 4) => return Ok(Layout::new(3, true, 1)),
        (None, _) => return Err(PictureError::Damaged),
        // Nobody writes it; other readers take it for one sample of two bytes.
        (Some("GRAYSCALE"), 0) if white <= 0xffff => return Ok(Layout::new(1, false, 2)),
        (Some("BLACKANDWHITE"), _) => (1, false, 1, 1),
        (Some("BLACKANDWHITE_ALPHA"), _) => (1, true, 2, 1),
        (Some("GRAYSCALE"), _) => (1, false, 1, 0xffff),
        (Some("GRAYSCALE_ALPHA"), _) => (1, true, 2, 0xffff),
        (Some("RGB"), _) => (3, false, 3, 0xffff),
        (Some("RGB_ALPHA"), _) => (3, true, 4, 0xffff),
        (Some(_), _) => return Err(PictureError::Unknown),
    };
    if depth != depths || white > most_white {
        return Err(PictureError::Damaged);
    }
    Ok(Layout::new(colours, alpha, if white > 0xff { 2 } else { 1 }))
}
