use alloc::{string::String, vec, vec::Vec};

use proptest::prelude::*;

use super::*;
use crate::explore::SpentReport;

pub(in crate::explore) fn id(robot: u16, number: u32) -> NodeId {
    NodeId { robot, number }
}

pub(in crate::explore) fn point(x_m: f32, y_m: f32) -> Point {
    Point { x_m, y_m }
}

/// A scan as a line of 18 signs: `!` nothing within range, a digit a wall at so many tenths of a metre.
pub(in crate::explore) fn scan(signs: &str) -> Vec<Option<f32>> {
    signs.chars().map(|sign| sign.to_digit(10).map(|tenths| tenths as f32 / 10.0)).collect()
}

pub(in crate::explore) fn node(id: NodeId, at: Point, flown_from: Option<NodeId>, signs: &str) -> Message {
    let sectors = scan(signs).into_iter().map(|return_m| Sector::of(return_m, 1.0)).collect();
    Message::Node(NodeReport { id, at, flown_from, sectors })
}

/// The labels of a node: `#`, `.` and `!` for −1, 0 and 1.
fn labels(ssg: &Ssg, id: NodeId) -> String {
    let sign = |sector: &Sector| match sector.label.value() {
        -1 => '#',
        0 => '.',
        _ => '!',
    };
    ssg.sectors(ssg.slot(id).unwrap()).iter().map(sign).collect()
}

fn empty(params: ExploreParams) -> Ssg {
    Ssg::new(params, 2).unwrap()
}

const OPEN: &str = "!!!!!!!!!!!!!!!!!!";

#[test]
fn a_wall_at_exactly_the_range_is_an_obstacle_and_the_next_distance_is_none() {
    let beyond = f32::from_bits(1.0_f32.to_bits() + 1);
    assert_eq!(Sector::of(Some(1.0), 1.0), Sector { label: Label::Obstacle, r_m: 1.0 });
    assert_eq!(Sector::of(Some(beyond), 1.0), Sector { label: Label::Frontier, r_m: 1.0 });
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0] {
        assert_eq!(Sector::of(Some(bad), 1.0), Sector { label: Label::Obstacle, r_m: 0.0 });
    }
}

#[test]
fn a_place_is_in_a_star_if_it_is_nearer_than_the_sector_that_faces_it_reaches() {
    let mut ssg = empty(ExploreParams::default());
    // 0.5 m in the first sector, 0° to 20°, open elsewhere.
    ssg.apply(&node(id(0, 0), point(10.0, -5.0), None, "5!!!!!!!!!!!!!!!!!")).unwrap();
    let star = ssg.star(0).unwrap();
    let seen = |angle_deg: f32, m: f32| {
        let angle_rad = angle_deg.to_radians();
        star.contains(point(10.0 + m * libm::cosf(angle_rad), -5.0 + m * libm::sinf(angle_rad)))
    };
    assert!(seen(10.0, 0.49) && !seen(10.0, 0.51));
    assert!(seen(20.5, 0.99) && !seen(20.5, 1.01));
    assert!(seen(359.5, 0.99) && seen(180.0, 0.99) && !seen(0.5, 0.99));
    assert!(!star.contains(point(f32::NAN, 0.0)));
}

/// Kim 2021, Fig. 3, Eq. 3 to 5: robot 1 flies from its first node along the last three sectors.
#[test]
fn the_hub_data_of_figure_3_is_1_5_3() {
    let mut ssg = empty(ExploreParams::default());
    // Frontiers in the paper's sectors 5, 6, 8, 9 and 11, and in 16 to 18.
    ssg.apply(&node(id(0, 0), point(0.0, 0.0), None, "5555!!5!!5!5555!!!")).unwrap();
    assert_eq!(labels(&ssg, id(0, 0)), "####!!#!!#!####!!!");
    let q12 = ssg.cones().point(point(0.0, 0.0), 33, 0.8);
    ssg.apply(&node(id(0, 1), q12, Some(id(0, 0)), "!!5!!!5!!!!!5!!!!!")).unwrap();
    // Eq. 5: the last three are free now. The way back, in the paper's sector 8, never was a frontier.
    assert_eq!(labels(&ssg, id(0, 0)), "####!!#!!#!####...");
    assert_eq!(labels(&ssg, id(0, 1)).get(7..8), Some("."));
    let first = ssg.hubs().next().unwrap();
    assert_eq!((first.node.number + 1, first.frontiers, first.merged), (1, 5, 3));
}

