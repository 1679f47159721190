use super::{
    super::{KnownKeys, keys::join},
    Course, PLAIN, source,
};
use crate::mission::{Scene as _, explore::Site};

fn message(text: &str, sets: &[&str]) -> String {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    match Course::read(&source(text), &sets) {
        Ok(_) => "ok".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// (old text, new text, what the message must hold).
const BAD_LINES: &[(&str, &str, &str)] = &[
    (
        "k_db_per_m = 20.0",
        "k_db_per_n = 20.0",
        "plain.toml:13: unknown key 'equalize.k_db_per_n'; did you mean 'k_db_per_m'? (known: law, k_db_per_m, ",
    ),
    ("[equalize]", "[equalise]", "plain.toml:12: unknown key 'equalise'; did you mean 'equalize'?"),
    ("duration_s", "duration", "plain.toml:2: unknown key 'duration'; did you mean 'duration_s'?"),
    ("duration_s = 10.0\n", "", "plain.toml: missing key 'duration_s'"),
    ("uavs = 3\n", "", "plain.toml:8: missing key 'chain.uavs'"),
    (
        "k_db_per_m = 20.0",
        "k_db_per_m = \"x\"",
        "plain.toml:13: equalize.k_db_per_m = \"x\": expected a number",
    ),
    (
        "k_db_per_m = 20.0",
        "k_db_per_m = 0",
        "plain.toml:13: equalize.k_db_per_m = 0: must lie in 0.1..=10000",
    ),
    ("k_db_per_m = 20.0", "k_db_per_m = nan", "plain.toml:13: equalize.k_db_per_m = nan: must lie in"),
    (
        "k_db_per_m = 20.0",
        "decision_s = 0.21",
        "plain.toml:13: equalize.decision_s = 0.21: must be a multiple of the tick, 0.05 s",
    ),
    ("duration_s = 10.0", "duration_s = 0.0", "plain.toml:2: duration_s = 0.0: must lie in 0.05..=86400"),
    ("duration_s = 10.0", "duration_s = 86401", "plain.toml:2: duration_s = 86401: must lie in 0.05..=86400"),
    ("duration_s = 10.0", "duration_s = 10.01", "plain.toml:2: duration_s = 10.01: must be a multiple"),
    ("uavs = 3", "uavs = 0", "plain.toml:9: chain.uavs = 0: must lie in 1..=1000"),
    ("uavs = 3", "uavs = -3", "plain.toml:9: chain.uavs = -3: expected a whole number, 1 to 1000"),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0]",
        "plain.toml:10: chain.base_m = a list of 1: expected two numbers [x, y]",
    ),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0, 0.0, 1.0]",
        "plain.toml:10: chain.base_m = 3 numbers: expected two numbers [x, y]",
    ),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0, 3.0]",
        "plain.toml:10: chain.base_m = [0, 3]: the base is in rock",
    ),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0, 0.35]",
        "plain.toml:8: chain.spacing_m = 0.25: UAV 0 would wait at (0.5, 0.35) m, 0.050 m from a wall; expected at least its radius, 0.06 m",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspacing_m = 0.1",
        "plain.toml:10: chain.spacing_m = 0.1: UAV 1 would wait at (0.1, 0) m, 0.100 m from UAV 0; expected at least two radii, 0.12 m",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 0]]",
        "plain.toml:10: chain.spawns_m = 2 places: must be one place per UAV (chain.uavs = 3)",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 4], [0, 0]]",
        "plain.toml:10: chain.spawns_m.1 = [0.5, 4]: UAV 1 would wait at (0.5, 4) m, which is in rock",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 0], [1, 0]]",
        "plain.toml:10: chain.spawns_m.2 = [1, 0]: UAV 2 would wait at (1, 0) m, 0.000 m from UAV 0",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 0, 7], [0, 0]]",
        "plain.toml:10: chain.spawns_m.1 = 3 numbers: expected two numbers [x, y]",
    ),
    (
        "uavs = 3",
        "uavs = 3\ngoal_m = [5.0, 0.4]",
        "plain.toml:10: chain.goal_m = [5, 0.4]: the goal is on a wall; expected free space",
    ),
    ("uavs = 3", "uavs = 3\ngoal_m = [9, 0]", "plain.toml:10: chain.goal_m = [9, 0]: the goal is in rock"),
    (
        "uavs = 3",
        "uavs = 3\ngoal_m = [-0.4, 0]",
        "plain.toml:10: chain.goal_m = [-0.4, 0]: the goal lies behind the base",
    ),
    ("uavs = 3", "uavs = 3\nendurance_s = 0", "plain.toml:10: chain.endurance_s = 0: must lie in 1..=86400"),
    ("speed_mps = 0.2", "speed_mps = 20", "plain.toml:17: pilot.0.speed_mps = 20: must lie in -1..=1"),
    (
        "speed_mps = 0.2",
        "speed_mps = 0.2\nfollow = \"centr\"",
        "plain.toml:18: pilot.0.follow = \"centr\": unknown choice; did you mean 'centre'? (known: centre, left, right)",
    ),
    (
        "speed_mps = 0.2",
        "speed_mps = 0.2\n[[pilot]]\nstart_s = 0\nspeed_mps = 0",
        "plain.toml:19: pilot.1.start_s = 0: must be later than the step before it, which starts at 0 s",
    ),
    (
        "[map.corridor]",
        "[map.corridoor]",
        "plain.toml:4: unknown key 'map.corridoor'; did you mean 'corridor'? (known: corridor, walls, movingai, ros, csv, ",
    ),
    (
        "[map.corridor]",
        "[map.ros]\nfile = \"x.yaml\"\n[map.corridor]",
        "plain.toml:4: map = { … }: expected one of the tables [map.corridor], [map.walls], [map.movingai], [map.ros], [map.csv], ",
    ),
    ("width_m = 0.8", "width_m = -1", "plain.toml:6: map.corridor.width_m = -1: must lie in 0.1..=100"),
    (
        "[8.0, 0.0]]",
        "[8.0]]",
        "plain.toml:5: map.corridor.centre_line_m.1 = 1 numbers: must be [x, y] or [x, y, r]",
    ),
    ("[-0.6, 0.0], ", "", "plain.toml:4: map.corridor: "),
    (
        "[equalize]",
        "[center]\ntof_range_m = 4.0\n[equalize]",
        "plain.toml:13: unknown key 'center.tof_range_m'; did you mean 'tof.range_m'?",
    ),
    ("[equalize]", "[tof]\nrange_m = 4.0\n[equalize]", "ok"),
    (
        "[equalize]",
        "[faults]\nburst_rate = 1.5\n[equalize]",
        "plain.toml:13: faults.burst_rate = 1.5: must lie in 0..=1",
    ),
    (
        "[equalize]",
        "[faults]\nburst_packets = 0\n[equalize]",
        "faults.burst_packets = 0: must lie in 1..=100000",
    ),
    (
        "[equalize]",
        "[[faults.dead]]\nuav = 3\nstart_s = 1\n[equalize]",
        "plain.toml:13: faults.dead.0.uav = 3: must be a UAV of the chain: 0, the head, to 2",
    ),
    (
        "[equalize]",
        "[[faults.dead]]\nuav = 2\nstart_s = -1\n[equalize]",
        "plain.toml:14: faults.dead.0.start_s = -1: must lie in 0..=86400",
    ),
    (
        "[equalize]",
        "[[faults.deaf]]\nuav = 2\nside = \"fronk\"\n[equalize]",
        "plain.toml:14: faults.deaf.0.side = \"fronk\": unknown choice; did you mean 'front'?",
    ),
    (
        "[equalize]",
        "[[faults.deaf]]\nuav = 2\nside = \"front\"\nstart_s = 5\nstop_s = 5\n[equalize]",
        "plain.toml:16: faults.deaf.0.stop_s = 5: must be later than start_s = 5; without it, to the end",
    ),
    (
        "[equalize]",
        "[[faults.deaf]]\nuav = 2\nside = \"front\"\nstop_s = inf\n[equalize]",
        "plain.toml:15: faults.deaf.0.stop_s = inf: must be later than start_s = 0",
    ),
    (
        "[equalize]",
        "[packets]\ndelay_ticks = 1001\n[equalize]",
        "plain.toml:13: packets.delay_ticks = 1001: must lie in 0..=1000",
    ),
    (
        "name = \"plain\"",
        "name = \"plain\"\npreset = \"cave-mod\"",
        "plain.toml:2: preset = \"cave-mod\": unknown choice; did you mean 'cavemod'? (known: cavemod, frontiers2021)",
    ),
    ("name = \"plain\"", "name = \"plain\"\npreset = 5", "plain.toml:2: preset = 5: expected text in quotes"),
    ("name = \"plain\"", "name = \"../up\"", "plain.toml:1: name = \"../up\": must be 1 to 64 of"),
    ("width_m = 0.8", "width_m = 0.8.1", "plain.toml:6: not valid TOML: "),
    ("width_m = 0.8", "width_m = 0.8\nwidth_m = 0.9", "plain.toml:7: not valid TOML: duplicate key"),
];

