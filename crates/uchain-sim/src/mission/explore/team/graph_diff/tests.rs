//! Against the difference of everything that is known before and after.

use std::collections::BTreeSet;

use proptest::prelude::*;
use uchain_core::explore::{ExploreParams, Message, NodeReport, Point, SpentReport};

use super::*;

/// All labels and edges of a store, looked at one by one.
#[derive(Default)]
struct Whole {
    labels: Vec<Vec<Label>>,
    degrees: Vec<usize>,
}

impl Whole {
    /// What is new, by a comparison of all that is known.
    fn update(&mut self, ssg: &Ssg) -> (Range<usize>, Vec<LabelFrame>, Vec<[NodeId; 2]>) {
        let nodes = self.labels.len()..ssg.len();
        let (mut labels, mut edges) = (Vec::new(), Vec::new());
        for slot in 0..ssg.len() {
            let node = ssg.id(slot).unwrap();
            if slot >= nodes.start {
                let scanned = |label| if label == Label::Free { Label::Frontier } else { label };
                self.labels.push(ssg.sectors(slot).iter().map(|s| scanned(s.label)).collect());
                self.degrees.push(0);
            }
            for (k, sector) in ssg.sectors(slot).iter().enumerate() {
                if self.labels[slot][k] != sector.label {
                    self.labels[slot][k] = sector.label;
                    labels.push(LabelFrame { node, sector: k as u16, label: sector.label });
                }
            }
        }
        for slot in 0..ssg.len() {
            let degree = ssg.graph().neighbours(slot).count();
            let new = ssg.graph().neighbours(slot).take(degree - self.degrees[slot]);
            let later = new.filter(|(other, _)| *other < slot);
            edges.extend(later.map(|(other, _)| [ssg.id(other).unwrap(), ssg.id(slot).unwrap()]));
            self.degrees[slot] = degree;
        }
        (nodes, labels, edges)
    }
}

proptest! {
    #[test]
    fn what_is_new_is_the_difference_of_all_that_is_known(
        scans in prop::collection::vec(
            (0..3_u16, -2.0..2.0_f32, -2.0..2.0_f32, prop::collection::vec(0..4_u8, 18), any::<u8>()), 1..40,
        ),
        spent in prop::collection::vec((0..3_u16, 0..12_u32, 0..18_u16), 40),
        round in 1..6_usize,
    ) {
        let mut ssg = Ssg::new(ExploreParams::default(), 3).unwrap();
        ssg.note_freed();
        let (mut diff, mut whole) = (GraphDiff::default(), Whole::default());
        let mut numbers = [0_u32; 3];
        for (i, ((robot, x_m, y_m, signs, from), (of, number, k))) in scans.into_iter().zip(spent).enumerate() {
            let next = &mut numbers[usize::from(robot)];
            let sectors = signs.iter().map(|sign| match sign {
                0 => Sector { label: Label::Obstacle, r_m: 0.4 },
                // As it comes from a robot that knows more.
                1 => Sector { label: Label::Free, r_m: 1.0 },
                _ => Sector { label: Label::Frontier, r_m: 1.0 },
            });
            let report = NodeReport {
                id: NodeId { robot, number: *next },
                at: Point { x_m, y_m },
                flown_from: (*next > 0).then(|| NodeId { robot, number: u32::from(from) % *next }),
                sectors: sectors.collect(),
            };
            *next += 1;
            ssg.apply(&Message::Node(report)).unwrap();
            let node = NodeId { robot: of, number };
            ssg.apply(&Message::Spent(SpentReport { node, sectors: [k; 2] })).unwrap();
            if i % round == 0 {
                diff.update(&mut ssg);
                let (nodes, labels, edges) = whole.update(&ssg);
                prop_assert_eq!(&diff.nodes, &nodes);
                prop_assert_eq!(&diff.labels, &labels);
                prop_assert_eq!(&diff.edges, &edges);
                prop_assert_eq!(ssg.hub_count(), ssg.hubs().count());
                let twice: BTreeSet<_> = diff.labels.iter().map(|l| (l.node, l.sector)).collect();
                prop_assert_eq!(twice.len(), diff.labels.len());
            }
        }
    }
}