#[test]
fn an_arc_stays_a_frontier_while_an_end_at_a_wide_gap_is_uncovered_if_ends_count() {
    let third = |signs, arc_ends, arc_gap_share| {
        let mut ssg = empty(ExploreParams { arc_ends, arc_gap_share, ..ExploreParams::default() });
        ssg.apply(&node(id(0, 0), point(0.0, 0.0), None, signs)).unwrap();
        // Its star reaches the mid-point of sector 3, at 70°, and the end at 60°, but not the end at 80°.
        let other = point(0.8, 0.17);
        ssg.apply(&node(id(0, 1), other, Some(id(0, 0)), OPEN)).unwrap();
        let distance = |half: usize| ssg.cones().point(point(0.0, 0.0), half, 1.0).distance_m(other);
        assert!(distance(6) < 0.99 && distance(7) < 0.99 && distance(8) > 1.01);
        labels(&ssg, id(0, 0)).chars().nth(3).unwrap()
    };
    // A wall at 0.4 m beside the end at 80°: a gap of 0.6 m; and one beside the end at 60°, which is covered.
    let (uncovered, covered) = ("!!!!4!!!!!!!!!!!!!", "!!4!!!!!!!!!!!!!!!");
    assert_eq!(third(uncovered, false, 0.0), '.', "mid-points alone");
    assert_eq!([0.0, 0.5, 0.7].map(|share| third(uncovered, true, share)), ['!', '!', '.']);
    assert_eq!([0.0, 0.5, 0.7].map(|share| third(covered, true, share)), ['!', '.', '.']);
    assert_eq!([0.0, 0.01].map(|share| third(OPEN, true, share)), ['!', '.'], "no gap at all");
    let exact = 1.0 - 0.5_f32;
    assert_eq!(third("!!!!5!!!!!!!!!!!!!", true, exact), '!', "a gap of exactly so much is wide");
}

#[test]
fn beside_the_first_sector_lies_the_last() {
    let label = |wall: usize, k: usize, y_m: f32| {
        let mut ssg = empty(ExploreParams { arc_ends: true, ..ExploreParams::default() });
        let signs: String = (0..18).map(|sector| if sector == wall { '4' } else { '!' }).collect();
        ssg.apply(&node(id(0, 0), point(0.0, 0.0), None, &signs)).unwrap();
        // Its star reaches the mid-point at 10° or 350°, but not the end at 0°.
        let other = point(0.306, y_m);
        assert!(other.distance_m(point(1.0, 0.0)) > 1.01);
        assert!(other.distance_m(ssg.cones().point(point(0.0, 0.0), 2 * k + 1, 1.0)) < 0.99);
        ssg.apply(&node(id(0, 1), other, Some(id(0, 0)), OPEN)).unwrap();
        labels(&ssg, id(0, 0)).chars().nth(k).unwrap()
    };
    assert_eq!((label(17, 0, 0.758), label(0, 17, -0.758)), ('!', '!'));
    assert_eq!((label(16, 0, 0.758), label(1, 17, -0.758)), ('.', '.'), "the control: another sector's wall");
}

#[test]
fn two_nodes_at_one_place_do_not_cover_each_other() {
    for place in [point(5.62, 5.105), point(0.1, 0.7), point(-31.3, 2.9)] {
        let mut ssg = empty(ExploreParams::default());
        ssg.apply(&node(id(0, 0), place, None, OPEN)).unwrap();
        ssg.apply(&node(id(1, 0), place, None, OPEN)).unwrap();
        assert_eq!((labels(&ssg, id(0, 0)), labels(&ssg, id(1, 0))), (OPEN.into(), OPEN.into()));
    }
}

