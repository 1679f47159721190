//! Plans against closed forms and figures worked out by hand.

use super::*;
use crate::config::builtin;

fn course(name: &str, sets: &[&str]) -> std::sync::Arc<Course> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Course::read(&builtin(name).unwrap(), &sets).unwrap()
}

#[test]
fn a_straight_tunnel_needs_a_relay_every_44_m_and_the_head_takes_its_time() {
    // 60 dB reach 0.25 · 10^1.25 = 4.446 m.
    let plan = plan(&course("straight", &["chain.endurance_s=60"]), None, 0.5, None).unwrap();
    let needed: Vec<_> = plan.rows.iter().map(|row| row.relays_needed.unwrap()).collect();
    let by_hand: Vec<_> = plan.rows.iter().map(|row| (row.depth_m / 4.4457).floor() as usize).collect();
    assert_eq!(needed, by_hand);
    assert_eq!(plan.uavs_needed, Some(4));
    let depths_m: Vec<_> = plan.launches.iter().map(|launch| launch.depth_m).collect();
    assert_eq!(depths_m, [4.5, 9.0, 13.5]);
    // 2 s to be ready, then 0.2 m/s from 0.75 m on.
    let row = &plan.rows[19];
    assert!((row.time_min.unwrap() - (2.0 + 9.25 / 0.2) / 60.0).abs() < 1e-6);
    assert!((row.first_relay_min.unwrap() - 5.5 / 0.2 / 60.0).abs() < 1e-6);
    assert!(plan.rows[..24].iter().all(|row| row.feasible), "a minute is enough for 12.35 m");
    assert!(!plan.rows[24].feasible);
    assert!((plan.feasible_to_m.unwrap() - 12.35).abs() < 0.011, "{:?}", plan.feasible_to_m);
}

#[test]
fn relays_that_are_not_there_end_what_is_feasible() {
    let with_rows = |step_m| plan(&course("straight", &[]), Some(10.0), step_m, Some(2)).unwrap();
    for step_m in [0.5, 1.0, 3.0, 10.0] {
        // Two links of 4.446 m, wherever the rows are.
        let feasible_to_m = with_rows(step_m).feasible_to_m.unwrap();
        assert!((8.87..=8.893).contains(&feasible_to_m), "{step_m}: {feasible_to_m}");
    }
    let plan = with_rows(1.0);
    assert_eq!(plan.relays_available, Some(1));
    assert!(plan.rows.iter().all(|row| row.bottleneck_db.unwrap() <= 60.0));
    let last = plan.rows.last().unwrap();
    assert!(last.bottleneck_by_links_db.is_sorted_by(|a, b| a > b) && last.bottleneck_by_links_db.len() == 3);
}

#[test]
fn what_cannot_be_planned_is_refused_in_words() {
    let course = course("straight", &[]);
    let words = |to_m, step_m| plan(&course, to_m, step_m, None).unwrap_err().to_string();
    assert_eq!(words(Some(20.0), 1.0), "to_m = 20: the tunnel ends 13.50 m from the base");
    assert_eq!(words(None, 0.0), "step_m = 0: must be more than 0");
    assert_eq!(words(Some(f64::NAN), 1.0), "to_m = NaN: must be more than 0");
    assert_eq!(words(Some(10.0), 0.001), "step_m = 0.001: 10 m in such steps are more than 1000 rows");
    let lost = Course { tunnel: None, ..(*course).clone() };
    let words = plan(&lost, None, 1.0, None).unwrap_err().to_string();
    assert!(words.contains("chain.goal_m (--goal); the farthest place from the base is [13."), "{words}");
}

