//! What of the middle is a way, and what only runs into a corner or a dent of a wall.

use std::{cmp::Reverse, collections::BinaryHeap};

use super::middle::Middle;

/// A place of at least this share of the widest's room is as wide as any.
const WIDE: f64 = 0.98;

/// Takes away, from the loose ends on:
///
/// 1. what runs into a corner: the two nearest walls are seen under less than 120°;
/// 2. the branches that reach no farther beyond the widest circle at their root than they are wide where they leave it,
///    the shortest first;
/// 3. pieces of middle shorter than half the width at their widest place, down to that place.
///
/// What is connected stays connected, and rings stay rings.
pub(super) fn prune(middle: &mut Middle) {
    out_of_corners(middle);
    branches(middle);
    out_of_corners(middle);
    short_pieces(middle);
}

fn places(middle: &Middle) -> std::ops::Range<u32> {
    0..middle.at.len() as u32
}

fn out_of_corners(middle: &mut Middle) {
    let mut open: Vec<u32> = places(middle).filter(|&place| middle.degree(place) == 1).collect();
    while let Some(place) = open.pop() {
        let &[step] = middle.steps_at[place as usize].as_slice() else { continue };
        let root = middle.beyond(step, place);
        let [a, _] = middle.steps[step as usize].ends;
        let [at_a, at_b] = middle.steps[step as usize].between_sides;
        let between_sides = if a == root { at_a } else { at_b };
        if !between_sides {
            middle.remove(place);
            open.push(root);
        }
    }
}

/// A branch: its places from the loose end to its root, and how far it reaches beyond the circle at the root (m).
struct Branch {
    places: Vec<u32>,
    reach_m: f64,
}

/// The branch with this loose end, if it is one to take away.
fn branch(middle: &Middle, tip: u32) -> Option<Branch> {
    let &[step] = middle.steps_at[tip as usize].as_slice() else { return None };
    let (places, _) = middle.run(tip, step);
    let &root = places.last()?;
    if middle.degree(root) < 3 {
        return None;
    }
    let room_m = |place: u32| middle.room_m[place as usize];
    let reach_m = middle.length_of(&places) + room_m(tip) - room_m(root);
    // Where it leaves the circle, and how much room is there.
    let mut along_m = 0.0;
    let mut mouth = tip;
    for pair in places.windows(2).rev() {
        along_m += middle.length_of(pair);
        if along_m >= room_m(root) {
            mouth = pair[0];
            break;
        }
    }
    (reach_m < 2.0 * room_m(mouth)).then_some(Branch { places, reach_m })
}

fn branches(middle: &mut Middle) {
    let mut open = BinaryHeap::new();
    // Lengths that may be below 0 are put in order as whole micrometres.
    let key = |branch: &Branch| (branch.reach_m * 1e6) as i64;
    for tip in places(middle) {
        if let Some(branch) = branch(middle, tip) {
            open.push(Reverse((key(&branch), tip)));
        }
    }
    while let Some(Reverse((reach, tip))) = open.pop() {
        let Some(found) = branch(middle, tip).filter(|branch| key(branch) == reach) else { continue };
        let Some((&root, branch_places)) = found.places.split_last() else { continue };
        for &place in branch_places {
            middle.remove(place);
        }
        if middle.degree(root) != 2 {
            continue;
        }
        // Two branches at the root have become one.
        for step in middle.steps_at[root as usize].clone() {
            let tip = middle.run(root, step).0.last().copied().unwrap_or(root);
            if let Some(branch) = branch(middle, tip) {
                open.push(Reverse((key(&branch), tip)));
            }
        }
    }
}

fn short_pieces(middle: &mut Middle) {
    for tip in places(middle) {
        let &[step] = middle.steps_at[tip as usize].as_slice() else { continue };
        let (run, _) = middle.run(tip, step);
        let other = run.last().copied().unwrap_or(tip);
        let room_m = |&place: &u32| middle.room_m[place as usize];
        let widest_m = run.iter().map(room_m).fold(0.0, f64::max);
        let length_m = middle.length_of(&run);
        if middle.degree(other) != 1 || length_m >= widest_m {
            continue;
        }
        // Of many places as wide as any, the one nearest to the middle of the piece.
        let off_m = |at: usize| (middle.length_of(&run[..=at]) - length_m / 2.0).abs();
        let wide = (0..run.len()).filter(|&at| room_m(&run[at]) >= WIDE * widest_m);
        let Some(kept) = wide.min_by(|&p, &q| off_m(p).total_cmp(&off_m(q))) else { continue };
        let kept = run[kept];
        run.iter().take_while(|&&place| place != kept).for_each(|&place| middle.remove(place));
        run.iter().rev().take_while(|&&place| place != kept).for_each(|&place| middle.remove(place));
    }
}
