//! From the base on, link after link: which places can be had with n links of one level?

use super::reach_m;
use crate::analyse::optimum::{Losses, near::Near};

/// Most samples of a tunnel.
const MOST_SAMPLES: f64 = 200_000.0;
/// How closely the end of what can be had is found (m).
const PLACE_M: f64 = 1e-6;
/// A link that gets no farther than this share of the samples' distance gets nowhere.
const CREEP: f64 = 1e-3;
/// How finely the place a relay sees farthest from is looked for between samples, in halvings of their distance.
const FINER: usize = 8;
/// Nobody has come here yet.
const NEVER: u32 = u32::MAX;

/// What n links of one level reach, n by n, as far as anybody has asked.
///
/// Relays stand on samples, at the ends of every stretch that n links reach (the deepest to 1 µm), and where a
/// relay sees farthest from: so no length is lost from link to link. A good place narrower than the distance of the
/// samples may be overlooked.
#[derive(Debug)]
pub(super) struct Sweep<P> {
    depth_m: f64,
    level_db: f64,
    step_m: f64,
    samples: Vec<P>,
    /// Fewest links to each sample.
    links: Vec<u32>,
    near_samples: Near,
    points: Vec<Point<P>>,
    near_points: Near,
    /// Where the points of the last number of links start, that number, and the deepest of all points (m).
    last: usize,
    waves: u32,
    front_m: f64,
    /// Samples that have been reached.
    reached: usize,
    is_done: bool,
}

/// A place that a relay may take.
#[derive(Debug, Clone)]
struct Point<P> {
    at: P,
    depth_m: f64,
    /// Fewest links from the base, and the point of the relay before; its own for the base.
    links: u32,
    behind: u32,
}

impl<P: Clone> Sweep<P> {
    /// A tunnel of a depth (m) on so many samples within the reach of a link of this level (dB). `None` where no
    /// link is that good.
    pub(super) fn new(
        losses: &impl Losses<Place = P>,
        depth_m: f64,
        share: f64,
        level_db: f64,
    ) -> Option<Self> {
        let reach_m = reach_m(losses, depth_m, level_db)?;
        let steps = (depth_m * share / reach_m).ceil();
        let steps = if steps >= 1.0 { steps.min(MOST_SAMPLES) } else { 1.0 };
        let step_m = depth_m / steps;
        let samples: Vec<P> = (0..=steps as usize).map(|i| losses.place(i as f64 * step_m)).collect();
        let mut near_samples = Near::new(reach_m);
        for (i, sample) in samples.iter().enumerate() {
            near_samples.enter(losses.spot(sample), i as u32);
        }
        let mut sweep = Self {
            depth_m,
            level_db,
            step_m,
            links: vec![NEVER; samples.len()],
            samples,
            near_samples,
            points: Vec::new(),
            near_points: Near::new(reach_m),
            last: 0,
            waves: 0,
            front_m: 0.0,
            reached: 0,
            is_done: false,
        };
        sweep.links[0] = 0;
        sweep.enter(losses, Point { at: losses.place(0.0), depth_m: 0.0, links: 0, behind: 0 });
        Some(sweep)
    }

    /// Whether it is one over this depth (m) at this level (dB), to the last bit.
    pub(super) fn is_of(&self, depth_m: f64, level_db: f64) -> bool {
        [self.depth_m, self.level_db].map(f64::to_bits) == [depth_m, level_db].map(f64::to_bits)
    }

    pub(super) fn samples(&self) -> usize {
        self.samples.len()
    }

    /// Fewest links to a head at a depth (m).
    pub(super) fn links_to(&mut self, losses: &impl Losses<Place = P>, head_m: f64) -> Option<usize> {
        self.last_relay(losses, head_m).map(|relay| self.points[relay].links as usize + 1)
    }

    /// The chain of fewest links to a head at a depth (m), base first.
    pub(super) fn chain(&mut self, losses: &impl Losses<Place = P>, head_m: f64) -> Option<Vec<f64>> {
        let mut relay = self.last_relay(losses, head_m)?;
        let mut depths_m = vec![head_m, self.points[relay].depth_m];
        while self.points[relay].links > 0 {
            relay = self.points[relay].behind as usize;
            depths_m.push(self.points[relay].depth_m);
        }
        depths_m.reverse();
        Some(depths_m)
    }

    /// The point of fewest links, and of those the deepest, that a head at a depth (m) has a link to.
    fn last_relay(&mut self, losses: &impl Losses<Place = P>, head_m: f64) -> Option<usize> {
        let head = losses.place(head_m);
        let beyond = ((head_m / self.step_m).ceil() as usize).min(self.links.len() - 1);
        while !self.is_done && self.links[beyond] == NEVER {
            self.wave(losses);
        }
        let mut near = Vec::new();
        loop {
            self.near_points.around(losses.spot(&head), &mut near);
            let point = |which: u32| &self.points[which as usize];
            near.retain(|&which| point(which).depth_m <= head_m);
            near.sort_unstable_by(|&a, &b| {
                let (a, b) = (point(a), point(b));
                a.links.cmp(&b.links).then(b.depth_m.total_cmp(&a.depth_m))
            });
            let found = near.iter().find(|&&which| losses.holds(&point(which).at, &head, self.level_db));
            match found {
                Some(&which) => return Some(which as usize),
                None if self.is_done => return None,
                None => self.wave(losses),
            }
        }
    }

