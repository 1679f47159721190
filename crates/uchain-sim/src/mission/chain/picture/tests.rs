use super::*;
use crate::{
    analyse::{Outcome, Verdict},
    config::builtin,
    draw::said::{self, Said},
    mission::chain::{Frame, LinkFrame, LinkSummary, UavFrame},
};

fn course(sets: &[&str]) -> std::sync::Arc<Course> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Course::read(&builtin("straight").unwrap(), &sets).unwrap()
}

/// A chain that spreads evenly behind a head at 0.2 m/s; a made-up loss.
fn flight(course: &Course, seconds: u64) -> (History, Summary) {
    flight_of(course, course.scenario.chain.uavs, 12.0, seconds)
}

/// The same with so many UAVs, one launched every so many seconds.
fn flight_of(course: &Course, n: usize, every_s: f32, seconds: u64) -> (History, Summary) {
    let frames = (0..5 * seconds).map(|k| {
        let time_s = k as f32 / 5.0;
        let flying = (1 + (time_s / every_s) as usize).min(n);
        let reach_m = 0.2 * time_s.min(55.0);
        let uav = |i: usize| UavFrame {
            x_m: if i < flying { reach_m * (flying - i) as f32 / flying as f32 } else { 0.1 },
            y_m: 0.1 * (i as f32 - 1.0),
            heading_rad: 0.0,
            forward_mps: 0.2,
            lateral_mps: 0.0,
            yaw_rate_radps: 0.0,
            airborne: i < flying,
            wall_contacts: 0,
            uav_contacts: 0,
            tof: None,
            doing: None,
        };
        let link = |i: usize| LinkFrame {
            uav: i,
            true_db: 40.0 + 6.0 * reach_m / flying as f32 + i as f32,
            raw_db: Some(39.0 + 6.0 * reach_m / flying as f32 + (k * 11 % 7) as f32),
            silence: None,
            filtered_db: (k % 50 != 0).then_some(41.0 + 6.0 * reach_m / flying as f32 + (k * 7 % 5) as f32),
        };
        Frame {
            tick: 4 * k,
            decision: true,
            uavs: (0..n).map(uav).collect(),
            leader: 0,
            links: (0..flying).map(link).collect(),
            head_reach_m: reach_m,
            head: None,
            input: None,
        }
    });
    let history = History { frames: frames.collect() };
    let flown = history.frames.last().map_or(0, |frame| frame.links.len());
    let summary = Summary {
        scenario: course.scenario.name.clone(),
        seed: 1,
        sim_s: seconds as f64,
        verdict: Verdict::new(Outcome::NeverFlew, Vec::new(), Vec::new()),
        launches_s: (0..flown).map(|i| f64::from(every_s) * i as f64).collect(),
        uavs: flown,
        relays_used: flown.saturating_sub(1),
        relays_needed: None,
        bottleneck_gap_db: None,
        links: vec![LinkSummary { uav: 0, true_db: 50.0, filtered_db: None }; flown],
        spread_db: Some(2.3),
        worst_link_db: None,
        converged_s: None,
        wall_contacts: 0,
        uav_contacts: 0,
        connected_fraction: Some(1.0),
        below_limit_fraction: Some(1.0),
        head_reach_m: 11.0,
        head_flown_m: 11.2,
        digest: "0".repeat(16),
    };
    (history, summary)
}