#[test]
fn eq_8_as_printed_connects_only_along_free_arcs_and_does_so_once_they_are_free() {
    let pair = |edges| {
        let mut ssg = empty(ExploreParams { edges, ..ExploreParams::default() });
        ssg.apply(&node(id(0, 0), point(0.0, 0.0), None, OPEN)).unwrap();
        // Sees the first through a slit, and no farther than 0.1 m elsewhere: the facing arc stays uncovered.
        ssg.apply(&node(id(1, 0), point(0.9, 0.1), None, "111111111!11111111")).unwrap();
        ssg
    };
    let visible = pair(EdgeRule::Visible);
    assert!(visible.graph().linked(0, 1));
    let mut printed = pair(EdgeRule::Eq8);
    assert_eq!(labels(&printed, id(0, 0)).get(..1), Some("!"));
    assert_eq!(labels(&printed, id(1, 0)).get(9..10), Some("."));
    assert!(!printed.graph().linked(0, 1));
    printed.apply(&Message::Spent(SpentReport { node: id(0, 0), sectors: [0, 0] })).unwrap();
    assert!(printed.graph().linked(0, 1));
}

#[test]
fn the_edge_just_flown_is_always_there_whoever_is_heard_first() {
    let from = node(id(0, 0), point(0.0, 0.0), None, "!11111111111111111");
    let to = node(id(0, 1), point(0.79, 0.14), Some(id(0, 0)), "111111111111111111");
    for order in [[&from, &to], [&to, &from]] {
        let mut ssg = empty(ExploreParams::default());
        for message in order {
            ssg.apply(message).unwrap();
        }
        assert!(ssg.graph().linked(0, 1), "no star reaches the other node, but somebody flew there");
    }
}

#[test]
fn a_node_that_cannot_be_is_refused_and_leaves_no_trace() {
    let mut ssg = Ssg::new(ExploreParams { nodes_max: 2, ..ExploreParams::default() }, 2).unwrap();
    let refused = |ssg: &mut Ssg, message: &Message| ssg.apply(message).unwrap_err();
    let sectors = node(id(0, 0), point(0.0, 0.0), None, "!!!");
    assert_eq!(refused(&mut ssg, &sectors), Refusal::Sectors { got: 3, want: 18 });
    let stranger = node(id(2, 0), point(0.0, 0.0), None, OPEN);
    assert_eq!(refused(&mut ssg, &stranger), Refusal::Stranger { robot: 2, robots: 2 });
    for place in [point(f32::NAN, 0.0), point(0.0, 1.0e6), point(f32::NEG_INFINITY, 0.0)] {
        assert_eq!(refused(&mut ssg, &node(id(0, 0), place, None, OPEN)), Refusal::Place);
    }
    assert!(ssg.is_empty() && !ssg.has_hubs() && !ssg.is_full());
    for number in 0..2 {
        ssg.apply(&node(id(0, number), point(number as f32, 0.0), None, OPEN)).unwrap();
    }
    assert_eq!(refused(&mut ssg, &node(id(0, 2), point(9.0, 0.0), None, OPEN)), Refusal::Full { nodes: 2 });
    assert_eq!(ssg.len(), 2);
    assert!(Ssg::new(ExploreParams { r_s_m: f32::NAN, ..ExploreParams::default() }, 1).is_err());
}

/// Nodes, some close together, with walls anywhere, and spent arcs.
fn reports() -> impl Strategy<Value = Vec<Message>> {
    let returns = prop::collection::vec(prop::option::of(0.0..1.2_f32), 18);
    let node = (0..2_u16, -1.5..1.5_f32, -1.5..1.5_f32, returns);
    let spent = (0..2_u16, 0..8_u32, [0..18_u16, 0..18_u16]);
    (prop::collection::vec(node, 2..14), prop::collection::vec(spent, 0..4)).prop_map(|(nodes, spent)| {
        let mut numbers = [0_u32; 2];
        let mut messages = Vec::new();
        for (robot, x_m, y_m, returns) in nodes {
            let number = numbers[usize::from(robot)];
            numbers[usize::from(robot)] += 1;
            let sectors = returns.into_iter().map(|return_m| Sector::of(return_m, 1.0)).collect();
            let flown_from = number.checked_sub(1).map(|before| id(robot, before));
            let at = point(x_m, y_m);
            messages.push(Message::Node(NodeReport { id: id(robot, number), at, flown_from, sectors }));
        }
        messages.extend(spent.into_iter().map(|(robot, number, sectors)| {
            Message::Spent(SpentReport { node: id(robot, number), sectors })
        }));
        messages
    })
}

/// What a store knows, by names instead of slots.
#[derive(Debug, PartialEq)]
struct Known {
    labels: Vec<(NodeId, String)>,
    edges: Vec<(NodeId, NodeId)>,
    hubs: Vec<Hub>,
}

