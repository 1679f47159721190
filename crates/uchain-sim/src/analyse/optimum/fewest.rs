//! The fewest links to every place of a tree of ways: what "relays everywhere" asks, where a table for each branch
//! would be too much.

use glam::Vec2;

use super::near::Near;

/// Fewest links from the root to every sample of a tree of ways, each link within `s_min_db`, relays on samples of the
/// way there: 0 at the root, `None` where no number is enough.
///
/// Sample i lies at `at[i]` (m), and the way there from the root comes from sample `parent[i]`, which is less than i;
/// a sample without parent is a root. Beyond `reach_m` in a straight line (m) no link is asked for: it must be no less
/// than that of any link that can be had; infinite where nobody knows. `loss_db` of two samples, that nearer to the
/// root first (dB); what is not a number is no link.
///
/// Exact on the samples: every pair of a sample and one on the way to it that is within reach counts, also where the
/// way turns back on itself. As relays stand on samples only, links are up to a sample's spacing shorter than they
/// could be: samples should be a small share of the reach apart.
pub fn fewest_links(
    at: &[Vec2],
    parent: &[Option<u32>],
    reach_m: f64,
    s_min_db: f64,
    loss_db: impl Fn(usize, usize) -> f64,
) -> Vec<Option<u32>> {
    let samples = at.len().min(parent.len());
    let parent_of = |i: usize| parent.get(i).copied().flatten().map(|parent| parent as usize);
    let mut links = vec![None; samples];
    // The sample of the last relay on the way to each: that of the sample before is mostly right as well.
    let mut relay: Vec<usize> = (0..samples).collect();
    let mut near = Near::new(reach_m);
    let mut found = Vec::new();
    let children = Children::new(samples, parent_of);
    let mut way: Vec<usize> = Vec::new();
    let mut open: Vec<usize> = (0..samples).rev().filter(|&i| parent_of(i).is_none()).collect();
    while let Some(here) = open.pop() {
        // Depth first: `way` and `near` hold the samples from the root to here, and no others.
        let before = parent_of(here);
        while way.last().copied() != before {
            let Some(left) = way.pop() else { break };
            near.leave(at[left]);
        }
        if let Some(before) = before {
            let joins = |from: usize| {
                f64::from(at[from].distance(at[here])) <= reach_m && loss_db(from, here) <= s_min_db
            };
            let mut best = None;
            for from in [relay[before], before] {
                let with = links[from].map(|links| (links + 1, from));
                best = best.or_else(|| with.filter(|_| joins(from)));
            }
            near.around(at[here], &mut found);
            found.retain(|&from| {
                links[from as usize].is_some_and(|links| best.is_none_or(|(least, _)| links + 1 < least))
            });
            found.sort_unstable_by_key(|&from| (links[from as usize], std::cmp::Reverse(from)));
            let better = found.iter().map(|&from| from as usize).find(|&from| joins(from));
            let better = better.and_then(|from| links[from].map(|links| (links + 1, from)));
            if let Some((least, from)) = better.or(best) {
                (links[here], relay[here]) = (Some(least), from);
            }
        } else {
            links[here] = Some(0);
        }
        way.push(here);
        near.enter(at[here], here as u32);
        open.extend(children.of(here));
    }
    links
}

/// The children of every sample, in one list.
struct Children {
    starts: Vec<usize>,
    all: Vec<usize>,
}