/// Width and height from a PNG's header.
fn size(png: &[u8]) -> (u32, u32) {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn a_run_is_one_page_1400_px_wide() {
    let course = course(&[]);
    let (history, summary) = flight(&course, 120);
    let png = run_png(&course, &history, &summary).unwrap();
    let (width, height) = size(&png);
    assert_eq!(width, 1400);
    assert!((700..2000).contains(&height), "{height}");
}

#[test]
fn nothing_flown_and_broken_numbers_still_give_a_page() {
    let course = course(&["chain.uavs=30", "chain.spacing_m=0.15"]);
    let (mut history, summary) = flight(&course, 400);
    for frame in &mut history.frames {
        frame.uavs[3].x_m = f32::NAN;
        frame.links[0].true_db = f32::INFINITY;
    }
    run_png(&course, &history, &summary).unwrap();
    let nothing = Summary { launches_s: Vec::new(), links: Vec::new(), sim_s: 0.0, ..summary };
    run_png(&course, &History::default(), &nothing).unwrap();
}

#[test]
fn a_plan_is_one_page_even_where_there_is_nothing_to_plan_or_no_way() {
    let course = course(&["takeoff.s_min_db=36", "pilot.0.speed_mps=0"]);
    let mut plan = crate::mission::chain::plan(&course, None, 1.0, None).unwrap();
    let answer = "twelve words, of which some go to a second line of the page ".repeat(3);
    assert_eq!(size(&plan_png(&course, &plan, &answer).unwrap()).0, 1400);
    plan.rows.iter_mut().for_each(|row| (row.relays_needed, row.bottleneck_db) = (None, Some(f64::INFINITY)));
    plan_png(&course, &plan, "").unwrap();
    plan.rows.clear();
    plan_png(&course, &plan, "").unwrap();
}

#[test]
fn a_metre_is_as_long_across_as_up() {
    let course = course(&[]);
    let (history, summary) = flight(&course, 120);
    for panel in Tunnel::new(&course, &history, &summary).panels(100.0) {
        let ((x0, y0), (x1, y1)) = (panel.at(0.0, 0.0), panel.at(1.0, 1.0));
        assert!(((x1 - x0) - (y0 - y1)).abs() < 1e-9);
    }
}

/// Boxes of losses, and maps.
fn boxes(course: &Course, history: &History, summary: &Summary) -> (Vec<Said>, Vec<Said>) {
    said::boxes(&run_scene(course, history, summary)).into_iter().partition(|one| !one.is_map)
}

#[test]
fn above_six_uavs_losses_have_small_boxes_of_at_most_six_lines() {
    let course = course(&[]);
    for n in [1, 6, 7, 8, 24, 25, 144, 145, 400] {
        let (mut history, summary) = flight_of(&course, n, 0.1, 60);
        let links = history.frames.iter_mut().flat_map(|frame| &mut frame.links);
        links.for_each(|link| link.filtered_db = Some(link.true_db));
        let (losses, _) = boxes(&course, &history, &summary);
        let lines: Vec<usize> = losses.iter().map(|one| one.lines(2.0)).collect();
        let names: Vec<usize> = losses.iter().map(|one| one.names("UAV").len()).collect();
        assert_eq!(lines, names, "every line has its name, {n} UAVs");
        assert!(lines.iter().all(|lines| (1..=6).contains(lines)), "{n} UAVs: {lines:?}");
        let shown: usize = lines.iter().sum();
        match n {
            ..=6 => assert_eq!(lines, [n]),
            7..=24 => assert_eq!(lines, vec![1; n]),
            25..=144 => assert_eq!(shown, n),
            _ => {
                let left_out =
                    losses.iter().flat_map(|one| &one.after).any(|words| words.contains("th is shown"));
                assert!(left_out && (60..=144).contains(&shown), "{n} UAVs: {shown}");
            }
        }
    }
}

#[test]
fn the_number_of_every_uav_stands_on_the_map() {
    let course = course(&[]);
    for (every_s, n) in [(2.0, 8), (12.0, 8), (0.1, 40), (500.0, 120)] {
        let (mut history, summary) = flight_of(&course, n, every_s, 60);
        let numbers = |history: &History| {
            let (_, maps) = boxes(&course, history, &summary);
            assert!(!maps.is_empty());
            maps.iter().map(Said::numbers).collect::<Vec<_>>()
        };
        for all in numbers(&history) {
            assert_eq!(all, (0..n).collect::<Vec<_>>());
        }
        // Who is nowhere has no dot and no number.
        history.frames.last_mut().unwrap().uavs[3].x_m = f32::NAN;
        for all in numbers(&history) {
            assert!(!all.contains(&3) && all.len() == n - 1, "{all:?}");
        }
    }
}

#[test]
fn the_whole_tunnel_is_shown_and_a_small_part_of_it_once_more() {
    let course = course(&[]);
    let (low, high) = course.map.bounds();
    for seconds in [1, 60] {
        let (history, summary) = flight(&course, seconds);
        let panels = Tunnel::new(&course, &history, &summary).panels(0.0);
        let (least, most) = panels[0].ranges();
        assert!(
            least.0 < low.x.into()
                && least.1 < low.y.into()
                && most.0 > high.x.into()
                && most.1 > high.y.into()
        );
        assert_eq!(panels.len(), if seconds == 1 { 2 } else { 1 });
    }
}

#[cfg(feature = "sweep")]
#[test]
fn true_filtered_and_raw_losses_look_the_same_in_a_run_and_in_a_figure() {
    use crate::draw::figure::{self, Axes, Figure, Known, Mark};

    let course = course(&[]);
    let (history, summary) = flight_of(&course, 2, 10.0, 60);
    let (losses, _) = boxes(&course, &history, &summary);
    let mark =
        |uav, known| Mark::Loss { name: String::new(), uav, known, points: vec![(0.0, 50.0), (9.0, 60.0)] };
    let all = [Known::Raw, Known::Filtered, Known::True];
    let marks = all.into_iter().flat_map(|known| [1, 0].map(|uav| mark(uav, known))).collect();
    let drawn = Figure { title: String::new(), axes: vec![Axes { marks, ..Axes::default() }] };
    let figure = said::boxes(&figure::scene(&drawn));
    let mut of_the_run = losses[0].styles.clone();
    // A line with gaps is drawn in parts.
    of_the_run.dedup();
    assert_eq!(of_the_run, figure[0].styles);
    let kinds: Vec<&str> = figure[0].styles.iter().map(|style| style.0).collect();
    assert_eq!(kinds, ["dots", "dots", "line", "line", "dashes", "dashes", "dashes", "dashes"]);
    assert_eq!(
        figure[0].after.iter().filter(|name| name.starts_with("UAV")).count(),
        2,
        "each is named once"
    );
}
