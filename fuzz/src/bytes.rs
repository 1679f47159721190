//! Numbers from bytes, extreme ones and such that are none among them.

/// What is left of an input.
#[derive(Debug)]
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

/// Numbers at which laws turn, and such that are none.
const EDGES: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f32::MIN_POSITIVE,
    1e-45,
    -1e-45,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    1e4,
    -1e4,
    2.0,
    60.0,
];

impl Bytes<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The next byte; 0 past the end.
    pub(crate) fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub(crate) fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    pub(crate) fn word(&mut self) -> u16 {
        u16::from_le_bytes([self.byte(), self.byte()])
    }

    /// Any number: an edge, any bits, or, mostly, one between two bounds.
    pub(crate) fn number(&mut self, low: f32, high: f32) -> f32 {
        match self.byte() {
            kind @ 0..=31 => EDGES[usize::from(kind) % EDGES.len()],
            32..=63 => f32::from_bits(u32::from(self.word()) << 16 | u32::from(self.word())),
            _ => low + self.share() * (high - low),
        }
    }

    pub(crate) fn maybe(&mut self, low: f32, high: f32) -> Option<f32> {
        (self.byte() >= 32).then(|| self.number(low, high))
    }

    /// From 0 to 1, both included.
    pub(crate) fn share(&mut self) -> f32 {
        f32::from(self.word()) / 65535.0
    }

    pub(crate) fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[usize::from(self.byte()) % all.len()]
    }
}