    fn enter(&mut self, losses: &impl Losses<Place = P>, point: Point<P>) -> usize {
        let which = self.points.len();
        self.near_points.enter(losses.spot(&point.at), which as u32);
        self.front_m = self.front_m.max(point.depth_m);
        self.points.push(point);
        which
    }

    /// A sample that is reached by a link from a point.
    fn reach(&mut self, losses: &impl Losses<Place = P>, sample: usize, from: usize) {
        let links = self.points[from].links + 1;
        self.links[sample] = links;
        self.reached += 1;
        let at = self.samples[sample].clone();
        let depth_m = sample as f64 * self.step_m;
        self.enter(losses, Point { at, depth_m, links, behind: from as u32 });
    }

    /// All that one link more reaches.
    fn wave(&mut self, losses: &impl Losses<Place = P>) {
        let mut from: Vec<usize> = (self.last..self.points.len()).collect();
        from.retain(|&which| self.points[which].links == self.waves);
        // The deepest first: it reaches most of what there is.
        from.sort_by(|&a, &b| self.points[b].depth_m.total_cmp(&self.points[a].depth_m));
        (self.last, self.waves) = (self.points.len(), self.waves + 1);
        let (before_m, reached) = (self.front_m, self.reached);
        let mut near: Vec<u32> = Vec::new();
        for &which in &from {
            let Point { at, depth_m, .. } = self.points[which].clone();
            self.near_samples.around(losses.spot(&at), &mut near);
            for sample in near.iter().map(|&sample| sample as usize) {
                let is_new = self.links[sample] == NEVER && sample as f64 * self.step_m > depth_m;
                if is_new && losses.holds(&at, &self.samples[sample], self.level_db) {
                    self.reach(losses, sample, which);
                }
            }
        }
        self.ends(losses);
        let farthest = from.iter().copied().filter(|&which| self.advance(losses, which)).last();
        if let Some(farthest) = farthest.filter(|farthest| Some(farthest) != from.first()) {
            self.look_around(losses, farthest);
        }
        self.is_done = self.reached == reached && self.front_m - before_m < CREEP * self.step_m;
    }

    /// The ends of all stretches reached by the last wave, seen from where their last samples were reached from.
    fn ends(&mut self, losses: &impl Losses<Place = P>) {
        for which in self.last..self.points.len() {
            let Point { depth_m, behind, links, .. } = self.points[which];
            let next = (depth_m / self.step_m).round() as usize + 1;
            if self.links.get(next) != Some(&NEVER) {
                continue;
            }
            let end_m = self.end_m(losses, behind as usize, depth_m, next as f64 * self.step_m);
            if end_m > depth_m {
                self.enter(losses, Point { at: losses.place(end_m), depth_m: end_m, links, behind });
            }
        }
    }

    /// How far a point's links hold, between a depth where they do and one where they do not (m).
    fn end_m(&self, losses: &impl Losses<Place = P>, from: usize, near_m: f64, far_m: f64) -> f64 {
        let from = &self.points[from].at;
        let (mut near_m, mut far_m) = (near_m, far_m);
        while far_m - near_m > PLACE_M {
            let middle_m = f64::midpoint(near_m, far_m);
            if middle_m <= near_m || middle_m >= far_m {
                break;
            }
            if losses.holds(from, &losses.place(middle_m), self.level_db) {
                near_m = middle_m;
            } else {
                far_m = middle_m;
            }
        }
        near_m
    }

    /// Moves the front as far as a link from this point reaches, if it does; whether it did.
    fn advance(&mut self, losses: &impl Losses<Place = P>, from: usize) -> bool {
        let Point { at, links, .. } = self.points[from].clone();
        let start_m = self.front_m;
        let holds = |depth_m: f64| losses.holds(&at, &losses.place(depth_m), self.level_db);
        let deepest_m = (self.samples.len() - 1) as f64 * self.step_m;
        if start_m + 2.0 * PLACE_M >= deepest_m || !holds(start_m + 2.0 * PLACE_M) {
            return false;
        }
        loop {
            let next = (self.front_m / self.step_m + 1e-9).floor() as usize + 1;
            if next >= self.samples.len() {
                break;
            }
            if losses.holds(&at, &self.samples[next], self.level_db) {
                self.reach(losses, next, from);
                continue;
            }
            let end_m = self.end_m(losses, from, self.front_m, next as f64 * self.step_m);
            if end_m > self.front_m {
                let behind = from as u32;
                self.enter(
                    losses,
                    Point { at: losses.place(end_m), depth_m: end_m, links: links + 1, behind },
                );
            }
            break;
        }
        self.front_m > start_m
    }

    /// Looks on both sides of the point that sees farthest for a place that sees farther still.
    fn look_around(&mut self, losses: &impl Losses<Place = P>, farthest: usize) {
        let Point { links, behind, mut depth_m, .. } = self.points[farthest].clone();
        let before = self.points[behind as usize].clone();
        let mut aside_m = self.step_m;
        for _ in 0..FINER {
            aside_m /= 2.0;
            for there_m in [depth_m + aside_m, depth_m - aside_m] {
                let at = losses.place(there_m);
                if there_m < before.depth_m || !losses.holds(&before.at, &at, self.level_db) {
                    continue;
                }
                let which = self.points.len();
                self.points.push(Point { at: at.clone(), depth_m: there_m, links, behind });
                if self.advance(losses, which) {
                    // Whoever comes later may use it as well.
                    self.near_points.enter(losses.spot(&at), which as u32);
                    depth_m = there_m;
                    break;
                }
                self.points.truncate(which);
            }
        }
    }
}
