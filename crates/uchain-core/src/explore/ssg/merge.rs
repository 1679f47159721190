//! Neighbouring frontier sectors are one frontier (SSG-Merged; Kim 2021, §6.1.1).

use super::{Label, Sector};

/// Cyclically adjacent frontier sectors, merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Its first sector, counter-clockwise; 0 if all are frontiers.
    pub first: usize,
    /// How many sectors.
    pub count: usize,
}

impl Run {
    /// Its middle direction `θ_F` in half sectors of a star of so many: 2k is where sector k begins.
    pub(in crate::explore) fn middle_half(self, sectors: usize) -> usize {
        let (n, halves) = (sectors.max(1), 2 * sectors.max(1));
        (2 * (self.first % n) + self.count % halves) % halves
    }
}

/// The sectors on both sides of a direction in half sectors; twice the same for the middle of one.
pub(in crate::explore) fn middle_sectors(half: usize, sectors: usize) -> [usize; 2] {
    let sectors = sectors.max(1);
    if half % 2 == 1 {
        [(half / 2) % sectors; 2]
    } else {
        [(half / 2 + sectors - 1) % sectors, (half / 2) % sectors]
    }
}

/// The merged frontiers of a star, by first sector.
pub fn runs(sectors: &[Sector]) -> impl Iterator<Item = Run> + '_ {
    let n = sectors.len();
    let frontier = move |k: usize| sectors.get(k % n.max(1)).is_some_and(|s| s.label == Label::Frontier);
    let all = n > 0 && (0..n).all(frontier);
    let begins = move |&k: &usize| if all { k == 0 } else { frontier(k) && !frontier(k + n - 1) };
    (0..n)
        .filter(begins)
        .map(move |first| Run { first, count: (0..n).take_while(|i| frontier(first + i)).count() })
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;
    use crate::explore::ssg::tests::scan;

    fn merged(signs: &str) -> Vec<(usize, usize, usize)> {
        let sectors: Vec<Sector> = scan(signs).into_iter().map(|m| Sector::of(m, 1.0)).collect();
        runs(&sectors).map(|run| (run.first, run.count, run.middle_half(sectors.len()))).collect()
    }

    #[test]
    fn the_sectors_of_figure_4_give_four_directions() {
        // The paper's sectors 4-5, 7-10, 13-15 and one more: 80°, 160°, 270° and 350°, in steps of 10°.
        let found = merged("555!!5!!!!55!!!55!");
        assert_eq!(found, [(3, 2, 8), (6, 4, 16), (12, 3, 27), (17, 1, 35)]);
        assert_eq!(middle_sectors(8, 18), [3, 4]);
        assert_eq!(middle_sectors(27, 18), [13, 13]);
    }

    #[test]
    fn a_frontier_across_the_x_axis_is_one() {
        assert_eq!(merged("!!55555555555555!!"), [(16, 4, 0)]);
        assert_eq!(middle_sectors(0, 18), [17, 0]);
        assert_eq!(merged("!5555555555555555!"), [(17, 2, 0)]);
        assert_eq!(merged("!555555555555555!!"), [(16, 3, 35)]);
    }

    #[test]
    fn frontiers_all_around_are_one_and_none_are_none() {
        assert_eq!(merged("!!!!!!!!!!!!!!!!!!"), [(0, 18, 18)]);
        assert_eq!(merged("555555555555555555"), []);
        assert_eq!(runs(&[]).count(), 0);
    }
}
