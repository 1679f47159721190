//! One entity: its kind, and its pairs.

use glam::{DAffine2, DVec2};

/// Most pairs of one entity: two for each of the most corners, and some more.
const MOST_PAIRS: usize = 2_200_000;

/// What begins with a pair of code 0 and ends before the next, as text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entity<'a> {
    pub(super) kind: &'a str,
    /// The lines of its pairs.
    pub(super) body: &'a str,
    /// Where it begins, counted from 1.
    pub(super) line: usize,
}

/// An entity with its pairs taken apart.
#[derive(Debug, Clone)]
pub(super) struct Opened<'a> {
    pub(super) kind: &'a str,
    pub(super) pairs: Vec<(i32, &'a str)>,
}

impl<'a> Entity<'a> {
    /// Takes it apart, or says that there is too much of it.
    pub(super) fn open(&self) -> Result<Opened<'a>, String> {
        // Counted first, for what grows takes twice the memory.
        let count = self.body.bytes().filter(|&byte| byte == b'\n').count() / 2 + 1;
        if count > MOST_PAIRS {
            return Err(format!("more than {MOST_PAIRS} pairs; expected fewer: cut it into several"));
        }
        let mut pairs = Vec::with_capacity(count);
        let mut lines = self.body.lines();
        while let Some(code) = lines.next().and_then(|code| code.trim().parse().ok()) {
            pairs.push((code, lines.next().unwrap_or_default().trim()));
        }
        Ok(Opened { kind: self.kind, pairs })
    }
}

impl<'a> Opened<'a> {
    /// The first value of a code.
    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.pairs.iter().find(|&&(of, _)| of == code).map(|&(_, value)| value)
    }

    pub(super) fn number(&self, code: i32) -> Option<f64> {
        self.text(code)?.parse().ok()
    }

    /// All values of a code that are numbers.
    pub(super) fn numbers(&self, code: i32) -> Vec<f64> {
        let values = self.pairs.iter().filter(|&&(of, _)| of == code);
        values.filter_map(|(_, text)| text.parse().ok()).collect()
    }

    /// A value of several bits.
    pub(super) fn flags(&self, code: i32) -> i64 {
        self.text(code).and_then(|text| text.parse().ok()).unwrap_or(0)
    }

    /// A place: its y has the code of its x and 10.
    pub(super) fn place(&self, code: i32) -> Option<DVec2> {
        Some(DVec2::new(self.number(code)?, self.number(code + 10)?))
    }

    pub(super) fn layer(&self) -> &'a str {
        self.text(8).unwrap_or("0")
    }

    /// The entity's own frame: the other way round along x where it is seen from below.
    pub(super) fn seen(&self) -> DAffine2 {
        let from_below = self.number(230).is_some_and(|z| z < 0.0);
        DAffine2::from_scale(DVec2::new(if from_below { -1.0 } else { 1.0 }, 1.0))
    }

    /// All places of a code, each with the number of another code that follows it, 0 without.
    pub(super) fn places(&self, code: i32, with: i32) -> Vec<(DVec2, f64)> {
        let count = self.pairs.iter().filter(|&&(of, _)| of == code).count();
        let mut places: Vec<(DVec2, f64)> = Vec::with_capacity(count);
        for &(of, value) in &self.pairs {
            let number = || value.parse().unwrap_or(f64::NAN);
            if of == code {
                places.push((DVec2::new(number(), 0.0), 0.0));
            } else if let Some((place, extra)) = places.last_mut() {
                if of == code + 10 {
                    place.y = number();
                } else if of == with {
                    *extra = number();
                }
            }
        }
        places
    }
}
