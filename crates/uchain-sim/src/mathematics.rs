//! Whose `exp`, `sin` and `log` this program computes with.
//!
//! What flies calls the crate `libm`. rapier and parry ask std, and std asks whatever the program is linked with: the
//! system's mathematics, whose last bits differ from system to system and from CPU to CPU, or `uchain_libm`'s, which
//! does not. Only the program can choose, with the line `use uchain_libm as _;`; here it can be asked what it chose.

use std::{fmt, hash::Hasher as _, hint::black_box};

use twox_hash::XxHash64;

/// Arguments at which each function is asked.
const ARGUMENTS: u16 = 500;

/// Names the mathematics of this program: 16 hex digits, a hash of what std answers to some thousand questions.
pub fn fingerprint() -> String {
    asked(of_std)
}

/// The name of `uchain_libm`'s mathematics.
pub fn fingerprint_of_libm() -> String {
    asked(of_libm)
}

/// Whether this program links `uchain_libm`: the bits of its runs are then those of every other such program.
///
/// ```
/// use uchain_libm as _; // without this line it would be false
/// assert!(uchain_sim::mathematics::is_libm());
/// ```
pub fn is_libm() -> bool {
    fingerprint() == fingerprint_of_libm()
}

/// Mathematics that is not `uchain_libm`'s: a reason for other bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Foreign {
    /// That of this program.
    Here,
    /// That of the program that recorded.
    There,
    /// That of both.
    Both,
}

impl Foreign {
    /// Looks at this program and at the name in a recording; older recordings have none.
    pub fn of(recorded: Option<&str>) -> Option<Self> {
        let libm = fingerprint_of_libm();
        Self::told_apart(fingerprint() != libm, recorded.is_some_and(|name| name != libm))
    }

    fn told_apart(here: bool, there: bool) -> Option<Self> {
        match (here, there) {
            (true, true) => Some(Self::Both),
            (true, false) => Some(Self::Here),
            (false, true) => Some(Self::There),
            (false, false) => None,
        }
    }
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Here => {
                "foreign mathematics: this program does not link this version's uchain_libm (use uchain_libm as _;), \
                 so its bits may differ from those of the one that recorded"
            }
            Self::There => {
                "foreign mathematics: the program that recorded did not link this version's uchain_libm \
                 (use uchain_libm as _;), so its bits may differ from those of this one"
            }
            Self::Both => {
                "foreign mathematics: neither this program nor the one that recorded links this version's \
                 uchain_libm (use uchain_libm as _;), so their bits may differ"
            }
        })
    }
}

/// Hash of all answers.
fn asked(answers: impl Fn(f32, f64) -> ([f32; 7], [f64; 6])) -> String {
    let mut hash = XxHash64::with_seed(0);
    for i in 1..=ARGUMENTS {
        // From 0.0137 to 6.85; the compiler is not to answer with what its own computer says.
        let x = black_box(f32::from(i) * 0.0137);
        let (singles, doubles) = answers(x, f64::from(x));
        for answer in singles {
            hash.write(&answer.to_bits().to_le_bytes());
        }
        for answer in doubles {
            hash.write(&answer.to_bits().to_le_bytes());
        }
    }
    format!("{:016x}", hash.finish())
}

#[expect(clippy::disallowed_methods, reason = "whose mathematics std calls is the question")]
fn of_std(x: f32, y: f64) -> ([f32; 7], [f64; 6]) {
    let ((sin, cos), (sin_64, cos_64)) = (x.sin_cos(), y.sin_cos());
    (
        [sin, cos, x.exp(), x.log2(), x.atan2(0.7), x.powf(1.7), x.tan()],
        [sin_64, cos_64, y.exp(), y.ln(), y.atan2(0.7), y.powf(1.7)],
    )
}

fn of_libm(x: f32, y: f64) -> ([f32; 7], [f64; 6]) {
    let ((sin, cos), (sin_64, cos_64)) = (libm::sincosf(x), libm::sincos(y));
    (
        [sin, cos, libm::expf(x), libm::log2f(x), libm::atan2f(x, 0.7), libm::powf(x, 1.7), libm::tanf(x)],
        [sin_64, cos_64, libm::exp(y), libm::log(y), libm::atan2(y, 0.7), libm::pow(y, 1.7)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn these_tests_compute_with_the_mathematics_they_link() {
        assert!(is_libm());
        assert_eq!(Foreign::of(Some(&fingerprint())), None);
        assert_eq!(Foreign::of(None), None, "what a recording does not say is not held against it");
    }

    #[test]
    fn one_other_bit_in_one_answer_is_another_mathematics() {
        let other = asked(|x, y| {
            let (mut singles, doubles) = of_libm(x, y);
            if x > 6.8499 {
                singles[3] = singles[3].next_up();
            }
            (singles, doubles)
        });
        assert_ne!(other, fingerprint_of_libm());
        assert_eq!(Foreign::of(Some(&other)), Some(Foreign::There));
        assert_eq!(Foreign::told_apart(true, true), Some(Foreign::Both));
        assert_eq!(Foreign::told_apart(true, false), Some(Foreign::Here));
    }
}
