//! Rooms: a floor divided again and again by walls with a door or two in each.

use super::Lattice;
use crate::{map::make::below, seed::Stream};

/// Least side of a room (spaces).
const LEAST: usize = 3;
/// A side from which on a room is divided in any case (spaces).
const LARGE: usize = 9;

/// A room, in spaces: its first and the one beyond its last, by columns and by rows.
type Room = [[usize; 2]; 2];

pub(super) fn open(mut lattice: Lattice, stream: &mut Stream) -> Lattice {
    let [cols, rows] = lattice.size();
    for row in 1..rows - 1 {
        for col in 1..cols - 1 {
            lattice.open(col, row, true);
        }
    }
    let [cols, rows] = lattice.spaces();
    let mut rooms: Vec<Room> = vec![[[0, cols], [0, rows]]];
    while let Some(room) = rooms.pop() {
        let sides = room.map(|[from, to]| to - from);
        // Across the longer side; a wall and the doors in it lie on different lines, so no later wall blocks a door.
        let axis = usize::from(sides[1] > sides[0]);
        let is_divided = sides[axis] >= LARGE || below(stream, 3) > 0;
        if sides[axis] < 2 * LEAST || !is_divided {
            continue;
        }
        let wall = room[axis][0] + LEAST + below(stream, sides[axis] - 2 * LEAST + 1);
        let [from, to] = room[1 - axis];
        let doors = 1 + usize::from(to - from >= 2 * LEAST && below(stream, 3) == 0);
        let doors: Vec<usize> = (0..doors).map(|_| 2 * (from + below(stream, to - from)) + 1).collect();
        for cell in 2 * from + 1..2 * to {
            let at = if axis == 0 { [2 * wall, cell] } else { [cell, 2 * wall] };
            lattice.open(at[0], at[1], doors.contains(&cell));
        }
        let mut halves = [room; 2];
        (halves[0][axis][1], halves[1][axis][0]) = (wall, wall);
        rooms.extend(halves);
    }
    lattice
}
