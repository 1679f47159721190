use super::super::{ExploreParams, Goal, StrategyKind, tests::Scene};
use crate::explore::ssg::tests::{id, node, point};

/// Robot 0 at a node with these sectors; nodes of others in a row to the east, each with its sectors.
fn row(strategy: StrategyKind, beta: f32, signs: &str, east: &[&str]) -> Scene {
    let params = ExploreParams { strategy, utility_beta: beta, ..ExploreParams::default() };
    let mut scene = Scene::new(params, signs);
    let mut from = id(0, 0);
    for (i, signs) in east.iter().enumerate() {
        let next = id(1, i as u32);
        scene.ssg.apply(&node(next, point(0.8 * (i + 1) as f32, 0.0), Some(from), signs)).unwrap();
        from = next;
    }
    scene
}

const DEAD_END: &str = "999999999999999999";
/// A frontier of one sector, and one of five, to the north.
const NARROW: &str = "9999!9999999999999";
const WIDE: &str = "99!!!!!99999999999";

#[test]
fn the_nearest_frontier_is_anybodys_and_here_the_one_of_the_least_turn() {
    let nearest = |signs, east: &[&str]| row(StrategyKind::NEAREST_FRONTIER, 1.0, signs, east).goal();
    assert_eq!(nearest(DEAD_END, &[DEAD_END, NARROW, WIDE]), Goal::Node(2));
    assert_eq!(nearest(DEAD_END, &[DEAD_END, DEAD_END]), Goal::Home);
    let turn = |heading_deg| {
        let scene = row(StrategyKind::NEAREST_FRONTIER, 1.0, "!9999999999!!!9999", &[]);
        scene.heading(heading_deg).chosen_deg()
    };
    assert_eq!((turn(20.0), turn(200.0)), (10.0, 250.0), "the width does not matter");
}

#[test]
fn a_wide_frontier_is_worth_a_way_until_the_way_costs_more() {
    let utility = |beta, signs, east: &[&str]| row(StrategyKind::UTILITY, beta, signs, east).goal();
    // Four arcs that no neighbour covers are 1.4 m, one is 0.35 m; the way is 0.8 m more.
    assert_eq!(utility(1.0, NARROW, &[WIDE]), Goal::Node(1));
    assert!(matches!(utility(2.0, NARROW, &[WIDE]), Goal::Frontier(_)));
    assert_eq!(utility(0.5, DEAD_END, &[NARROW, DEAD_END, WIDE]), Goal::Node(3));
    assert_eq!(utility(1.0, DEAD_END, &[NARROW, DEAD_END, WIDE]), Goal::Node(1));
    assert_eq!(utility(0.0, DEAD_END, &[DEAD_END]), Goal::Home);
}

#[test]
fn what_another_robot_will_see_is_worth_less() {
    let mut scene = row(StrategyKind::UTILITY, 0.05, DEAD_END, &[WIDE, NARROW]);
    assert_eq!(scene.goal(), Goal::Node(1));
    let beside_it = point(0.8, 0.95);
    let mut scene = scene.mate(2, beside_it, Some(beside_it));
    assert_eq!(scene.goal(), Goal::Node(2));
}

#[test]
fn a_robot_on_its_way_to_a_frontier_goes_on_as_long_as_there_is_one() {
    let mut scene = row(StrategyKind::UTILITY, 1.0, DEAD_END, &[WIDE, NARROW]);
    scene.previous = Some(id(1, 1));
    assert_eq!(scene.goal(), Goal::Node(2));
    scene.previous = Some(id(0, 0));
    assert_eq!(scene.goal(), Goal::Node(1), "there is none there");
    let mut there = row(StrategyKind::UTILITY, 1.0, NARROW, &[WIDE]);
    there.previous = Some(id(0, 0));
    assert!(matches!(there.goal(), Goal::Frontier(_)), "it came for this one");
}
