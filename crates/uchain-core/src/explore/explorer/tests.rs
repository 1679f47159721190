use alloc::{vec, vec::Vec};

use super::*;
use crate::explore::{
    Label, Point, StrategyKind,
    ssg::tests::{id, node, point, scan},
};

const CELL: &str = "555555555555555555";

/// A robot and its store, where a test says what a scan returns.
struct Lone {
    ssg: Ssg,
    robot: Explorer,
    params: ExploreParams,
    said: Vec<Message>,
}

impl Lone {
    fn new(params: ExploreParams) -> Self {
        let ssg = Ssg::new(params.clone(), 2).unwrap();
        Self { ssg, robot: Explorer::new(0, 2), params, said: vec![] }
    }

    fn see(&mut self, at: Point, arrived: bool, signs: Option<&str>) {
        let returns = signs.map(scan);
        let pose = Pose { at, heading_rad: 0.0 };
        let seen = Observation { pose, arrived, scan: returns.as_deref() };
        self.robot.perceive(&mut self.ssg, &seen, &mut self.said).unwrap();
    }

    fn announce(&mut self) -> Target {
        self.robot.announce(&mut self.ssg, &mut || 0, &mut self.said)
    }

    fn follow_ruling(&mut self, hold: bool) -> Command {
        self.robot.follow_ruling(Ruling { level: 1, hold, mfl: false }, &self.params)
    }

    fn label(&self, number: u32, k: usize) -> Label {
        self.ssg.sectors(self.ssg.slot(id(0, number)).unwrap())[k].label
    }
}

fn lone() -> Lone {
    Lone::new(ExploreParams::default())
}

#[test]
fn it_flies_along_its_frontier_scans_there_and_comes_home() {
    let mut lone = lone();
    lone.see(point(0.0, 0.0), true, Some("5555!5555555555555"));
    let out = lone.announce();
    assert_eq!(out.purpose, Purpose::Explore);
    assert!(out.to.distance_m(point(0.0, 0.8)) < 1e-6);
    let command = lone.follow_ruling(false);
    assert!(command.scan && (command.heading_rad - core::f32::consts::FRAC_PI_2).abs() < 1e-6);
    assert_eq!((command.to, command.level, command.z_m), (out.to, 1, 1.0));

    lone.see(out.to, true, Some(CELL));
    assert_eq!(lone.label(0, 4), Label::Free, "the arc flown along");
    assert!(lone.ssg.graph().linked(0, 1));
    let back = lone.announce();
    assert_eq!((back.purpose, back.to), (Purpose::Home, point(0.0, 0.0)));
    assert!(!lone.follow_ruling(false).scan);

    lone.see(back.to, true, None);
    assert_eq!(lone.announce().purpose, Purpose::Park);
    assert_eq!(lone.follow_ruling(false).to, back.to);
    assert_eq!((lone.robot.node(), lone.robot.home()), (Some(id(0, 0)), Some(id(0, 0))));
}

/// SPEC of termination: without it a robot at the range of a wall comes again and again.
#[test]
fn the_arc_flown_along_is_spent_though_the_new_star_does_not_reach_its_mid_point() {
    let mut lone = lone();
    lone.see(point(0.0, 0.0), true, Some("555!!5555555555555"));
    let out = lone.announce();
    lone.follow_ruling(false);
    lone.see(out.to, true, Some("111111111111111111"));
    assert_eq!([lone.label(0, 3), lone.label(0, 4)], [Label::Free; 2], "both middle sectors");
}

#[test]
fn a_place_beside_a_node_that_sees_it_is_not_flown_to() {
    let mut lone = lone();
    let other = node(id(1, 0), point(0.0, 0.75), None, "111111111111111111");
    lone.ssg.apply(&other).unwrap();
    lone.see(point(0.0, 0.0), true, Some("5555!55555555!5555"));
    // North is nothing new: south it is, at once.
    let out = lone.announce();
    assert!(out.to.distance_m(point(0.0, -0.8)) < 1e-6, "{out:?}");
    assert_eq!(lone.label(0, 4), Label::Free);
    assert!(lone.said.iter().any(|m| matches!(m, Message::Spent(s) if s.sectors == [4, 4])));
}