impl Children {
    fn new(samples: usize, parent_of: impl Fn(usize) -> Option<usize>) -> Self {
        // What does not come after its parent hangs on nothing: it is never reached.
        let parent_of = |i: usize| parent_of(i).filter(|&parent| parent < i);
        let mut starts = vec![0; samples + 1];
        (0..samples).filter_map(parent_of).for_each(|parent| starts[parent + 1] += 1);
        for i in 0..samples {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut all = vec![0; starts.last().copied().unwrap_or_default()];
        for i in 0..samples {
            if let Some(parent) = parent_of(i) {
                all[next[parent]] = i;
                next[parent] += 1;
            }
        }
        Self { starts, all }
    }

    fn of(&self, sample: usize) -> impl Iterator<Item = usize> {
        self.all[self.starts[sample]..self.starts[sample + 1]].iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::{Seed, Source, Stream};

    /// A random tree that turns back on itself: each sample a step from one before it.
    fn tree(random: &mut Stream, samples: usize) -> (Vec<Vec2>, Vec<Option<u32>>) {
        let mut between = |low: f32, high: f32| low + (high - low) * random.uniform();
        let (mut at, mut parent) = (vec![Vec2::ZERO], vec![None]);
        let mut heading_rad = 0.0;
        for i in 1..samples {
            let branches = between(0.0, 1.0) < 0.1;
            let before = if branches { between(0.0, i as f32) as usize } else { i - 1 };
            heading_rad += between(-0.6, 0.6);
            at.push(at[before] + 0.5 * Vec2::new(libm::cosf(heading_rad), libm::sinf(heading_rad)));
            parent.push(Some(before as u32));
        }
        (at, parent)
    }

    /// Every pair of a sample and one on the way to it.
    fn by_brute_force(parent: &[Option<u32>], joins: impl Fn(usize, usize) -> bool) -> Vec<Option<u32>> {
        let mut links: Vec<Option<u32>> = vec![Some(0)];
        for i in 1..parent.len() {
            let way = std::iter::successors(parent[i], |&j| parent[j as usize]).map(|j| j as usize);
            let with = way.filter(|&j| joins(j, i)).filter_map(|j| links[j]).min();
            links.push(with.map(|with| with + 1));
        }
        links
    }

    #[test]
    fn fewest_links_are_those_of_every_pair_tried_on_100_random_trees() {
        let mut random = Seed(5).stream(0, Source::Start);
        let (mut none, mut most, mut leaps) = (0, 0, 0);
        for _ in 0..100 {
            let (at, parent) = tree(&mut random, 300);
            let reach_m = 1.0 + 2.0 * random.uniform();
            // Rock: bands of the plane that dampen, here and there more than any link can bear.
            let bands: Vec<f32> = (0..8).map(|_| 12.0 * random.uniform() - 6.0).collect();
            let cut = |p: Vec2, q: Vec2| bands.iter().filter(|&&x| (p.x > x) != (q.x > x)).count() as f32;
            let loss_db = |j: usize, i: usize| f64::from(at[i].distance(at[j]) + 0.4 * cut(at[i], at[j]));
            let s_min_db = f64::from(reach_m);
            let found = fewest_links(&at, &parent, s_min_db, s_min_db, loss_db);
            assert_eq!(found, by_brute_force(&parent, |j, i| loss_db(j, i) <= s_min_db));
            assert_eq!(found, fewest_links(&at, &parent, f64::INFINITY, s_min_db, loss_db));
            // Not to see across is to need more.
            let along = |j: usize, i: usize| if i - j > 12 { f64::NAN } else { loss_db(j, i) };
            leaps += usize::from(found != fewest_links(&at, &parent, s_min_db, s_min_db, along));
            none += found.iter().filter(|links| links.is_none()).count();
            most = most.max(found.iter().flatten().copied().max().unwrap_or_default());
        }
        assert!(most > 30 && leaps > 50, "{none} {most} {leaps}");
    }

    #[test]
    fn a_gap_that_no_link_bridges_is_out_of_reach_and_so_is_all_behind_it() {
        let at: Vec<Vec2> = [0.0, 1.0, 2.0, 5.0, 6.0].map(|x| Vec2::new(x, 0.0)).to_vec();
        let parent = [None, Some(0), Some(1), Some(2), Some(3)];
        let loss_db = |j: usize, i: usize| f64::from(at[i].distance(at[j]));
        let links = |s_min_db: f64| fewest_links(&at, &parent, s_min_db, s_min_db, loss_db);
        assert_eq!(links(2.0), [Some(0), Some(1), Some(1), None, None]);
        assert_eq!(links(3.0), [Some(0), Some(1), Some(1), Some(2), Some(3)]);
        assert_eq!(fewest_links(&at, &parent, 9.0, 9.0, |_, _| f64::NAN)[1..], [None; 4]);
        assert!(fewest_links(&[], &[], 9.0, 9.0, loss_db).is_empty());
    }

    #[test]
    fn ten_thousand_samples_ask_for_a_bounded_number_of_pairs() {
        // A serpentine of 4 km: legs of 100 m, 6 m apart, links of 5 m: none across.
        let place = |i: usize| {
            let (leg, along_m) = (i / 530, (i % 530) as f32 * 0.2);
            let x = along_m.min(100.0);
            Vec2::new(if leg % 2 == 0 { x } else { 100.0 - x }, 6.0 * leg as f32 + along_m - x)
        };
        let at: Vec<Vec2> = (0..20_000).map(place).collect();
        let parent: Vec<Option<u32>> = (0..20_000_u32).map(|i| i.checked_sub(1)).collect();
        let asked = std::cell::Cell::new(0);
        let loss_db = |j: usize, i: usize| {
            asked.set(asked.get() + 1);
            f64::from(at[i].distance(at[j]))
        };
        let links = fewest_links(&at, &parent, 5.0, 5.0, loss_db);
        // One link each 5 m, but for the corners they cut.
        let last = links.last().copied().flatten();
        assert!(last.is_some_and(|links| (760..=800).contains(&links)), "{last:?}");
        assert!(asked.get() < 100_000, "{}", asked.get());
    }
}
