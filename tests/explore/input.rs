//! Whatever a scan, a localisation or another robot may say, an explorer goes on, and asks for nothing odd.

use proptest::prelude::*;
use uchain_core::explore::{
    EdgeRule, ExploreParams, Explorer, Label, Message, NodeId, NodeReport, Observation, Point, Pose, Purpose,
    Sector, SpentReport, Ssg, StrategyKind as Chooser, Target,
};

/// Any float, or one as robots use them.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![any::<f32>(), -2.0..2.0_f32, Just(0.0)]
}

fn point() -> impl Strategy<Value = Point> {
    (number(), number()).prop_map(|(x_m, y_m)| Point { x_m, y_m })
}

fn id() -> impl Strategy<Value = NodeId> {
    (0..4_u16, prop_oneof![0..3_u32, any::<u32>()]).prop_map(|(robot, number)| NodeId { robot, number })
}

fn node() -> impl Strategy<Value = Message> {
    let label = prop_oneof![Just(Label::Obstacle), Just(Label::Free), Just(Label::Frontier)];
    let sectors =
        prop::collection::vec((label, number()).prop_map(|(label, r_m)| Sector { label, r_m }), 17..=18);
    (id(), point(), prop::option::of(id()), sectors)
        .prop_map(|(id, at, flown_from, sectors)| Message::Node(NodeReport { id, at, flown_from, sectors }))
}

fn target() -> impl Strategy<Value = Message> {
    let purpose = prop_oneof![Just(Purpose::Explore), Just(Purpose::Park)];
    (any::<u16>(), purpose, prop::option::of(id()), point(), point(), any::<u16>()).prop_map(
        |(robot, purpose, hub, from, to, level)| {
            Message::Target(Target { robot: robot % 5, purpose, hub, from, to, level })
        },
    )
}

fn message() -> impl Strategy<Value = Message> {
    prop_oneof![
        node(),
        target(),
        (0..5_u16, point()).prop_map(|(robot, at)| Message::Pose { robot, at }),
        (id(), any::<[u16; 2]>()).prop_map(|(node, sectors)| Message::Spent(SpentReport { node, sectors })),
    ]
}

/// One instant: what it hears, where it is, whether it has arrived, what it scans.
fn instant() -> impl Strategy<Value = (Vec<Message>, Point, f32, bool, Vec<Option<f32>>)> {
    let returns = prop::collection::vec(prop::option::of(number()), 18);
    (prop::collection::vec(message(), 0..6), point(), number(), any::<bool>(), returns)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn commands_are_finite_and_memory_is_bounded_whatever_comes_in(
        instants in prop::collection::vec(instant(), 1..20), strategy in 0..3_usize, eq8 in any::<bool>(),
        arc_ends in any::<bool>(), draws in any::<u32>(),
    ) {
        let params = ExploreParams {
            strategy: [Chooser::CSSG, Chooser::CSSG_RANDOM, Chooser::SRG][strategy],
            edges: if eq8 { EdgeRule::Eq8 } else { EdgeRule::Visible },
            arc_ends,
            nodes_max: 40,
            ..ExploreParams::default()
        };
        let mut ssg = Ssg::new(params.clone(), 3).unwrap();
        let mut robot = Explorer::new(1, 3);
        let mut said = Vec::new();
        for (heard, at, heading_rad, arrived, scan) in instants {
            for message in &heard {
                robot.hear(message);
                let _ = ssg.apply(message);
            }
            let seen = Observation { pose: Pose { at, heading_rad }, arrived, scan: Some(&scan) };
            let _ = robot.perceive(&mut ssg, &seen, &mut said);
            let target = robot.announce(&mut ssg, &mut || draws, &mut said);
            prop_assert!(target.from.is_sound() && target.to.is_sound());
            let command = robot.resolve(&params);
            prop_assert!(command.to.is_sound() && command.heading_rad.is_finite() && command.z_m.is_finite());
            prop_assert!(ssg.len() <= 40);
        }
    }
}
