use std::fs;

use serde_json::Value;

use crate::{files, folder, stderr, stdout, uchain};

#[test]
fn a_plan_is_a_table_an_answer_a_file_and_a_picture() {
    let here = folder();
    let output = uchain(here.path(), &["plan", "corner"]);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""));
    let rows = stdout(&output).lines().filter(|line| line.ends_with("  ok")).count();
    assert!((10..=20).contains(&rows), "{}", stdout(&output));
    // 12 m past a corner 3.5 m in: one relay near the corner, one on the way.
    let answer = "12.5 m need 2 relays (3 UAVs); the head is there after 1.0 min; the first relay then has hovered 0.7 min;";
    assert!(stdout(&output).contains(answer), "{}", stdout(&output));
    assert!(
        stdout(&output).ends_with("files: plans/corner/plan.json, plan.png, places.csv and places.geojson\n"),
        "{}",
        stdout(&output)
    );

    let results = here.path().join("plans/corner");
    let names: Vec<_> = files(&results).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["places.csv", "places.geojson", "plan.json", "plan.png"]);
    let picture = image::load_from_memory(&fs::read(results.join("plan.png")).unwrap()).unwrap();
    assert_eq!(picture.width(), 1400);
}

#[test]
fn the_json_of_a_plan_is_its_file_and_deeper_never_needs_fewer_relays_round_a_corner() {
    let here = folder();
    let output =
        uchain(here.path(), &["plan", "corner", "--json", "--out", "results", "--to", "12", "--step", "0.5"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stdout(&output), fs::read_to_string(here.path().join("results/plan.json")).unwrap());
    let plan: Value = serde_json::from_str(stdout(&output)).unwrap();
    let rows = plan["rows"].as_array().unwrap();
    assert_eq!((rows.len(), rows[23]["depth_m"].as_f64()), (24, Some(12.0)));
    let needed: Vec<u64> = rows.iter().map(|row| row["relays_needed"].as_u64().unwrap()).collect();
    assert!(needed.is_sorted() && needed[0] == 0 && needed[23] == 2, "{needed:?}");
    assert!(rows.iter().all(|row| row["bottleneck_db"].as_f64().unwrap() <= 60.0), "{plan}");
    // Results of a run may stand beside those of a plan; a stranger's file may not.
    assert_eq!(
        uchain(here.path(), &["plan", "corner", "--quiet", "--out", "results"]).status.code(),
        Some(0)
    );
    fs::write(here.path().join("results/letter.txt"), "dear").unwrap();
    let refused = uchain(here.path(), &["plan", "corner", "--out", "results"]);
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
}

#[test]
fn what_is_at_hand_changes_the_answer() {
    let here = folder();
    let answer = |args: &[&str]| {
        let output = uchain(here.path(), &[&["plan", "corner", "--to", "12"], args].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output).lines().rev().nth(1).unwrap().to_owned()
    };
    assert!(
        answer(&[]).ends_with("a battery lasts 5.6 min and the reserve: long enough."),
        "{}",
        answer(&[])
    );
    let few = answer(&["--uavs", "2"]);
    assert!(few.starts_with("12 m need 2 relays (3 UAVs), 2 at hand: too few; "), "{few}");
    assert!(few.ends_with(" m can be done."), "{few}");
    assert!(answer(&["--uavs", "1000"]).contains("long enough"), "nobody asks where a thousand would wait");
    let slow = answer(&["--speed", "0.02"]);
    assert!(slow.contains("a battery lasts 7.0 min: too long; "), "{slow}");
    assert!(answer(&["--set", "takeoff.s_min_db=90"]).starts_with("12 m need 1 relay (2 UAVs); "));
    let hopeless = answer(&["--set", "takeoff.s_min_db=30"]);
    assert!(
        hopeless.starts_with("12 m cannot be had with links of 30 dB and up to 1000 relays; not even "),
        "{hopeless}"
    );
}

#[test]
fn a_head_that_is_asked_to_fly_too_fast_is_planned_at_its_most_and_the_plan_says_so() {
    let here = folder();
    let plan = |speed: &str| {
        let output = uchain(here.path(), &["plan", "staircase", "--speed", speed]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let json = fs::read_to_string(here.path().join("plans/staircase/plan.json")).unwrap();
        (stdout(&output).to_owned(), serde_json::from_str::<Value>(&json).unwrap())
    };
    let ((said, fast), (_, most)) = (plan("1"), plan("0.3"));
    assert_eq!(fast["rows"], most["rows"]);
    assert_eq!(fast["speed_mps"], most["speed_mps"]);
    assert_eq!((fast["speed_asked_mps"].as_f64(), most["speed_asked_mps"].as_f64()), (Some(1.0), None));
    let why = "(1 m/s asked, cut to equalize.v_max_mps = 0.3)";
    assert_eq!(said.matches(why).count(), 2, "above the table and in the answer: {said}");
}

#[test]
fn a_bare_map_is_planned_from_its_base_to_its_goal() {
    let here = folder();
    let yaml = "image: hall.pgm\nresolution: 0.1\norigin: [500000, -4200000, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    fs::write(here.path().join("old hall.yaml"), yaml).unwrap();
    // 20 m by 1.4 m of free space within rock, in a surveyor's frame.
    let cell = |x: usize, y: usize| if (5..205).contains(&x) && (5..19).contains(&y) { 254 } else { 0 };
    let mut image = b"P5 210 24 255\n".to_vec();
    image.extend((0..24).flat_map(|y| (0..210).map(move |x| cell(x, y))));
    fs::write(here.path().join("hall.pgm"), image).unwrap();
    let before = files(here.path());

    let plan = |args: &[&str]| uchain(here.path(), &[&["plan", "old hall.yaml"], args].concat());
    let missing = plan(&["--goal=500015,-4199998.8"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(
        stderr(&missing).contains("old hall.yaml is a bare map: add --base X,Y, in the map's own frame (m)"),
        "{}",
        stderr(&missing)
    );
    let rock = plan(&["--base=0,0", "--goal=500015,-4199998.8"]);
    assert_eq!(rock.status.code(), Some(3));
    let wanted = "error: --base=0,0: chain.base_m = [0, 0]: the base is in rock";
    assert!(stderr(&rock).contains(wanted), "{}", stderr(&rock));
    let nowhere = plan(&["--base=500001.5,-4199998.8", "--goal=500001.5,-4199998.8"]);
    assert_eq!(nowhere.status.code(), Some(3));
    let wanted =
        "error: --goal=500001.5,-4199998.8: chain.goal_m: the two ends of the way are one place (0 m apart)";
    assert!(stderr(&nowhere).contains(wanted), "{}", stderr(&nowhere));
    assert_eq!(files(here.path()), before);

    let output = plan(&["--base=500001.5,-4199998.8", "--goal=500011.5,-4199998.8"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // 60 dB reach 4.4 m.
    assert!(
        stdout(&output).contains("m need 2 relays (3 UAVs); the head is there after 0.9 min;"),
        "{}",
        stdout(&output)
    );
    let json = fs::read_to_string(here.path().join("plans/old-hall/plan.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    assert!(json["relays_available"].is_null(), "nobody said how many");
}

#[test]
fn a_plan_that_cannot_be_made_says_why_and_writes_nothing() {
    let here = folder();
    let table: &[(&[&str], i32, &str)] = &[
        (&["corner", "--to", "100"], 3, "the tunnel ends 12.50 m from the base"),
        (&["corner", "--to", "12", "--step", "0.001"], 3, "more than 1000 rows"),
        (&["corner", "--to", "0"], 2, "expected a length in metres, more than 0"),
        (&["corner", "--speed", "-1"], 2, "expected a speed in m/s, more than 0 and at most 1"),
        (&["corner", "--uavs", "0"], 2, "expected a whole number from 1 to 1000"),
        (&["corner", "--base", "1"], 2, "expected X,Y in metres"),
        (&["cornr"], 3, "did you mean 'corner'?"),
        (&["corner", "--goal=0.1,0"], 3, "the goal lies behind the base"),
        (
            &["corner", "--heading", "nan"],
            2,
            "'--heading <DEG>': expected an angle in degrees, from -360 to 360",
        ),
        (&["corner", "--base=0,9"], 3, "error: --base=0,9: chain.base_m = [0, 9]: the base is in rock"),
        (&["corner", "--set", "chain.base_m=[0, 9]"], 3, "error: --set chain.base_m=[0, 9]: chain.base_m = "),
        (&["absent.yaml", "--base=0,0", "--goal=1,1"], 3, "error: absent.yaml: No such file"),
    ];
    for (args, code, wanted) in table {
        let output = uchain(here.path(), &[&["plan"], *args].concat());
        assert_eq!(output.status.code(), Some(*code), "{args:?}: {}", stderr(&output));
        assert!(
            stderr(&output).contains(wanted),
            "{args:?}\n  got    {}\n  wanted {wanted}",
            stderr(&output)
        );
        assert!(files(here.path()).is_empty(), "{args:?}");
    }
}

#[test]
fn a_plan_says_what_it_assumes_where_relays_stand_and_whose_battery_lasts() {
    let here = folder();
    let output = uchain(here.path(), &["plan", "staircase", "--stay", "0.5", "--reserve", "0.1"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    for wanted in [
        "\nassumed\n",
        "dB on every link (takeoff.s_min_db)",
        "stays 0.5 min",
        "10 % stay in reserve",
        "\nplaces with the head ",
        "\nbatteries: ",
        "\nwould help: a head at ",
        "the head is short of battery by ",
        "\nrelays if one number is a little off: s_min -1 dB: ",
    ] {
        assert!(said.contains(wanted), "no {wanted:?} in\n{said}");
    }
    let results = here.path().join("plans/staircase");
    let plan: Value = serde_json::from_str(&fs::read_to_string(results.join("plan.json")).unwrap()).unwrap();
    let places = plan["places"].as_array().unwrap();
    assert_eq!(places.len() as u64 + 1, plan["uavs_needed"].as_u64().unwrap());
    let csv = fs::read_to_string(results.join("places.csv")).unwrap();
    assert_eq!(csv.lines().count(), places.len() + 1);
    for (row, place) in csv.lines().skip(1).zip(places) {
        let x_m: f64 = row.split(',').nth(1).unwrap().parse().unwrap();
        assert!((x_m - place["x_m"].as_f64().unwrap()).abs() < 1e-3, "{row}");
        assert!(place["margin_db"].as_f64().unwrap() >= 0.0, "{place}");
    }
    let drawn: Value =
        serde_json::from_str(&fs::read_to_string(results.join("places.geojson")).unwrap()).unwrap();
    let features = drawn["features"].as_array().unwrap();
    let of = |kind: &str| features.iter().filter(|one| one["properties"]["kind"] == kind).count();
    assert_eq!((of("base"), of("relay"), of("head"), of("link")), (1, places.len(), 1, places.len() + 1));
    assert!(said.contains(plan["verdict"].as_str().unwrap()));
}

#[test]
fn what_a_plan_says_would_help_does_help() {
    let here = folder();
    let plan = |args: &[&str]| {
        let output = uchain(here.path(), &[&["plan", "staircase", "--json"], args].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        serde_json::from_str::<Value>(stdout(&output)).unwrap()
    };
    let short = plan(&[]);
    assert_eq!(short["batteries"]["all_home"], false);
    let ways: Vec<&str> = short["would_help"].as_str().unwrap().split("; ").collect();
    for way in &ways[..2] {
        let (_, args) = way.trim_end_matches(')').split_once('(').unwrap();
        let helped = plan(&args.split(' ').collect::<Vec<_>>());
        assert_eq!(helped["batteries"]["all_home"], true, "{way}");
    }
    let from_m = short["batteries"]["home_from_m"].as_f64().unwrap();
    assert_eq!(plan(&["--to", &from_m.to_string()])["batteries"]["all_home"], true);
    assert_eq!(plan(&["--to", &(from_m + 0.1).to_string()])["batteries"]["all_home"], false);
}

#[test]
fn a_link_budget_sets_limit_and_reference_loss_in_path_loss_and_is_printed_in_dbm() {
    let here = folder();
    let given = "tx_dbm=0,tx_gain_dbi=2,rx_gain_dbi=2,sensitivity_dbm=-85,margin_db=20,frequency_mhz=2450";
    let output = uchain(here.path(), &["plan", "straight", "--budget", given]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    // 0 + 2 + 2 + 85 - 20 = 69 dB, received at -65 dBm; 28.2 dB at 0.25 m.
    for wanted in
        ["links of at most 69 dB", "28.2 dB at 0.25 m", "takeoff.s_min_db                69             -65"]
    {
        assert!(said.contains(wanted), "no {wanted:?} in\n{said}");
    }
    // What is printed to fly by it is what the plan was made with.
    let sets = said.lines().find_map(|line| line.trim().strip_prefix("to fly by it: ")).unwrap();
    let json = |args: &[&str]| {
        let output = uchain(here.path(), &[&["plan", "straight", "--json"], args].concat());
        serde_json::from_str::<Value>(stdout(&output)).unwrap()
    };
    let by_hand = json(&sets.split(' ').collect::<Vec<_>>());
    let by_budget = json(&["--budget", given]);
    assert_eq!(by_hand["rows"], by_budget["rows"]);
    assert_eq!(by_hand["places"], by_budget["places"]);
    assert_ne!(json(&[])["rows"], by_budget["rows"], "the control: without it the plan is another");
    fs::write(here.path().join("radio.toml"), given.replace(',', "\n")).unwrap();
    assert_eq!(json(&["--budget", "radio.toml"])["budget"], by_budget["budget"]);
    assert_eq!(json(&["--budget", "crazyflie"])["s_min_db"].as_f64(), Some(65.0));
    for (wrong, wanted) in [
        ("tx_dbm=0", "missing field `sensitivity_dbm`"),
        ("tx_dbm=0,sensitivity_dbm=-85,gain=2", "unknown field `gain`"),
        ("crazyfly", "expected crazyflie, a file that ends in .toml, or key=value"),
    ] {
        let refused = uchain(here.path(), &["plan", "straight", "--budget", wrong]);
        assert_eq!(refused.status.code(), Some(2));
        assert!(stderr(&refused).contains(wanted), "{}", stderr(&refused));
    }
}

#[test]
fn flights_are_set_beside_the_plan() {
    let here = folder();
    let args = ["plan", "straight", "--to", "9", "--fly", "2", "--out", "flown"];
    let output = uchain(here.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(said.contains("\nflown 2 times for ") && said.contains("A plan is a best case"), "{said}");
    let json = fs::read_to_string(here.path().join("flown/plan.json")).unwrap();
    let plan: Value = serde_json::from_str(&json).unwrap();
    let flown = &plan["flown"];
    assert_eq!(flown["uavs"], plan["uavs_needed"]);
    let runs = flown["runs"].as_array().unwrap();
    assert_eq!((runs.len(), runs[0]["seed"].as_u64(), runs[1]["seed"].as_u64()), (2, Some(1), Some(2)));
    let reach_m = |run: &Value| run["reach_m"].as_f64().unwrap();
    assert!(runs.iter().all(|run| (3.0..9.6).contains(&reach_m(run))), "{flown}");
    assert_eq!(reach_m(&flown["worst"]), reach_m(&runs[0]).min(reach_m(&runs[1])));
    assert_ne!(
        runs[0]["worst_link_db"], runs[1]["worst_link_db"],
        "the control: another seed is another flight"
    );
    let again = uchain(here.path(), &args);
    assert_eq!((again.status.code(), stdout(&again)), (Some(0), said), "the same seeds, the same flights");
}

#[test]
fn the_map_is_coloured_by_the_relays_that_each_place_needs() {
    let here = folder();
    let output = uchain(here.path(), &["plan", "corner", "--everywhere"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("\neverywhere: "), "{}", stdout(&output));
    assert!(stdout(&output).ends_with("everywhere.csv and everywhere.png\n"), "{}", stdout(&output));
    let results = here.path().join("plans/corner");
    let picture = image::load_from_memory(&fs::read(results.join("everywhere.png")).unwrap()).unwrap();
    assert_eq!(picture.width(), 1400);
    let plan: Value = serde_json::from_str(&fs::read_to_string(results.join("plan.json")).unwrap()).unwrap();
    let shares: Vec<f64> = plan["everywhere"]["share_within"]
        .as_array()
        .unwrap()
        .iter()
        .map(|share| share.as_f64().unwrap())
        .collect();
    assert!(shares.is_sorted() && shares[0] > 0.0 && *shares.last().unwrap() <= 1.0, "{shares:?}");
    // The tunnel's end needs as many as the plan says, give or take where in the end one stands.
    let most = plan["everywhere"]["relays_most"].as_u64().unwrap();
    let planned = plan["uavs_needed"].as_u64().unwrap() - 1;
    assert!(most.abs_diff(planned) <= 1, "{most} and {planned}");
    let csv = fs::read_to_string(results.join("everywhere.csv")).unwrap();
    assert!(csv.starts_with("x_m,y_m,depth_m,relays\n") && csv.lines().count() > 100);
    // A plan without it leaves none of the files that spoke of another.
    let plain = uchain(here.path(), &["plan", "corner", "--quiet"]);
    assert_eq!(plain.status.code(), Some(0));
    assert!(!results.join("everywhere.csv").exists() && !results.join("everywhere.png").exists());
}

#[test]
fn who_asks_for_everywhere_of_a_bare_map_need_not_say_a_goal() {
    let here = folder();
    let map = "type octile\nheight 4\nwidth 24\nmap\n@@@@@@@@@@@@@@@@@@@@@@@@\n@......................@\n\
               @......................@\n@@@@@@@@@@@@@@@@@@@@@@@@\n";
    fs::write(here.path().join("hall.map"), map).unwrap();
    let args = ["plan", "hall.map", "--base=1.0,1.0", "--json"];
    let plain = uchain(here.path(), &args);
    assert_eq!(plain.status.code(), Some(2), "the control: a plan needs a goal");
    let output = uchain(here.path(), &[&args[..], &["--everywhere"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let plan: Value = serde_json::from_str(stdout(&output)).unwrap();
    let [x_m, tunnel_m] = [&plan["head_m"][0], &plan["tunnel_m"]].map(|value| value.as_f64().unwrap());
    assert!(x_m > 10.5 && (9.5..10.8).contains(&tunnel_m), "{x_m} {tunnel_m}");

    // A scenario keeps its own goal, also where the base is said by a name that is looked up in its map.
    let room = r#"{"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"kind": "free"},
         "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [30, 0], [30, 2], [0, 2], [0, 0]]]}},
        {"type": "Feature", "properties": {"name": "portal"}, "geometry": {"type": "Point", "coordinates": [1, 1]}}]}"#;
    fs::write(here.path().join("room.geojson"), room).unwrap();
    let scenario = "name = \"room\"\nduration_s = 10.0\n[map.geojson]\nfile = \"room.geojson\"\nmetres = true\n\
                    [chain]\nuavs = 1\nbase_m = [1.0, 1.0]\ngoal_m = [9.0, 1.0]\n\
                    [[pilot]]\nstart_s = 0.0\nspeed_mps = 0.2\n";
    fs::write(here.path().join("room.toml"), scenario).unwrap();
    let output = uchain(here.path(), &["plan", "room.toml", "--base", "portal", "--json", "--everywhere"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let plan: Value = serde_json::from_str(stdout(&output)).unwrap();
    assert_eq!(plan["head_m"][0].as_f64().map(f64::round), Some(9.0), "{}", plan["head_m"]);
}

#[test]
fn a_place_in_rock_is_answered_with_one_nearby_where_there_is_room() {
    let here = folder();
    let output = uchain(here.path(), &["plan", "corner", "--goal=0,2"]);
    let said = stderr(&output).to_owned();
    let (_, place) = said.split_once("there is room at (").unwrap_or_else(|| panic!("{said}"));
    let place = place.split(')').next().unwrap().replace(", ", ",");
    // It is one: as a base it is accepted.
    let base = format!("--base={place}");
    let tried = uchain(here.path(), &["plan", "corner", &base, "--to", "0.5", "--quiet"]);
    assert!(!stderr(&tried).contains("in rock"), "{base}: {}", stderr(&tried));
    let names = uchain(here.path(), &["plan", "corner", "--goal", "portal"]);
    assert!(stderr(&names).contains("portal: the map names no such place"), "{}", stderr(&names));
    let usage = uchain(here.path(), &["plan", "corner", "--to", "portal"]);
    assert_eq!(usage.status.code(), Some(2));
    assert!(stderr(&usage).contains("--from STATION"), "{}", stderr(&usage));
}
