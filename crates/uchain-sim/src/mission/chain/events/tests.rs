use uchain_core::chain::{Doing, LaunchHold, Override, PendingLaunch, WallSide, Walls};

use super::*;
use crate::{config::builtin, record::Recorder, run::run};

fn course(name: &str, sets: &[&str]) -> std::sync::Arc<Course> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Course::read(&builtin(name).unwrap(), &sets).unwrap()
}

/// Keeps what happened.
struct Kept(Events, Vec<Event>);

impl Recorder<Frame> for Kept {
    fn frame(&mut self, frame: &Frame) -> Result<(), crate::record::RecordError> {
        self.1.extend_from_slice(self.0.update(frame));
        Ok(())
    }
}

fn flown(course: &std::sync::Arc<Course>, seed: u64) -> Vec<Event> {
    let mut kept = Kept(Events::new(course), Vec::new());
    run(course, seed, &mut kept).unwrap();
    kept.1
}

/// What happened to the head in ten minutes on the ground that are made up, at five decisions a second.
fn made_up(doing: impl Fn(u64) -> Option<Doing>) -> Vec<Event> {
    let course = course("corner", &[]);
    let mut events = Events::new(&course);
    let mut all = Vec::new();
    let uav = UavFrame {
        x_m: 0.0,
        y_m: 0.0,
        heading_rad: 0.0,
        forward_mps: 0.0,
        lateral_mps: 0.0,
        yaw_rate_radps: 0.0,
        airborne: false,
        wall_contacts: 0,
        uav_contacts: 0,
        tof: None,
        doing: None,
    };
    for decision in 0..3_000 {
        let uavs = vec![UavFrame { doing: doing(decision), ..uav }];
        let frame = Frame { tick: 4 * decision + 1, decision: true, uavs, ..Frame::default() };
        all.extend_from_slice(events.update(&frame));
    }
    all
}

fn kinds(events: &[Event]) -> Vec<&str> {
    events.iter().map(|event| event.kind).collect()
}

#[test]
fn a_head_that_is_stopped_by_its_link_says_so_with_the_numbers_and_that_it_is_over() {
    let events = flown(&course("corner", &[]), 1);
    let head_stop = |kind: &str| {
        let of = |event: &&Event| event.kind == kind && event.text.contains("(head-stop)");
        events.iter().find(of).unwrap_or_else(|| panic!("no {kind} among {:?}", kinds(&events)))
    };
    let (begins, ends) = (head_stop("override-begins"), head_stop("override-ends"));
    assert!(begins.tick < ends.tick && begins.robot == Some(0) && ends.robot == Some(0));
    assert!(
        begins.text.contains("reads 70.") && begins.text.ends_with("link.head_stop_db = 70"),
        "{begins:?}"
    );
    // Every launch was armed before.
    for launch in events.iter().filter(|event| event.kind == "took-off" && event.robot != Some(0)) {
        let armed = |event: &&Event| event.kind == "launch-armed" && event.robot == launch.robot;
        let armed_s = events.iter().filter(armed).map(Event::time_s).next_back().unwrap();
        assert!((1.0..=1.2).contains(&(launch.time_s() - armed_s)), "{armed_s} {launch:?}");
    }
}

#[test]
fn where_nothing_is_in_the_way_nothing_is_overridden() {
    let events = flown(&course("corner", &["link.head_stop_db=150", "link.head_back_db=151"]), 1);
    assert!(!kinds(&events).contains(&"override-begins"), "{events:?}");
}

#[test]
fn a_launch_that_waits_for_a_levelled_chain_says_so() {
    let events = flown(&course("corner", &["takeoff.launch=converged", "takeoff.converged_db=0.2"]), 1);
    let held = events.iter().find(|event| event.kind == "launch-held").expect("a launch is held");
    assert!(held.text.ends_with("the chain has not levelled to takeoff.converged_db = 0.2 yet"), "{held:?}");
}

#[test]
fn what_flickers_at_every_decision_does_not_flood_the_log() {
    let odd = |decision: u64| !decision.is_multiple_of(2);
    let retreat = |overridden| Some(Doing { overridden, walls: Some(Walls::Both), ..Doing::default() });
    let on_and_off = made_up(|decision| retreat(odd(decision).then_some(Override::Retreat)));
    assert_eq!(kinds(&on_and_off), ["override-begins"]);
    let walls = |decision| if odd(decision) { Walls::Left } else { Walls::Both };
    let beams = made_up(|decision| Some(Doing { walls: Some(walls(decision)), ..Doing::default() }));
    assert_eq!(kinds(&beams), [""; 0], "a beam that sees nothing now and then");
    let pushed = made_up(|decision| {
        Some(Doing { pushed_by: odd(decision).then_some(WallSide::Left), ..Doing::default() })
    });
    assert_eq!(kinds(&pushed), ["override-begins"]);
    let launch = |decision| PendingLaunch { loss_db: 61.0, held: odd(decision).then_some(LaunchHold::Ahead) };
    let launches = made_up(|decision| Some(Doing { launch: Some(launch(decision)), ..Doing::default() }));
    assert!((300..=600).contains(&launches.len()), "one a second at most: {}", launches.len());
    // The control: one that lasts is told, and so is its end.
    let lasts = |decision: u64| (500..1_000).contains(&decision);
    let all = made_up(|decision| {
        let lasts = lasts(decision);
        let walls = Some(if lasts { Walls::Right } else { Walls::Both });
        let overridden = lasts.then_some(Override::BackLost);
        let launch = lasts.then_some(PendingLaunch { loss_db: 61.0, held: Some(LaunchHold::Silent) });
        Some(Doing { overridden, walls, launch, ..Doing::default() })
    });
    let expected =
        ["override-begins", "launch-held", "wall-invalid", "override-ends", "wall-valid", "launch-disarmed"];
    assert_eq!(kinds(&all), expected);
    assert!(all[3].text.ends_with("no longer overridden (back-lost), after 99.8 s"), "{}", all[3].text);
}

#[test]
fn who_does_not_say_what_it_is_about_has_no_such_events() {
    assert_eq!(made_up(|_| None), []);
    let stops = |decision: u64| {
        (decision < 100).then(|| Doing { overridden: Some(Override::HeadStop), ..Doing::default() })
    };
    assert_eq!(kinds(&made_up(stops)), ["override-begins"], "nobody says that it is over");
}
