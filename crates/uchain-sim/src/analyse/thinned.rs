//! A long series in a bounded number of samples.

/// Keeps every first, second, fourth … of what comes, so that it is never too much.
#[derive(Debug, Clone)]
pub struct Thinned<T> {
    wanted: usize,
    kept: Vec<T>,
    last: Option<T>,
    stride: u64,
    seen: u64,
}

impl<T: Copy + PartialEq> Thinned<T> {
    /// Keeps about so many, at most twice as many.
    pub fn new(wanted: usize) -> Self {
        Self { wanted: wanted.max(1), kept: Vec::new(), last: None, stride: 1, seen: 0 }
    }

    /// The next one.
    pub fn push(&mut self, next: T) {
        self.last = Some(next);
        if self.seen.is_multiple_of(self.stride) {
            self.kept.push(next);
        }
        self.seen += 1;
        if self.kept.len() >= 2 * self.wanted {
            let mut index = 0_u32;
            self.kept.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
    }

    /// Those that were kept, in order, and the last one.
    pub fn into_all(mut self) -> Vec<T> {
        let last = self.last.filter(|last| self.kept.last() != Some(last));
        self.kept.extend(last);
        self.kept
    }
}
