//! A survey as a graph: places that legs join, and how wide the passage is along each leg.

use std::collections::BTreeMap;

use super::{
    convex::{Plan, along, disc, hull},
    read::{Leg, Section, Survey},
};
use crate::map::{Import, RemarkKind};

/// Narrowest width that counts as measured (m).
const NARROWEST_M: f64 = 0.1;
/// How wide a passage is where a survey has measured no width at all (m).
const USUAL_WIDTH_M: f64 = 2.0;

/// The passages of a survey that are a cave's.
pub(super) struct Cave {
    pub(super) nodes: Vec<Node>,
    pub(super) passages: Vec<Passage>,
    /// Between a survey's name and a station's.
    pub(super) separator: char,
    /// How wide passages are that nobody has measured, in words, and why.
    pub(super) made_up: String,
}

/// A place where legs meet.
pub(super) struct Node {
    pub(super) at_m: [f64; 3],
    pub(super) entrance: bool,
    pub(super) names: Vec<String>,
    /// The legs that end here.
    pub(super) passages: Vec<usize>,
}

/// The passage along a leg.
pub(super) struct Passage {
    /// Nodes.
    pub(super) ends: [usize; 2],
    pub(super) length_m: f64,
    pub(super) plan_m: f64,
    /// To the left and to the right at either end, seen from the first to the second (m).
    pub(super) sides_m: [[f64; 2]; 2],
    /// Whether that was not measured at both ends.
    pub(super) is_made_up: bool,
}

impl Passage {
    pub(super) fn other(&self, end: usize) -> usize {
        if self.ends[0] == end { self.ends[1] } else { self.ends[0] }
    }

    /// Greatest width (m).
    pub(super) fn width_m(&self) -> f64 {
        self.sides_m.iter().map(|[left_m, right_m]| left_m + right_m).fold(0.0, f64::max)
    }
}

impl Cave {
    /// Drops what is no passage, and makes up widths that nobody has measured: `missing_width_m`, or the median of the measured ones.
    pub(super) fn new(survey: Survey, missing_width_m: Option<f64>, import: &mut Import) -> Self {
        let mut cave = Self {
            nodes: Vec::new(),
            passages: Vec::new(),
            separator: survey.separator,
            made_up: String::new(),
        };
        let mut node_at: BTreeMap<[i32; 3], usize> = BTreeMap::new();
        let mut known: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let (mut dropped, mut unsurveyed) = ([0; 4], 0);
        for leg in &survey.legs {
            if let Some(why) =
                [Leg::SURFACE, Leg::DUPLICATE, Leg::SPLAY].iter().position(|&flag| leg.is(flag))
            {
                dropped[why] += 1;
                continue;
            }
            let [from, to] = [leg.from_cm, leg.to_cm].map(|at_cm| cave.node(&mut node_at, at_cm));
            let next = cave.passages.len();
            if from == to || *known.entry([from.min(to), from.max(to)]).or_insert(next) != next {
                dropped[3] += 1;
                continue;
            }
            unsurveyed += usize::from(leg.unsurveyed);
            cave.join(from, to);
        }
        let whys = [
            "legs above ground",
            "legs that survey again what others have",
            "splays, from a station to the wall",
            "legs without length, or between the same two stations as others",
        ];
        for (count, why) in dropped.into_iter().zip(whys) {
            import.say(RemarkKind::Dropped, count, why);
        }
        import.say(RemarkKind::Guessed, unsurveyed, "legs that nobody has measured: drawn straight");
        let mut node_of: BTreeMap<String, usize> = BTreeMap::new();
        for station in survey.stations {
            // A station without a passage is one on the surface, at a wall, or nowhere.
            let Some(&node) = node_at.get(&station.at_cm) else { continue };
            cave.nodes[node].entrance |= station.entrance;
            if !station.name.is_empty() {
                node_of.insert(station.name.clone(), node);
                cave.nodes[node].names.push(station.name);
            }
        }
        let measured = cave.measure(&survey.sections, &node_of, &known, import);
        cave.make_up(&measured, missing_width_m);
        cave
    }

    fn node(&mut self, node_at: &mut BTreeMap<[i32; 3], usize>, at_cm: [i32; 3]) -> usize {
        *node_at.entry(at_cm).or_insert_with(|| {
            let at_m = at_cm.map(|cm| f64::from(cm) / 100.0);
            self.nodes.push(Node { at_m, entrance: false, names: Vec::new(), passages: Vec::new() });
            self.nodes.len() - 1
        })
    }

    fn join(&mut self, from: usize, to: usize) {
        let [a, b] = [from, to].map(|node| self.nodes[node].at_m);
        let (_, plan_m) = along([a[0], a[1]], [b[0], b[1]]);
        let length_m = libm::hypot(plan_m, b[2] - a[2]);
        for end in [from, to] {
            self.nodes[end].passages.push(self.passages.len());
        }
        self.passages.push(Passage {
            ends: [from, to],
            length_m,
            plan_m,
            sides_m: [[0.0; 2]; 2],
            is_made_up: true,
        });
    }

