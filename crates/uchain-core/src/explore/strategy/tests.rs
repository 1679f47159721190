use alloc::{string::String, vec, vec::Vec};
use core::f32::consts::PI;

use proptest::prelude::*;

use super::Strategy;
use super::*;
use crate::explore::{
    Message, NodeReport, Purpose,
    ssg::tests::{id, node, point},
};

/// What a strategy makes of it from slot 0, for robot 0 of three.
pub(super) struct Scene {
    pub(super) ssg: Ssg,
    heading_rad: f32,
    mates: Vec<Mate>,
    pub(super) previous: Option<NodeId>,
    draws: Vec<u32>,
}

impl Scene {
    pub(super) fn new(params: ExploreParams, signs: &str) -> Self {
        let mut ssg = Ssg::new(params, 3).unwrap();
        ssg.apply(&node(id(0, 0), point(0.0, 0.0), None, signs)).unwrap();
        Self { ssg, heading_rad: 0.0, mates: vec![Mate::default(); 3], previous: None, draws: vec![] }
    }

    pub(super) fn heading(mut self, heading_deg: f32) -> Self {
        self.heading_rad = heading_deg.to_radians();
        self
    }

    pub(super) fn mate(mut self, robot: usize, at: Point, flies_to: Option<Point>) -> Self {
        let fly = |to| {
            let (robot, purpose, hub) = (robot as u16, Purpose::Explore, None);
            Target { robot, purpose, hub, from: at, to, level: 1 }
        };
        self.mates[robot] = Mate { at: Some(at), target: flies_to.map(fly) };
        self
    }