#[test]
fn a_robot_that_holds_at_a_node_thinks_again_and_one_that_holds_on_its_way_goes_on() {
    let mut lone = lone();
    lone.see(point(0.0, 0.0), true, Some("5555!55555555!5555"));
    let first = lone.announce();
    let stay = lone.follow_ruling(true);
    assert!(stay.hold && !stay.scan && stay.to == point(0.0, 0.0));
    lone.see(point(0.0, 0.0), true, None);
    lone.robot.hear(&Message::Pose { robot: 1, at: point(0.0, 5.0) });
    let second = lone.announce();
    assert_ne!(first.to, second.to, "another robot has come near");

    lone.follow_ruling(false);
    lone.see(point(0.0, -0.4), false, None);
    assert_eq!(lone.announce().to, second.to);
    assert_eq!(lone.follow_ruling(true).to, point(0.0, -0.4));
    // It has arrived where it holds, which is no node.
    lone.see(point(0.0, -0.4), true, None);
    assert_eq!(lone.announce().to, second.to);
    assert!(lone.follow_ruling(false).scan);
    lone.see(second.to, true, Some(CELL));
    assert_eq!(lone.robot.node(), Some(id(0, 1)));
}

#[test]
fn without_a_scan_or_a_pose_it_knows_nothing_new_and_asks_again() {
    let mut lone = lone();
    lone.see(point(0.0, 0.0), true, None);
    assert_eq!(lone.announce().purpose, Purpose::Wait);
    assert!(lone.follow_ruling(false).scan);
    lone.see(point(0.0, 0.0), true, Some("5555!5555555555555"));
    let out = lone.announce();
    lone.follow_ruling(false);
    lone.see(point(f32::NAN, 0.0), true, Some(CELL));
    lone.see(out.to, true, None);
    assert_eq!((lone.ssg.len(), lone.announce().to), (1, out.to));
    assert!(lone.follow_ruling(false).scan);
}

#[test]
fn when_the_store_is_full_frontiers_are_left_and_all_fly_home() {
    let mut lone = Lone::new(ExploreParams { nodes_max: 4, ..ExploreParams::default() });
    lone.see(point(0.0, 0.0), true, Some("5555!5555555555555"));
    for number in 1..=2 {
        let out = lone.announce();
        assert_eq!(out.purpose, Purpose::Explore);
        lone.follow_ruling(false);
        lone.see(out.to, true, Some("5555!5555555555555"));
        assert_eq!(lone.robot.node(), Some(id(0, number)));
    }
    assert!(lone.ssg.is_full() && lone.ssg.has_hubs());
    assert_eq!(lone.announce().purpose, Purpose::Home);
    // Others have filled it meanwhile: no room where this one arrives, so it turns back.
    let mut late = Lone::new(ExploreParams { nodes_max: 4, ..ExploreParams::default() });
    late.see(point(0.0, 0.0), true, Some("5555!5555555555555"));
    let out = late.announce();
    late.follow_ruling(false);
    for number in 0..3 {
        late.ssg.apply(&node(id(1, number), point(9.0, 0.0), None, CELL)).unwrap();
    }
    late.see(out.to, true, Some(CELL));
    let back = late.announce();
    assert_eq!((back.purpose, back.to), (Purpose::Backtrack, point(0.0, 0.0)));
    late.follow_ruling(true);
    late.see(out.to, true, None);
    assert_eq!(late.announce().to, point(0.0, 0.0));
    late.follow_ruling(false);
    late.see(point(0.0, 0.0), true, None);
    assert_eq!(late.announce().purpose, Purpose::Park);
}

#[test]
fn a_scan_of_another_size_and_a_robot_of_another_team_are_errors() {
    let mut lone = lone();
    let seen = Observation { pose: Pose::default(), arrived: true, scan: Some(&[None; 3]) };
    let wrong = lone.robot.perceive(&mut lone.ssg, &seen, &mut lone.said);
    assert_eq!(wrong, Err(Refusal::Sectors { got: 3, want: 18 }));
    let seen = Observation { pose: Pose::default(), arrived: true, scan: Some(&[None; 18]) };
    let stranger = Explorer::new(7, 2).perceive(&mut lone.ssg, &seen, &mut lone.said);
    assert_eq!(stranger, Err(Refusal::Stranger { robot: 7, robots: 2 }));
}

#[test]
fn what_it_hears_of_itself_or_of_nobody_changes_nothing() {
    let mut lone = Lone::new(ExploreParams { strategy: StrategyKind::SRG, ..ExploreParams::default() });
    let target = Target {
        robot: 0,
        purpose: Purpose::Explore,
        hub: None,
        from: Point::default(),
        to: Point::default(),
        level: 1,
    };
    let bad = Target { robot: 1, to: point(f32::NAN, 0.0), ..target };
    for message in
        [Message::Target(target), Message::Target(bad), Message::Pose { robot: 9, at: Point::default() }]
    {
        lone.robot.hear(&message);
    }
    assert!(lone.robot.mates.iter().all(|mate| *mate == Mate::default()));
    // Nothing announced: nothing flown.
    assert!(lone.robot.resolve(&lone.params).hold);
}