    /// Sides by passage: a cross-section counts for the legs to the ones before and after it in its passage.
    fn measure(
        &self,
        sections: &[Section],
        node_of: &BTreeMap<String, usize>,
        known: &BTreeMap<[usize; 2], usize>,
        import: &mut Import,
    ) -> BTreeMap<usize, [[Option<f64>; 2]; 2]> {
        let mut measured = BTreeMap::new();
        let mut lonely = 0;
        for pair in sections.windows(2) {
            let [a, b] = pair else { continue };
            if a.last {
                continue;
            }
            let nodes = [a, b].map(|section| node_of.get(&section.station).copied());
            let passage = match nodes {
                [Some(a), Some(b)] => known.get(&[a.min(b), a.max(b)]),
                _ => None,
            };
            let Some(&passage) = passage else {
                lonely += 1;
                continue;
            };
            let mut sides_m = [[a.left_m, a.right_m], [b.left_m, b.right_m]];
            if Some(self.passages[passage].ends[0]) != nodes[0] {
                // Measured the other way round: what was left is right.
                sides_m = [[sides_m[1][1], sides_m[1][0]], [sides_m[0][1], sides_m[0][0]]];
            }
            measured.insert(passage, sides_m);
        }
        let why = "pairs of cross-sections that follow one another with no leg between them";
        import.say(RemarkKind::Dropped, lonely, why);
        measured
    }

    fn make_up(&mut self, measured: &BTreeMap<usize, [[Option<f64>; 2]; 2]>, missing_width_m: Option<f64>) {
        let whole = |sides_m: &[Option<f64>; 2]| {
            Some(sides_m[0]? + sides_m[1]?).filter(|&width_m| width_m >= NARROWEST_M)
        };
        let mut widths_m: Vec<f64> = measured.values().flatten().filter_map(whole).collect();
        widths_m.sort_by(f64::total_cmp);
        let median_m = widths_m.get(widths_m.len() / 2).copied();
        let missing_m = missing_width_m.or(median_m).unwrap_or(USUAL_WIDTH_M);
        // Sums of centimetres are not always whole ones.
        let missing_m = (missing_m * 100.0).round() / 100.0;
        for (index, passage) in self.passages.iter_mut().enumerate() {
            let sides_m = measured.get(&index).copied().unwrap_or_default();
            passage.is_made_up = sides_m.iter().any(|end| whole(end).is_none());
            passage.sides_m = sides_m.map(|end| match end {
                [Some(left_m), Some(right_m)] if left_m + right_m >= NARROWEST_M => [left_m, right_m],
                [Some(_), Some(_)] => [missing_m / 2.0; 2],
                [left_m, right_m] => [left_m, right_m].map(|side_m| side_m.unwrap_or(missing_m / 2.0)),
            });
        }
        let by = match (missing_width_m, median_m) {
            (Some(_), _) => "as missing_width_m says".to_owned(),
            (None, Some(_)) => format!("the median of {} measured widths", widths_m.len()),
            (None, None) => "no width is in the file".to_owned(),
        };
        self.made_up = format!("{missing_m} m wide there ({by}; key missing_width_m)");
    }

    pub(super) fn plan(&self, node: usize) -> Plan {
        let [x, y, _] = self.nodes[node].at_m;
        [x, y]
    }

    pub(super) fn line(&self, passage: usize) -> [Plan; 2] {
        self.passages[passage].ends.map(|end| self.plan(end))
    }

    /// The middle of a passage at one of its ends, and half its width there (m); with the corners of the disc between its walls.
    pub(super) fn end(&self, passage: usize, node: usize) -> (Plan, Vec<Plan>) {
        let Passage { ends, sides_m, .. } = &self.passages[passage];
        let (direction, _) = along(self.plan(ends[0]), self.plan(ends[1]));
        let [left_m, right_m] = sides_m[usize::from(ends[0] != node)];
        let [x, y] = self.plan(node);
        let to_left_m = (left_m - right_m) / 2.0;
        let middle = [x - direction[1] * to_left_m, y + direction[0] * to_left_m];
        (middle, disc(middle, left_m.midpoint(right_m), direction).collect())
    }

    /// The outline of a passage: between the discs at its ends.
    pub(super) fn outline(&self, passage: usize) -> Vec<Plan> {
        let [a, b] = self.passages[passage].ends;
        let mut corners = self.end(passage, a).1;
        corners.extend(self.end(passage, b).1);
        hull(corners)
    }

    /// The outline of the room in which passages meet at a node.
    pub(super) fn joint(&self, node: usize, passages: impl Iterator<Item = usize>) -> Vec<Plan> {
        hull(passages.flat_map(|passage| self.end(passage, node).1).collect())
    }
}