#[test]
fn a_bad_line_is_named_with_its_key_and_the_nearest_known_name() {
    let mut wrong = Vec::new();
    for (old, new, wanted) in BAD_LINES {
        assert!(PLAIN.contains(old), "{old}");
        let got = message(&PLAIN.replacen(old, new, 1), &[]);
        if !got.contains(wanted) {
            wrong.push(format!("{new:?}\n  got    {got}\n  wanted {wanted}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_bad_set_is_named_instead_of_a_line() {
    let table: &[(&str, &str)] = &[
        ("chain.uavs=0", "--set chain.uavs=0: chain.uavs = 0: must lie in 1..=1000"),
        ("chain.uavz=2", "--set chain.uavz=2: unknown key 'chain.uavz'; did you mean 'uavs'?"),
        ("kalman.q=2", "--set kalman.q=2: unknown key 'kalman.q' (known: measurement_variance_db2"),
        (
            "pilot.0.speed_mps=fast",
            "--set pilot.0.speed_mps=fast: pilot.0.speed_mps = \"fast\": expected a number",
        ),
        ("pilot.3.speed_mps=0", "pilot is a list of 1: expected an index below 1 after it, got '3'"),
        ("pilot.speed_mps=0", "pilot is a list of 1: write which one, such as pilot.0.speed_mps"),
        (
            "faults.dead.0.uav=1",
            "faults.dead has no entries: write all of it, such as --set 'faults.dead=[…]'",
        ),
        ("center.tof_range_m=4", "unknown key 'center.tof_range_m'; did you mean 'tof.range_m'?"),
        ("seed=4", "unknown key 'seed' (known: name, "),
        ("corridor.width_m=2", "unknown key 'corridor'; did you mean 'map.corridor'?"),
        ("map.width_m=0", "--set map.width_m=0: map.corridor.width_m = 0: must lie in 0.1..=100"),
        ("map.cell_m=2", "--set map.cell_m=2: unknown key 'map.cell_m'; did you mean 'map.movingai.cell_m'?"),
        ("alpha_wall=4", "unknown key 'alpha_wall'; did you mean 'radio.alpha_wall'? (known: name, "),
        ("alpha_wal=4", "unknown key 'alpha_wal'; did you mean 'radio.alpha_wall'?"),
        ("chain.radius_m=1", "unknown key 'chain.radius_m'; did you mean 'motion.radius_m'? (known: uavs, "),
        ("speed_mps=1", "unknown key 'speed_mps'; did you mean 'pilot.0.speed_mps'?"),
        ("map=5", "map = 5: expected one of the tables [map.corridor], [map.walls]"),
        ("map=[1]", "map = a list of 1: expected one of the tables [map.corridor], [map.walls]"),
        ("pilot=[1]", "--set pilot=[1]: pilot = 1: expected a table"),
        ("pilot={a=1}", "pilot = a table: expected a list [ … ]"),
        ("pilot=[{start_s=0,speed_mps=0,follow=5}]", "expected one of its words, in quotes"),
        ("equalize.law=5", "equalize.law = 5: expected one of its words, in quotes"),
        ("equalize.law=[1]", "equalize.law = a list of 1: expected one of its words, in quotes"),
        ("equalize.law={}", "equalize.law = a table: expected one of its words, in quotes"),
        ("equalize.law={a=1,b=2}", "equalize.law = a table: expected one of its words, in quotes"),
        ("tof.rays=5000000000", "tof.rays = 5000000000: expected a whole number, 1 to 64"),
        ("chain.uavs=99999999999999999999", "expected a whole number, 1 to 1000"),
        ("link.base_flow={a=1}", "link.base_flow = a table: expected true or false"),
        ("name=[1]", "name = a list of 1: expected text in quotes"),
        ("chain.base_m=[\"a\",1]", "chain.base_m = \"a\": expected a number"),
        ("chain.spawns_m=[5]", "chain.spawns_m = 5: expected two numbers [x, y]"),
        ("radio.sigma_db=1e400", "radio.sigma_db = 1e400: expected a number that is not as large"),
        ("radio={", "--set radio={: not a value in TOML: {: "),
        ("faults.dead=[{uav=1", "--set faults.dead=[{uav=1: not a value in TOML: [{uav=1: "),
        (
            "map.corridor.centre_line_m=[[0,0],[5,0],[2,0]]",
            "corner 1 of the centre line, at (5, 0) m, goes back the way it came; turn by less than 180° there",
        ),
        ("duration_s.x=0", "--set duration_s.x=0: duration_s is a single value"),
        ("duration_s", "--set duration_s: expected key=value"),
        ("=3", "--set =3: expected key=value"),
        ("map={}", "--set map={}: map = { … }: expected one of the tables"),
        ("chain.base_m=[0, 9]", "--set chain.base_m=[0, 9]: chain.base_m = [0, 9]: the base is in rock"),
    ];
    for (set, wanted) in table {
        let got = message(PLAIN, &[set]);
        assert!(got.contains(wanted), "{set}\n  got    {got}\n  wanted {wanted}");
    }
}

/// Whatever is of the wrong kind, no message speaks of the library that read it.
#[test]
fn no_message_shows_a_librarys_inside() {
    const WORDS: [&str; 10] = [
        "invalid type",
        "invalid value",
        "invalid length",
        "wanted ",
        "another value",
        "struct ",
        "sequence",
        "usize",
        "f32",
        "inf m",
    ];
    let known = KnownKeys::of(&[Course::KEYS, Site::KEYS]);
    let keys = known.keys().map(|(table, key)| join(table, key.name));
    for key in keys.chain(known.tables().map(str::to_owned)).filter(|key| !key.is_empty()) {
        for value in [
            "5",
            "-5",
            "1e400",
            "true",
            "x",
            "\"\"",
            "[1]",
            "[[]]",
            "[{}]",
            "{}",
            "{a=1}",
            "1979-05-27",
            "[",
            "99999999999999999999",
        ] {
            let said = message(PLAIN, &[&format!("{key}={value}")]);
            let found = WORDS.iter().find(|word| said.contains(**word));
            assert!(found.is_none(), "{key}={value}: {said}");
        }
    }
}