#[test]
fn the_head_flies_no_faster_than_its_laws_let_it() {
    let at = |speed: &str| {
        let set = format!("pilot.0.speed_mps={speed}");
        plan(&course("straight", &[&set, "equalize.v_max_mps=0.25"]), None, 5.0, None).unwrap()
    };
    let (fast, most) = (at("1"), at("0.25"));
    assert_eq!(fast.rows, most.rows);
    assert_eq!((fast.speed_mps, fast.speed_asked_mps), (Some(0.25), Some(1.0)));
    assert_eq!((most.speed_mps, most.speed_asked_mps), (Some(0.25), None));
}

#[test]
fn without_a_pilot_who_flies_forward_there_are_no_times() {
    for set in ["pilot.0.speed_mps=0", "equalize.v_max_mps=0"] {
        let plan = plan(&course("straight", &[set]), None, 5.0, None).unwrap();
        let row = &plan.rows[1];
        assert_eq!((plan.speed_mps, row.time_min, row.first_relay_min), (None, None, None), "{set}");
        assert!(plan.rows.iter().all(|row| row.feasible), "{set}");
    }
}

/// The whole plan.
fn whole(course: &Course, asked: &PlanOptions) -> Plan {
    plan_while(course, asked, &mut || true).unwrap()
}

#[test]
fn relays_of_a_straight_tunnel_stand_evenly_between_base_and_head() {
    // 12 m need 2 relays (4.446 m each at most): three links of 4 m (Laclau 2021, Eq. 9), 35 + 20 log10(16) = 59.08 dB.
    let course = course("straight", &[]);
    let plan = whole(&course, &PlanOptions { to_m: Some(12.0), ..PlanOptions::default() });
    let [base_x, base_y] = course.scenario.chain.base_m;
    assert_eq!(plan.places.iter().map(|place| place.relay).collect::<Vec<_>>(), [1, 2]);
    for (place, depth_m) in plan.places.iter().zip([8.0, 4.0]) {
        assert!((place.depth_m - depth_m).abs() < 0.01, "{place:?}");
        assert!(
            (place.x_m - base_x - depth_m).abs() < 0.01 && (place.y_m - base_y).abs() < 0.01,
            "{place:?}"
        );
        assert!((place.link_db - 59.08).abs() < 0.02 && (place.front_db - 59.08).abs() < 0.02, "{place:?}");
        assert!((place.margin_db - 0.92).abs() < 0.02, "{place:?}");
    }
    let head_m = plan.head_m.unwrap();
    assert!((head_m[0] - base_x - 12.0).abs() < 0.01, "{head_m:?}");
}

#[test]
fn batteries_last_for_the_way_in_the_stay_and_the_way_back_or_the_plan_says_by_how_much_they_do_not() {
    // Ready after 2 s, 0.75 m to 12 m at 0.2 m/s: 56.25 s. There after 58.25 s, 60 s of stay, home after 174.5 s.
    let of = |endurance_s: &str| {
        let course = course("straight", &[&format!("chain.endurance_s={endurance_s}")]);
        whole(&course, &PlanOptions { to_m: Some(12.0), step_m: 0.5, stay_s: 60.0, ..PlanOptions::default() })
    };
    let plan = of("200"); // 160 s without the reserve
    let batteries = plan.batteries.as_ref().unwrap();
    let [head, first, second] = batteries.uavs[..] else { panic!("{batteries:?}") };
    assert!((60.0 * head.airborne_min - 174.5).abs() < 1e-3, "{head:?}");
    assert!((60.0 * head.spare_min + 14.5).abs() < 1e-3, "{head:?}");
    // The first relay takes off with the head 4.5 m deep: 7.5 m on, 60 s, 7.5 m back.
    assert!((60.0 * first.airborne_min - 135.0).abs() < 1e-3 && first.spare_min > 0.0, "{first:?}");
    assert!((60.0 * second.airborne_min - 90.0).abs() < 1e-3, "{second:?}");
    assert!(
        first.home_min > second.home_min && head.home_min > first.home_min,
        "the first relay lands last of all relays"
    );
    // 160 s less 2 s and 60 s are 98 s on the way: 49 s in, 9.8 m.
    assert!((batteries.home_from_m.unwrap() - 10.55).abs() < 1e-3, "{batteries:?}");
    // 22.5 m in 98 s; 174.5 s and a quarter more.
    assert!((batteries.speed_needed_mps.unwrap() - 22.5 / 98.0).abs() < 1e-4);
    assert!((batteries.endurance_needed_s.unwrap() - 218.125).abs() < 1e-2);
    // Without the stay 114.5 s would do: one more UAV relieves the head.
    assert_eq!(batteries.relief_uavs, Some(1));
    assert!(!batteries.all_home);
    assert!(
        plan.verdict
            .contains("the head is short of battery by 0.2 min: it has flown 2.9 of 2.7 min when it is home")
    );
    let enough = of("219");
    assert!(
        enough.batteries.as_ref().unwrap().all_home && enough.would_help.is_none(),
        "the control: what was said to help"
    );
    let short = of("218");
    assert!(!short.batteries.unwrap().all_home);
}

