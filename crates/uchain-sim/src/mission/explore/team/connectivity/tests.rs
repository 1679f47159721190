//! Against robots that tell all they know, whenever they meet.

use std::collections::BTreeMap;

use glam::Vec2;
use proptest::prelude::*;
use uchain_core::explore::{EdgeRule, ExploreParams, Hub, Label, NodeReport, Point, Sector, SpentReport};

use super::*;
use crate::{
    map::drawn,
    radio::{Disc, PacketParams, RadioParams},
};

const RANGE_M: f32 = 1.5;

/// A map in which nothing is in the way.
fn open() -> Arc<Map> {
    Arc::new(drawn(&[vec![[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]]]).unwrap())
}

/// All within 1.5 m hear each other.
fn near(robots: usize) -> Connectivity {
    let model = Arc::new(Disc { range_m: RANGE_M, loss_db: 0.0 });
    Connectivity::new(robots, Some(TeamRadio { map: open(), model, channel: None }))
}

fn antenna(at: Point) -> Antenna {
    Vec2::new(at.x_m, at.y_m).into()
}

/// A store by names instead of slots.
type Known = (BTreeMap<NodeId, Vec<Label>>, Vec<[NodeId; 2]>, Vec<Hub>);

fn known(ssg: &Ssg) -> Known {
    let id = |slot| ssg.id(slot).unwrap();
    let labels = (0..ssg.len()).map(|i| (id(i), ssg.sectors(i).iter().map(|s| s.label).collect())).collect();
    let ends = |[a, b]: [usize; 2]| [id(a).min(id(b)), id(a).max(id(b))];
    let mut edges: Vec<[NodeId; 2]> = ssg.graph().edges_after(0).map(ends).collect();
    edges.sort_unstable();
    (labels, edges, ssg.hubs().collect())
}

/// Everything, to everybody in range that did not hear it before.
fn tell_all(before: &[usize], leader: &[usize], stores: &mut [Ssg]) {
    let mut tell = |from: usize, to: usize| {
        let reports: Vec<NodeReport> =
            (0..stores[from].len()).map(|i| stores[from].report(i).unwrap()).collect();
        for report in reports {
            let _ = stores[to].apply(&Message::Node(report));
        }
    };
    for first in 0..leader.len() {
        let others: Vec<usize> = (first + 1..leader.len()).filter(|&i| leader[i] == first).collect();
        if leader[first] == first && others.iter().any(|&i| before[i] != before[first]) {
            for &other in &others {
                tell(other, first);
            }
            for &other in &others {
                tell(first, other);
            }
        }
    }
}

fn node(id: NodeId, at: Point, signs: &[u8]) -> Message {
    let sector = |&sign: &u8| match sign {
        0 => Sector { label: Label::Obstacle, r_m: 0.4 },
        _ => Sector { label: Label::Frontier, r_m: 1.0 },
    };
    let flown_from = id.number.checked_sub(1).map(|number| NodeId { number, ..id });
    Message::Node(NodeReport { id, at, flown_from, sectors: signs.iter().map(sector).collect() })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn robots_that_tell_what_is_new_know_what_those_know_that_tell_all(
        rounds in prop::collection::vec(
            prop::collection::vec((-3.0..3.0_f32, -3.0..3.0_f32, prop::collection::vec(0..3_u8, 18), 0..18_u16), 5),
            1..15,
        ),
        eq8 in any::<bool>(), small in any::<bool>(),
    ) {
        let edges = if eq8 { EdgeRule::Eq8 } else { EdgeRule::Visible };
        let nodes_max = if small && !eq8 { 20 } else { 20_000 };
        let empty = Ssg::new(ExploreParams { edges, nodes_max, ..ExploreParams::default() }, 5).unwrap();
        let (mut stores, mut oracle) = (vec![empty.clone(); 5], vec![empty; 5]);
        let mut connectivity = near(5);
        let mut numbers = [0_u32; 5];
        for robots in rounds {
            let places: Vec<Point> = robots.iter().map(|&(x_m, y_m, ..)| Point { x_m, y_m }).collect();
            let before = connectivity.leader.clone();
            let antennas: Vec<Antenna> = places.iter().copied().map(antenna).collect();
            connectivity.listen(0, &antennas, &mut stores);
            tell_all(&before, &connectivity.leader, &mut oracle);
            for i in 0..5 {
                let (ours, theirs) = (known(&stores[i]), known(&oracle[i]));
                if ours.0.len() < nodes_max as usize {
                    prop_assert_eq!(ours, theirs, "robot {}", i);
                } else {
                    // A store that is full sends its robot home, whatever its labels say. By the same ways.
                    prop_assert!(ours.0.keys().eq(theirs.0.keys()), "robot {}", i);
                    prop_assert_eq!(ours.1, theirs.1, "robot {}", i);
                }
            }
            for (i, (.., signs, k)) in robots.iter().enumerate() {
                let id = NodeId { robot: i as u16, number: numbers[i] };
                let scanned = node(id, places[i], signs);
                if stores[i].apply(&scanned).is_err() {
                    prop_assert!(oracle[i].apply(&scanned).is_err());
                    continue;
                }
                numbers[i] += 1;
                let spent = Message::Spent(SpentReport { node: id, sectors: [*k; 2] });
                for message in [scanned, spent] {
                    for &hearer in connectivity.group_of(i) {
                        let _ = stores[hearer].apply(&message);
                        let _ = oracle[hearer].apply(&message);
                    }
                    connectivity.heard(i, &message);
                }
            }
        }
    }
}