fn known(ssg: &Ssg) -> Known {
    let name = |slot| ssg.id(slot).unwrap();
    let from = |slot| ssg.graph().neighbours(slot).map(move |(to, _)| (name(slot), name(to)));
    let mut edges: Vec<(NodeId, NodeId)> = (0..ssg.len()).flat_map(from).collect();
    edges.sort_unstable();
    Known {
        labels: ssg.slots.keys().map(|&id| (id, labels(ssg, id))).collect(),
        edges,
        hubs: ssg.hubs().collect(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn copies_that_have_heard_the_same_are_equal_whatever_the_order_and_repetition(
        messages in reports(), order in prop::collection::vec(any::<prop::sample::Index>(), 40),
        eq8 in any::<bool>(), arc_ends in any::<bool>(), arc_gap_share in 0.0..=1.0_f32,
    ) {
        let edges = if eq8 { EdgeRule::Eq8 } else { EdgeRule::Visible };
        let params = ExploreParams { arc_ends, arc_gap_share, edges, ..ExploreParams::default() };
        let (mut first, mut second) = (empty(params.clone()), empty(params));
        for message in &messages {
            first.apply(message).unwrap();
        }
        for message in order.iter().map(|i| i.get(&messages)).chain(&messages) {
            second.apply(message).unwrap();
        }
        prop_assert_eq!(known(&first), known(&second));
    }

    /// Incremental and indexed against all pairs, from the definition.
    #[test]
    fn a_frontier_is_an_open_arc_whose_mid_point_no_other_star_covers(messages in reports()) {
        let mut ssg = empty(ExploreParams::default());
        let mut spent = vec![];
        for message in &messages {
            let before = known(&ssg).labels;
            ssg.apply(message).unwrap();
            for (id, was) in before {
                let now = labels(&ssg, id);
                let allowed = was.chars().zip(now.chars()).all(|(a, b)| a == b || (a, b) == ('!', '.'));
                prop_assert!(allowed, "labels only fall: {} to {}", was, now);
            }
            if let Message::Spent(report) = message {
                spent.extend(report.sectors.map(|k| (report.node, usize::from(k))));
            }
        }
        let mut hubs = vec![];
        for message in &messages {
            let Message::Node(report) = message else { continue };
            let mut frontiers = 0;
            for (k, sector) in report.sectors.iter().enumerate() {
                let angle_rad = (k as f32 * 20.0 + 10.0).to_radians();
                let mid = point(report.at.x_m + libm::cosf(angle_rad), report.at.y_m + libm::sinf(angle_rad));
                let covers = |slot: usize| {
                    ssg.id(slot) != Some(report.id) && ssg.star(slot).unwrap().holds(mid, 0.001)
                };
                let covered = (0..ssg.len()).any(covers) || spent.contains(&(report.id, k));
                let expected = match sector.label {
                    Label::Obstacle => Label::Obstacle,
                    _ if covered => Label::Free,
                    _ => Label::Frontier,
                };
                // Where the mid-point lies on the very edge of a star, its last bit decides.
                if ssg.sectors(ssg.slot(report.id).unwrap())[k].label != expected {
                    let edge = |slot: usize| {
                        let star = ssg.star(slot).unwrap();
                        let near = |p: Point| star.holds(p, 0.001);
                        let shifts = [(1e-5, 0.0), (-1e-5, 0.0), (0.0, 1e-5), (0.0, -1e-5)];
                        shifts.iter().any(|(dx, dy)| near(point(mid.x_m + dx, mid.y_m + dy)) != near(mid))
                    };
                    prop_assert!((0..ssg.len()).any(edge), "{:?} sector {}", report.id, k);
                }
                frontiers += usize::from(ssg.sectors(ssg.slot(report.id).unwrap())[k].label == Label::Frontier);
            }
            if frontiers > 0 {
                hubs.push((report.id, frontiers));
            }
        }
        hubs.sort_unstable();
        let listed: Vec<(NodeId, usize)> = ssg.hubs().map(|hub| (hub.node, hub.frontiers)).collect();
        prop_assert_eq!(&listed, &hubs);
        for robot in 0..2 {
            prop_assert_eq!(ssg.hubs_of(robot), hubs.iter().filter(|(id, _)| id.robot == robot).count());
        }
    }
}