#[test]
fn a_decibel_and_a_tenth_of_an_exponent_move_the_number_of_relays() {
    // Links of 13.5 m / n: with 59 dB 3.962 m (4 links), with 61 dB 4.988 m (3 links, as with 60 dB: 4.446 m).
    let course = course("straight", &["pilot.0.speed_mps=0.2"]);
    let plan = whole(&course, &PlanOptions::default());
    let by = |s_min_db: f64, alpha: f64| {
        let same = |a: f64, b: f64| (a - b).abs() < 1e-6;
        plan.sensitivity
            .variants
            .iter()
            .find(|one| same(one.s_min_db, s_min_db) && same(one.alpha, alpha))
            .unwrap()
            .relays
    };
    let needed = |s_min_db: f64, alpha: f64| {
        let reach_m = 0.25 * libm::pow(10.0, (s_min_db - 35.0) / (10.0 * alpha));
        Some((plan.tunnel_m / reach_m).ceil() as usize - 1)
    };
    assert_eq!(by(-1.0, 0.0), needed(59.0, 2.0));
    assert_eq!(by(1.0, 0.0), needed(61.0, 2.0));
    assert_eq!(by(0.0, -0.1), needed(60.0, 1.9));
    assert_eq!(by(0.0, 0.1), needed(60.0, 2.1));
    assert_ne!(by(0.0, -0.1), by(0.0, 0.1), "the control: it does matter here");
    assert_eq!(plan.sensitivity.variants.len(), 4);
}

#[test]
fn what_is_assumed_is_what_the_scenario_says() {
    let course =
        course("straight", &["radio.alpha_free=1.8", "takeoff.s_min_db=58", "equalize.v_max_mps=0.3"]);
    let asked = PlanOptions { reserve: 0.1, stay_s: 30.0, ..PlanOptions::default() };
    let assumed = whole(&course, &asked).assumptions;
    assert_eq!((assumed.radio.alpha_free, assumed.s_min_db, assumed.head.v_max_mps), (1.8, 58.0, 0.3));
    assert_eq!(
        (assumed.battery.endurance_s, assumed.battery.reserve, assumed.head.stay_s),
        (420.0, 0.1, 30.0)
    );
    assert_eq!((assumed.map.table, assumed.map.base_m), ("map.corridor", course.scenario.chain.base_m));
}

#[test]
fn a_stay_or_a_reserve_that_cannot_be_is_refused_in_words() {
    let course = course("straight", &[]);
    let words = |stay_s, reserve| {
        let asked = PlanOptions { stay_s, reserve, ..PlanOptions::default() };
        plan_while(&course, &asked, &mut || true).unwrap_err().to_string()
    };
    assert_eq!(words(-1.0, 0.2), "stay_s = -1: must lie in 0..=86400");
    assert_eq!(words(0.0, f64::NAN), "reserve = NaN: must lie in 0..=0.9");
}
