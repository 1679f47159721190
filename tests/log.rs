//! A log made of what a simulated UAV saw: the node that is fed with it asks for what the simulated one asked for.

use std::{fmt::Write as _, sync::Arc};

use uchain_core::chain::{Follow, Heard, Observation, Packet};
use uchain_sim::{
    clock::time_s,
    log::{Replay, Settings},
    mission::{
        Mission as _,
        chain::{Chain, Course},
    },
};

use crate::course;

const HEADER: &str = "time_s,place,tof_nw_m,tof_ne_m,tof_sw_m,tof_se_m,ground_speed_mps,pilot_speed_mps,pilot_follow,\
                      back_loss_db,back_ground_speed_mps,back_is_base,front_loss_db,front_ground_speed_mps,front_flown_s,\
                      front_follow,front_imbalance_db,asked_forward_mps,asked_lateral_mps,asked_yaw_rate_radps\n";

fn cell<T: ToString>(value: Option<T>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

fn word(follow: Follow) -> String {
    format!("{follow:?}").to_lowercase()
}

/// What a UAV saw in a tick, as a drone would log it with all digits.
fn row(tick: u64, place: u16, seen: &Observation) -> String {
    let radio = seen.radio.clone().unwrap_or_default();
    let (back, front) = (radio.back(place).copied(), radio.front(place).copied());
    let is_uav = |heard: &Heard| heard.packet.place != Packet::BASE_PLACE;
    let tof = |beam: fn(&uchain_core::chain::Tof) -> f32| cell(seen.tof.as_ref().map(beam));
    let cells = [
        time_s(tick).to_string(),
        cell(seen.place),
        tof(|tof| tof.nw_m),
        tof(|tof| tof.ne_m),
        tof(|tof| tof.sw_m),
        tof(|tof| tof.se_m),
        cell(seen.ground_speed_mps),
        cell(seen.pilot.map(|pilot| pilot.speed_mps)),
        seen.pilot.map(|pilot| word(pilot.follow)).unwrap_or_default(),
        cell(back.map(|heard| heard.loss_db)),
        cell(back.filter(is_uav).map(|heard| heard.packet.ground_speed_mps)),
        cell(back.map(|heard| u8::from(heard.packet.is_base))),
        cell(front.map(|heard| heard.loss_db)),
        cell(front.map(|heard| heard.packet.ground_speed_mps)),
        cell(front.map(|heard| heard.packet.flown_s)),
        front.map(|heard| word(heard.packet.follow)).unwrap_or_default(),
        cell(front.map(|heard| heard.packet.imbalance_db)),
    ];
    cells.join(",")
}

/// What a UAV of a mission saw, as a log, and what it asked for and believed at every tick, in words with all digits.
fn logged(course: &Arc<Course>, uav: usize) -> (String, Vec<String>) {
    let mut chain = Chain::start(course.clone(), 1);
    let (mut commands, mut log, mut asked, mut place) =
        (Vec::new(), HEADER.to_owned(), Vec::new(), uav as u16);
    for tick in 0.. {
        let seen = chain.sense()[uav].clone();
        place = seen.place.unwrap_or(place);
        chain.decide(&mut commands);
        let command = commands[uav];
        let _ = writeln!(
            log,
            "{},{},{},{}",
            row(tick, place, &seen),
            command.forward_mps,
            command.lateral_mps,
            command.yaw_rate_radps
        );
        asked.push(format!("{command:?} {:?}", chain.explain(uav).unwrap()));
        if chain.act(&commands).is_some() {
            break;
        }
    }
    (log, asked)
}

fn settings(course: &Course, place: u16) -> Settings {
    let mut settings = Settings::read(&[]).unwrap();
    (settings.params, settings.place) = (course.node_params(), place);
    settings
}

/// Every step of a replay, in the words of [`logged`].
fn words(replay: &Replay) -> Vec<String> {
    replay.steps().iter().map(|step| format!("{:?} {:?}", step.command, step.why)).collect()
}

#[test]
fn a_log_of_a_simulated_uav_asks_for_what_the_simulated_one_did_to_the_last_bit() {
    for name in ["circuit", "circuit-cavemod", "circuit-frontiers2021"] {
        let course = course(name, &["duration_s=100"]);
        let (mut flew, mut ticks) = (0, 0);
        for uav in 0..course.spawns.len() {
            let (log, asked) = logged(&course, uav);
            let replay = Replay::of(&log, "log.csv", &settings(&course, uav as u16)).unwrap();
            assert_eq!(replay.notes(), [""; 0], "{name}, UAV {uav}");
            let words = words(&replay);
            assert_eq!(words.len(), asked.len());
            for (tick, (ours, theirs)) in words.iter().zip(&asked).enumerate() {
                assert_eq!(ours, theirs, "{name}, UAV {uav}, tick {tick}");
            }
            let summary = replay.summary();
            assert!(summary.compared.iter().all(|compared| compared.same_bits == compared.rows));
            assert_eq!(summary.compared.len(), 3);
            flew += usize::from(summary.flying_s.is_some());
            ticks += asked.len();
        }
        assert!(flew >= 2, "{name}: a head and a relay at least");
        assert_eq!(ticks, 2000 * course.spawns.len());
    }
}

/// The control: a log that differs in the last bit of one loss, or has no more digits than a spreadsheet shows.
#[test]
fn one_bit_of_one_reading_is_found() {
    let course = course("circuit", &["duration_s=60"]);
    let (log, asked) = logged(&course, 0);
    let differing = |log: &str| {
        let replay = Replay::of(log, "log.csv", &settings(&course, 0)).unwrap();
        words(&replay).iter().zip(&asked).filter(|(ours, theirs)| ours != theirs).count()
    };
    assert_eq!(differing(&log), 0);
    let place = HEADER.split(',').position(|name| name == "back_loss_db").unwrap();
    let changed = |line: usize, change: &dyn Fn(f32) -> String| {
        let change_cell = |(i, cell): (usize, &str)| match cell.parse() {
            Ok(loss_db) if i == place => change(loss_db),
            _ => cell.to_owned(),
        };
        let row = |(number, row): (usize, &str)| {
            if number < line {
                return row.to_owned();
            }
            row.split(',').enumerate().map(change_cell).collect::<Vec<_>>().join(",")
        };
        log.lines().enumerate().map(row).collect::<Vec<_>>().join("\n")
    };
    let middle = log.lines().enumerate().filter(|(_, row)| !row.split(',').nth(place).unwrap().is_empty());
    let (line, _) = middle.skip(1).nth(150).unwrap();
    let once = std::cell::Cell::new(true);
    let one_bit = changed(line, &|loss_db| {
        if once.replace(false) {
            f32::from_bits(loss_db.to_bits() + 1).to_string()
        } else {
            loss_db.to_string()
        }
    });
    assert!(differing(&one_bit) > 0);
    assert!(differing(&changed(1, &|loss_db| format!("{loss_db:.2}"))) > 100);
}
