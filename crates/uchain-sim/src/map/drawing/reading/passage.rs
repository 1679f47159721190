//! A passage drawn as a line: free space as wide as the line.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::map::drawing::Shape;

/// Corners of the round places where two pieces of a passage meet.
const ROUND: u32 = 16;

/// The pieces of a line as free space: one straight piece each, and a round place at each bend. They overlap: their union
/// is the passage. A closed line goes round.
pub(crate) fn passage(line: &[[f64; 2]], closed: bool, width_m: f64) -> Vec<Shape> {
    let half_m = width_m / 2.0;
    let points: Vec<DVec2> = line.iter().map(|&at| at.into()).collect();
    let last = points.len().saturating_sub(usize::from(!closed));
    let mut shapes = Vec::new();
    for (index, &a) in points.iter().enumerate().take(last) {
        let b = points[(index + 1) % points.len()];
        let Some(along) = (b - a).try_normalize() else { continue };
        let side = along.perp() * half_m;
        shapes.push(Shape {
            outline: [a - side, b - side, b + side, a + side].map(Into::into).into(),
            holes: Vec::new(),
        });
        if closed || index > 0 {
            shapes.push(round(a, half_m));
        }
    }
    shapes
}

/// A circle as a polygon around it, so that it is nowhere narrower than the passage.
fn round(at: DVec2, radius_m: f64) -> Shape {
    let angle = |corner: u32| TAU * f64::from(corner) / f64::from(ROUND);
    let radius_m = radius_m / libm::cos(angle(1) / 2.0);
    let corner =
        |corner| (at + radius_m * DVec2::new(libm::cos(angle(corner)), libm::sin(angle(corner)))).into();
    Shape { outline: (0..ROUND).map(corner).collect(), holes: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bent_line_is_two_straight_pieces_and_a_round_place_between_them() {
        let shapes = passage(&[[0.0, 0.0], [10.0, 0.0], [10.0, 5.0]], false, 2.0);
        assert_eq!(shapes.len(), 3);
        assert_eq!(shapes[0].outline, [[0.0, -1.0], [10.0, -1.0], [10.0, 1.0], [0.0, 1.0]]);
        assert_eq!((shapes[1].outline.len(), shapes[2].outline.len()), (4, 16));
        assert_eq!(passage(&[[0.0, 0.0], [10.0, 0.0], [10.0, 5.0]], true, 2.0).len(), 6, "the control");
        assert!(
            passage(&[[1.0, 1.0], [1.0, 1.0]], false, 2.0).is_empty() && passage(&[], true, 1.0).is_empty()
        );
    }
}
