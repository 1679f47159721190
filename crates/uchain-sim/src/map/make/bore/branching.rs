//! A mine of one drift, from which galleries leave on both sides, and galleries from those.

use core::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::{Bore, Drilled, along, heading};
use crate::{
    map::make::{below, between, farthest, way_lengths_m},
    seed::Stream,
};

/// Length of a straight piece (widths).
const PIECE: f64 = 2.0;
/// Least distance between two galleries but where they meet (widths, from middle to middle).
const APART: f64 = 3.5;
/// Share of the drift in all that is dug.
const DRIFT: f64 = 0.3;
/// Failed attempts to find room for a gallery before the drift is dug on.
const ATTEMPTS: usize = 40;
/// Lengths of galleries (pieces).
const GALLERY: (usize, usize) = (4, 24);
/// Most that a piece turns against the one before (rad).
const TURN_RAD: f64 = 0.08;

/// What is dug so far.
struct Mine {
    width_m: f64,
    places: Vec<DVec2>,
    /// For each place the one before it, and the direction from there (rad).
    before: Vec<(usize, f64)>,
}

pub(super) fn drill(length_m: f64, width_m: f64, stream: &mut Stream) -> Drilled {
    let mut mine = Mine { width_m, places: vec![DVec2::ZERO], before: vec![(0, 0.0)] };
    let piece_m = PIECE * width_m;
    let pieces = (length_m / piece_m).round().max(2.0) as usize;
    let drift = ((DRIFT * pieces as f64) as usize).max(2);
    // The drift runs east; nothing may lie in its way, so galleries keep to what is dug.
    let (mut face, mut wander_rad) = (0, 0.0);
    while mine.places.len() <= drift {
        face = mine.dig_on(face, piece_m, &mut wander_rad, stream);
    }
    while mine.places.len() <= pieces {
        let left = pieces + 1 - mine.places.len();
        if !(0..ATTEMPTS).any(|_| mine.gallery(left, piece_m, face, stream)) {
            face = mine.dig_on(face, piece_m, &mut wander_rad, stream);
        }
    }
    mine.drilled()
}

impl Mine {
    /// Digs the drift on by a piece; it never turns far from east.
    fn dig_on(&mut self, face: usize, piece_m: f64, wander_rad: &mut f64, stream: &mut Stream) -> usize {
        *wander_rad = 0.9 * *wander_rad + between(stream, -TURN_RAD, TURN_RAD);
        self.places.push(self.places[face] + piece_m * heading(*wander_rad));
        self.before.push((face, *wander_rad));
        self.places.len() - 1
    }

    /// Digs a gallery of at most so many pieces somewhere, if there is room for two pieces or for all that are left.
    fn gallery(&mut self, left: usize, piece_m: f64, face: usize, stream: &mut Stream) -> bool {
        let root = below(stream, self.places.len());
        let side = if stream.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let mut angle_rad = self.before[root].1 + side * between(stream, 0.75, 1.0) * FRAC_PI_2;
        let pieces = (GALLERY.0 + below(stream, GALLERY.1 - GALLERY.0)).min(left);
        // None leaves from the mouth, nor from the drift's face: that is where it goes on.
        let mut gallery: Vec<(DVec2, f64)> = Vec::new();
        if root == 0 || root == face {
            return false;
        }
        let mut at = self.places[root];
        for piece in 0..pieces {
            let ahead = at + piece_m * heading(angle_rad);
            if !self.has_room(ahead, root, piece) {
                break;
            }
            gallery.push((ahead, angle_rad));
            at = ahead;
            angle_rad += between(stream, -TURN_RAD, TURN_RAD);
        }
        if gallery.len() < pieces.min(2) {
            return false;
        }
        let mut from = root;
        for (at, angle_rad) in gallery {
            self.places.push(at);
            self.before.push((from, angle_rad));
            from = self.places.len() - 1;
        }
        true
    }

    /// Whether a piece that ends here, the `piece`-th of a gallery from `root`, keeps off all others.
    fn has_room(&self, at: DVec2, root: usize, piece: usize) -> bool {
        let beside =
            |other: usize| other == root || self.before[other].0 == root || self.before[root].0 == other;
        // The first piece ends between the places beside its root.
        let least_m = |other: usize| if piece == 0 && beside(other) { 1.6 } else { APART } * self.width_m;
        self.places.iter().enumerate().all(|(other, place)| place.distance(at) >= least_m(other))
    }

    fn drilled(&self) -> Drilled {
        let mut bores: Vec<Bore> = Vec::new();
        let mut edges = vec![Vec::new(); self.places.len()];
        for (place, &(before, _)) in self.before.iter().enumerate().skip(1) {
            let ends = [self.places[before], self.places[place]];
            let length_m = ends[0].distance(ends[1]);
            bores.extend(along(&ends, self.width_m));
            edges[before].push((place, length_m));
            edges[place].push((before, length_m));
        }
        let (goal, way_m) = farthest(&way_lengths_m(0, &edges), |_| true);
        Drilled { bores, base: self.places[0], goal: self.places[goal], way_m }
    }
}
