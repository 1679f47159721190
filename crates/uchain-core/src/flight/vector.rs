//! Arithmetic of vectors, each sum from its first part to its last: what one target rounds, all do.

#[inline]
pub(super) fn add<const N: usize>(a: [f32; N], b: [f32; N]) -> [f32; N] {
    core::array::from_fn(|i| a[i] + b[i])
}

#[inline]
pub(super) fn less<const N: usize>(a: [f32; N], b: [f32; N]) -> [f32; N] {
    core::array::from_fn(|i| a[i] - b[i])
}

#[inline]
pub(super) fn scaled<const N: usize>(a: [f32; N], by: f32) -> [f32; N] {
    a.map(|part| part * by)
}

#[inline]
pub(super) fn dot<const N: usize>(a: [f32; N], b: [f32; N]) -> f32 {
    let mut parts = a.iter().zip(&b).map(|(a, b)| a * b);
    let first = parts.next().unwrap_or(0.0);
    parts.fold(first, |sum, part| sum + part)
}

#[inline]
pub(super) fn cross([ax, ay, az]: [f32; 3], [bx, by, bz]: [f32; 3]) -> [f32; 3] {
    [ay * bz - by * az, az * bx - bz * ax, ax * by - bx * ay]
}

/// The same direction with length 1.
#[inline]
pub(super) fn normalized<const N: usize>(a: [f32; N]) -> [f32; N] {
    scaled(a, 1.0 / libm::sqrtf(dot(a, a)))
}

/// The same direction, no longer than `most`.
#[inline]
pub(super) fn no_longer<const N: usize>(a: [f32; N], most: f32) -> [f32; N] {
    let length2 = dot(a, a);
    if length2 > most * most {
        let length = libm::sqrtf(length2);
        a.map(|part| most * (part / length))
    } else {
        a
    }
}
