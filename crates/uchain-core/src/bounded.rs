//! A value held between two bounds, whatever the three are.

/// `value` held between `low` and `high`: the bits of [`Ord::clamp`] and `f32::clamp` wherever those return, and never
/// a panic.
///
/// Bounds that are computed can cross or be no number, and `clamp` panics on both. Here `high` wins where they cross,
/// a bound that is NaN bounds nothing, and a value that is NaN stays NaN: nothing that is no number becomes a number
/// that looks right. It is written in comparisons, because `max` and `min` make a bound of NaN and leave open which
/// of the two zeros they return.
///
/// ```
/// use uchain_core::bounded;
///
/// assert_eq!(bounded(7.0, 0.0, 5.0), 5.0);
/// assert_eq!(bounded(7.0, 5.0, 0.0), 0.0);
/// assert_eq!(bounded(7.0, 0.0, f64::NAN), 7.0);
/// assert!(bounded(f32::NAN, 0.0, 5.0).is_nan());
/// assert_eq!(bounded(7, 1, 5), 5);
/// ```
#[inline]
pub fn bounded<T: PartialOrd>(value: T, low: T, high: T) -> T {
    let value = if value < low { low } else { value };
    if value > high { high } else { value }
}

/// The smaller of two numbers, the first one where they are equal, and the one that is a number where the other is none.
/// `f32::min` leaves open which of two zeros it returns, and is a call of a dozen instructions on a Cortex-M4F.
#[inline]
pub(crate) fn smaller(a: f32, b: f32) -> f32 {
    if a <= b || b.is_nan() { a } else { b }
}

/// The larger of two numbers, in the same way.
#[inline]
pub(crate) fn larger(a: f32, b: f32) -> f32 {
    if a >= b || b.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{bounded, larger, smaller};

    /// Numbers at which comparisons and roundings turn.
    const EDGES: [f32; 12] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
        1e-45,
        f32::EPSILON,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
    ];

    fn edge_or_any() -> impl Strategy<Value = f32> {
        prop_oneof![prop::sample::select(&EDGES[..]), prop::num::f32::ANY]
    }

    #[expect(clippy::disallowed_methods, reason = "what `bounded` is measured by")]
    fn clamp(value: f32, low: f32, high: f32) -> f32 {
        value.clamp(low, high)
    }

    proptest! {
        #[test]
        fn between_ordered_bounds_it_has_the_bits_of_clamp(
            value in edge_or_any(), low in edge_or_any(), high in edge_or_any(),
        ) {
            prop_assume!(low <= high);
            prop_assert_eq!(bounded(value, low, high).to_bits(), clamp(value, low, high).to_bits());
        }

        #[test]
        fn the_smaller_and_the_larger_are_those_of_the_language(a in edge_or_any(), b in edge_or_any()) {
            let alike = |ours: f32, theirs: f32| ours == theirs || (ours.is_nan() && theirs.is_nan());
            prop_assert!(alike(smaller(a, b), a.min(b)), "{} {}", smaller(a, b), a.min(b));
            prop_assert!(alike(larger(a, b), a.max(b)), "{} {}", larger(a, b), a.max(b));
        }

        #[test]
        fn whatever_the_bounds_a_number_is_no_more_than_the_upper_one_and_no_number_is_made_up(
            value in edge_or_any(), low in edge_or_any(), high in edge_or_any(),
        ) {
            let held = bounded(value, low, high);
            prop_assert!([value, low, high].iter().any(|one| one.to_bits() == held.to_bits()));
            prop_assert_eq!(held.is_nan(), value.is_nan());
            if !held.is_nan() && !high.is_nan() {
                prop_assert!(held <= high);
            }
        }
    }

    #[test]
    fn a_zero_keeps_its_sign_and_crossed_bounds_give_the_upper_one() {
        assert_eq!(bounded(-0.0_f32, 0.0, 1.0).to_bits(), (-0.0_f32).to_bits());
        assert_eq!(bounded(0.0_f32, -1.0, -0.0).to_bits(), 0.0_f32.to_bits());
        for value in [-1.0, 1.5, 3.0] {
            assert_eq!(bounded(value, 2.0, 1.0), 1.0);
        }
        for (a, b) in [(0.0_f32, -0.0), (-0.0, 0.0)] {
            assert_eq!((smaller(a, b).to_bits(), larger(a, b).to_bits()), (a.to_bits(), a.to_bits()));
        }
        assert_eq!((bounded(3_u32, 4, 5), bounded(6_u32, 4, 5), bounded(6_u32, 5, 4)), (4, 5, 4));
    }
}