    fn view<T>(&mut self, look: impl FnOnce(&mut View<'_>) -> T) -> T {
        let mut routes = Dijkstra::default();
        let draws = &mut self.draws;
        look(&mut View {
            ssg: &self.ssg,
            robot: 0,
            here: 0,
            pose: Pose { at: point(0.0, 0.0), heading_rad: self.heading_rad },
            mates: &self.mates,
            previous: self.previous,
            routes: &mut routes,
            draw: &mut || draws.pop().unwrap_or(0),
        })
    }

    pub(super) fn goal(&mut self) -> Goal {
        let params = self.ssg.params();
        let mut strategy = params.strategy.make(params);
        self.view(|view| strategy.goal(view))
    }

    /// Direction of the frontier that is chosen, in degrees.
    pub(super) fn chosen_deg(&mut self) -> f32 {
        let Goal::Frontier(candidate) = self.goal() else { panic!("{:?}", self.goal()) };
        libm::roundf(candidate.direction_rad.to_degrees())
    }
}

fn scene(signs: &str) -> Scene {
    Scene::new(ExploreParams::default(), signs)
}

#[test]
fn alone_the_wider_frontier_is_chosen_then_the_least_turn_then_the_lowest_sector() {
    assert_eq!(scene("5!5!!5555555555555").heading(30.0).chosen_deg(), 80.0);
    assert_eq!(scene("5!5!55555555555555").heading(50.0).chosen_deg(), 30.0);
    assert_eq!(scene("5!5!55555555555555").heading(60.0).chosen_deg(), 70.0);
    assert_eq!(scene("5!555555555555555!").heading(-15.0).chosen_deg(), 350.0);
    assert_eq!(scene("5!5!55555555555555").heading(f32::NAN).chosen_deg(), 30.0);
}

#[test]
fn with_frontiers_all_around_it_goes_straight_on() {
    let mut all = scene("!!!!!!!!!!!!!!!!!!").heading(-37.0);
    let Goal::Frontier(candidate) = all.goal() else { panic!() };
    assert_eq!(candidate.sectors, [16, 16]);
    assert!(candidate.at.distance_m(point(0.8 * 0.798_636, -0.8 * 0.601_815)) < 1e-5);
}

#[test]
fn a_robot_flies_where_the_others_are_not() {
    let east_or_west = "!555555!!!!555555!";
    assert_eq!(scene(east_or_west).heading(0.0).chosen_deg(), 180.0, "the wider one");
    assert_eq!(scene(east_or_west).mate(1, point(-2.0, 0.0), None).chosen_deg(), 0.0);
    assert_eq!(scene(east_or_west).mate(1, point(2.0, 0.0), None).chosen_deg(), 180.0);
}

#[test]
fn of_two_robots_at_one_node_the_second_takes_what_the_first_has_left_if_it_heeds_it() {
    let chosen_deg = |taken, signs| {
        let mut scene = Scene::new(ExploreParams { taken, ..ExploreParams::default() }, signs);
        let first = scene.view(|view| view.merged().max_by_key(|c| c.run.count).unwrap());
        let mut scene = scene.mate(1, point(0.0, 0.0), Some(first.at));
        // A hub elsewhere: a corner of the same room.
        scene.ssg.apply(&node(id(0, 1), point(0.2, 0.0), Some(id(0, 0)), "555555555!55555555")).unwrap();
        match scene.goal() {
            Goal::Frontier(candidate) => Some(libm::roundf(candidate.direction_rad.to_degrees())),
            _ => None,
        }
    };
    let (two, one) = ("555!!!5555555!5555", "555!!!555555555555");
    assert_eq!(chosen_deg(Taken::Ignored, two), Some(90.0));
    assert_eq!(chosen_deg(Taken::Counted, two), Some(270.0));
    assert_eq!(chosen_deg(Taken::Left, two), Some(270.0));
    assert_eq!(chosen_deg(Taken::Counted, one), Some(90.0));
    assert_eq!(chosen_deg(Taken::Left, one), None, "there is another hub");
    // Without one it goes along.
    let at = |scene: &mut Scene| scene.view(|view| view.merged().next().unwrap().at);
    let to = at(&mut scene(one));
    assert_eq!(scene(one).mate(1, point(0.0, 0.0), Some(to)).chosen_deg(), 90.0);
}

#[test]
fn a_random_frontier_sector_is_any_of_them_alike() {
    let params = ExploreParams { strategy: StrategyKind::CSSG_RANDOM, ..ExploreParams::default() };
    let mut scene = Scene::new(params, "5!!555555555!55555");
    let mut drawn = |bits| {
        scene.draws = vec![bits];
        scene.chosen_deg()
    };
    let third = u32::MAX / 3;
    let all = [0, third - 9, third + 9, 2 * third - 9, 2 * third + 9, u32::MAX].map(&mut drawn);
    assert_eq!(all, [30.0, 30.0, 50.0, 50.0, 250.0, 250.0]);
}

#[test]
fn random_robots_leave_to_one_another_what_they_have_announced_if_robots_do() {
    for strategy in [StrategyKind::CSSG_RANDOM, StrategyKind::SRG] {
        let chosen_deg = |taken, signs, hub: bool| {
            let mut scene = Scene::new(ExploreParams { strategy, taken, ..ExploreParams::default() }, signs);
            // Another robot at the same node has announced the first of its sectors.
            let place = |view: &mut View<'_>| view.candidate(Run { first: 1, count: 1 }).unwrap().at;
            let first = scene.view(place);
            let mut scene = scene.mate(1, point(0.0, 0.0), Some(first));
            if hub {
                let report = node(id(0, 1), point(0.2, 0.0), Some(id(0, 0)), "555555555!55555555");
                scene.ssg.apply(&report).unwrap();
            }
            let mut drawn = |bits| {
                scene.draws = vec![bits];
                match scene.goal() {
                    Goal::Frontier(candidate) => Some(libm::roundf(candidate.direction_rad.to_degrees())),
                    _ => None,
                }
            };
            [0, u32::MAX].map(&mut drawn)
        };
        let (two, one) = ("5!!555555555555555", "5!5555555555555555");
        for taken in [Taken::Ignored, Taken::Counted] {
            assert_eq!(chosen_deg(taken, two, true), [Some(30.0), Some(50.0)], "the control");
            assert_eq!(chosen_deg(taken, one, true), [Some(30.0); 2], "the control");
        }
        assert_eq!(chosen_deg(Taken::Left, two, true), [Some(50.0); 2]);
        assert_eq!(chosen_deg(Taken::Left, one, true), [None; 2], "there is another hub");
        assert_eq!(chosen_deg(Taken::Left, one, false), [Some(30.0); 2], "rather together than not at all");
    }
}

/// Robot 0 in a dead end; nodes around it by their robot, place and whether they have a frontier.
fn dead_end(around: &[(NodeId, [f32; 2], bool)]) -> Scene {
    let mut scene = scene("999999999999999999");
    for &(id, [x_m, y_m], hub) in around {
        // Frontiers lie away from where the robot is, so that its star does not cover them.
        let away = scene.ssg.cones().facing(point(0.0, 0.0), point(x_m, y_m));
        let signs: String = (0..18).map(|k| if hub && k == away { '!' } else { '9' }).collect();
        scene.ssg.apply(&node(id, point(x_m, y_m), None, &signs)).unwrap();
    }
    scene
}

#[test]
fn the_nearest_own_hub_goes_before_a_nearer_one_of_another_robot() {
    let mut both = dead_end(&[(id(1, 0), [0.3, 0.0], true), (id(0, 1), [-0.7, 0.0], true)]);
    assert_eq!(both.goal(), Goal::Node(2));
    let mut others = dead_end(&[(id(2, 0), [0.5, 0.0], true), (id(1, 0), [-0.3, 0.0], true)]);
    assert_eq!(others.goal(), Goal::Node(2));
    assert_eq!(dead_end(&[(id(1, 0), [0.3, 0.0], false)]).goal(), Goal::Home);
}

#[test]
fn of_hubs_equally_far_the_previous_one_counts_then_the_lowest_node() {
    let tied = [(id(1, 3), [0.6, 0.0], true), (id(1, 1), [-0.6, 0.0], true), (id(1, 2), [0.0, 0.6005], true)];
    assert_eq!(dead_end(&tied).goal(), Goal::Node(2));
    let mut previous = dead_end(&tied);
    previous.previous = Some(id(1, 2));
    assert_eq!(previous.goal(), Goal::Node(3));
    previous.previous = Some(id(2, 7));
    assert_eq!(previous.goal(), Goal::Node(2));
}

#[test]
fn a_hub_that_no_way_leads_to_does_not_count() {
    let far = (id(1, 0), [5.0, 0.0], true);
    assert_eq!(dead_end(&[far]).goal(), Goal::Home);
    let mut beside = dead_end(&[far, (id(2, 0), [0.0, 0.8], true)]);
    assert_eq!(beside.goal(), Goal::Node(2));
}

proptest! {
    /// Eq. 7 written out in f64, over sectors instead of runs.
    #[test]
    fn the_chosen_place_is_the_best_of_all_by_eq_7(
        frontiers in prop::collection::vec(any::<bool>(), 18), heading_rad in -PI..PI,
        others in prop::collection::vec((-3.0..3.0_f32, -3.0..3.0_f32), 2),
    ) {
        prop_assume!(frontiers.contains(&true) && frontiers.contains(&false));
        let signs: String = frontiers.iter().map(|&f| if f { '!' } else { '5' }).collect();
        let mut scene = scene(&signs);
        scene.heading_rad = heading_rad;
        for (i, &(x_m, y_m)) in others.iter().enumerate() {
            scene = scene.mate(i + 1, point(x_m, y_m), None);
        }
        let Goal::Frontier(chosen) = scene.goal() else { panic!() };
        let objective = |half: usize| {
            let angle = (half as f64 * 10.0).to_radians();
            let (x, y) = (0.8 * libm::cos(angle), 0.8 * libm::sin(angle));
            others.iter().map(|&(ox, oy)| libm::hypot(f64::from(ox) - x, f64::from(oy) - y)).sum::<f64>()
        };
        // All (first sector, count) whose sectors are frontiers and whose neighbours are none.
        let runs = (0..18).flat_map(|first| (1..18).map(move |count| (first, count))).filter(|&(first, count)| {
            let inside = (first..first + count).all(|k| frontiers[k % 18]);
            inside && !frontiers[(first + 17) % 18] && !frontiers[(first + count) % 18]
        });
        let rated: Vec<(f64, usize, usize)> =
            runs.map(|(first, count)| (objective((2 * first + count) % 36), count, first)).collect();
        let best = rated.iter().map(|r| r.0).fold(f64::MIN, f64::max);
        let own = rated.iter().find(|r| r.2 == chosen.run.first).unwrap();
        prop_assert_eq!(own.1, chosen.run.count);
        prop_assert!(best - own.0 <= 0.001 + 1e-5, "{} of {}", own.0, best);
        let wider = rated.iter().filter(|r| best - r.0 < 0.001 - 1e-5).all(|r| r.1 <= own.1);
        prop_assert!(wider, "of equal ones the widest");
    }

    #[test]
    fn any_pose_and_any_team_give_a_finite_goal(
        heading_rad in any::<f32>(), x_m in any::<f32>(), y_m in any::<f32>(), to_m in any::<f32>(),
        radius_m in prop::collection::vec(prop::option::of(any::<f32>()), 18),
    ) {
        let mut scene = scene("555555555555555555").mate(1, point(x_m, y_m), Some(point(to_m, x_m)));
        scene.heading_rad = heading_rad;
        let sectors = radius_m.iter().map(|&m| Sector::of(m, 1.0)).collect();
        let report = NodeReport { id: id(0, 1), at: point(0.1, 0.0), flown_from: None, sectors };
        scene.ssg.apply(&Message::Node(report)).unwrap();
        let chosen = scene.view(|view| {
            view.here = 1;
            Cssg.goal(view)
        });
        if let Goal::Frontier(candidate) = chosen {
            prop_assert!(candidate.at.is_sound() && candidate.direction_rad.is_finite());
        }
    }
}