#[test]
fn robots_that_meet_again_tell_what_is_new_and_not_what_they_know() {
    let mut stores = vec![Ssg::new(ExploreParams::default(), 3).unwrap(); 3];
    let mut connectivity = near(3);
    let at = |x_m: f32| Point { x_m, y_m: 0.0 };
    let say = |connectivity: &mut Connectivity, stores: &mut [Ssg], robot: usize, number: u32| {
        let id = NodeId { robot: robot as u16, number };
        let message = node(id, at(number as f32 * 0.7), &[1; 18]);
        for &hearer in connectivity.group_of(robot) {
            stores[hearer].apply(&message).unwrap();
        }
        connectivity.heard(robot, &message);
    };
    for number in 0..50 {
        say(&mut connectivity, &mut stores, 0, number);
    }
    // All were together; they part, and the first finds one more node.
    connectivity.listen(0, &[at(0.0), at(5.0), at(10.0)].map(antenna), &mut stores);
    say(&mut connectivity, &mut stores, 0, 50);
    assert_eq!(connectivity.log.unheard(&stores[0], 0, 1).len(), 1);
    connectivity.listen(0, &[at(0.0), at(1.0), at(10.0)].map(antenna), &mut stores);
    assert_eq!(stores.iter().map(Ssg::len).collect::<Vec<_>>(), [51, 51, 50]);
    // The third hears it from the second, and then there is nothing that the first could tell it.
    connectivity.listen(0, &[at(0.0), at(9.0), at(10.0)].map(antenna), &mut stores);
    assert_eq!(stores[2].len(), 51);
    assert_eq!(connectivity.log.unheard(&stores[0], 0, 2).len(), 0);
}

/// How often two robots hear each other that lose so much, with 3 dB of noise.
fn share_joined(loss_db: f32, packets: &PacketParams) -> f64 {
    let model = Arc::new(Disc { range_m: RANGE_M, loss_db });
    let channel = Some(channel(Seed(1), 0, &RadioParams::default(), packets, &FaultConfig::default()));
    let mut radio = TeamRadio { map: open(), model, channel };
    let robots = [0.0, 1.0].map(|x_m| antenna(Point { x_m, y_m: 0.0 }));
    let joined = (0..20_000).filter(|&tick| radio.joins(tick, [0, 1], &robots)).count();
    joined as f64 / 20_000.0
}

#[test]
fn two_robots_hear_each_other_if_both_their_packets_arrive() {
    let packets = PacketParams::default();
    // Both of two that a fifth of packets is lost of; at the limit half of these as well.
    for (loss_db, expected) in [(60.0, 0.8 * 0.8), (100.0, 0.4 * 0.4), (120.0, 0.0)] {
        let share = share_joined(loss_db, &packets);
        assert!((share - expected).abs() < 0.015, "{share} at {loss_db} dB");
    }
    assert_eq!(share_joined(60.0, &PacketParams { drop_rate: 0.0, ..packets }), 1.0);
}

#[test]
fn who_hears_whom_does_not_depend_on_who_is_asked_for_first() {
    let joined = |order: &[[usize; 2]]| {
        let model = Arc::new(Disc { range_m: 9.0, loss_db: 95.0 });
        let channel = Some(channel(
            Seed(1),
            0,
            &RadioParams::default(),
            &PacketParams::default(),
            &FaultConfig::default(),
        ));
        let mut radio = TeamRadio { map: open(), model, channel };
        let robots = [0.0, 1.0, 2.0].map(|x_m| antenna(Point { x_m, y_m: 0.0 }));
        let mut joined: Vec<([usize; 2], bool)> = Vec::new();
        for &[i, j] in order {
            joined.push(([i.min(j), i.max(j)], radio.joins(7, [i, j], &robots)));
        }
        joined.sort_unstable();
        joined
    };
    let all = joined(&[[0, 1], [0, 2], [1, 2]]);
    assert_eq!(all, joined(&[[2, 1], [1, 0], [2, 0]]));
}
