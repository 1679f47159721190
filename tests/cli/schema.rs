use std::fs;

use boon::{Compiler, SchemaIndex, Schemas};
use serde_json::Value;

use crate::{folder, stderr, stdout, uchain, with_preset};

/// What `uchain schema` prints, in the hands of an independent validator.
struct Judge {
    schemas: Schemas,
    schema: SchemaIndex,
}

impl Judge {
    fn new() -> Self {
        let here = folder();
        let printed = uchain(here.path(), &["schema"]);
        let schema: Value = serde_json::from_str(stdout(&printed)).unwrap();
        let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
        compiler.add_resource("uchain.schema.json", schema).unwrap();
        let schema = compiler.compile("uchain.schema.json", &mut schemas).unwrap();
        Self { schemas, schema }
    }

    fn refuses(&self, toml: &str) -> Option<String> {
        let table: toml::Table = toml.parse().unwrap();
        let json = serde_json::to_value(table).unwrap();
        self.schemas.validate(&json, self.schema).err().map(|error| error.to_string())
    }
}

fn shown(args: &[&str]) -> String {
    stdout(&uchain(folder().path(), &[&["show"], args].concat())).to_owned()
}

#[test]
fn every_scenario_and_preset_that_comes_along_fits_the_schema_and_names_it_for_editors() {
    let judge = Judge::new();
    let list = uchain(folder().path(), &["list"]);
    let names: Vec<&str> = stdout(&list).lines().filter_map(|line| line.split(' ').next()).collect();
    let (presets, scenarios): (Vec<&str>, Vec<&str>) = names.iter().partition(|name| name.contains('='));
    assert!(scenarios.len() >= 8 && presets.len() >= 2, "{names:?}");
    for name in scenarios {
        let text = shown(&[name]);
        assert_eq!(judge.refuses(&text), None, "{name}");
        assert!(
            text.starts_with("#:schema ./uchain.schema.json\n# For editors: `uchain schema > uch"),
            "{name}"
        );
    }
    for preset in presets {
        let name = preset.trim_start_matches("preset=");
        let text = with_preset(&shown(&["straight"]), &shown(&["--preset", name]));
        assert_eq!(judge.refuses(&format!("preset = \"{name}\"\n{text}")), None, "{name}");
    }
}

/// Lines put before the pilot of `straight`, and whether they are right.
const CASES: &[(&str, bool)] = &[
    ("", true),
    ("[equalize]\nk_db_per_m = 20\nlaw = \"bang-bang\"", true),
    ("[radio]\nsigma_db = 0\nantenna_db = 100.0", true),
    ("[faults]\ndeaf = [{ uav = 0, side = \"back\" }]\ndead = [{ uav = 1, start_s = 3.5 }]", true),
    ("[[faults.deaf]]\nuav = 1\nside = \"front\"\nstart_s = 1.0\nstop_s = 2.0", true),
    // Unknown keys and tables.
    ("[equalize]\nk_db_per_n = 20.0", false),
    ("[equalise]", false),
    ("[faults]\ndead = [{ uav = 1, start_s = 3.5, stop_s = 4.0 }]", false),
    // Wrong types.
    ("[equalize]\nk_db_per_m = \"20\"", false),
    ("[equalize]\nspacing = 1", false),
    ("[tof]\nrays = 2.5", false),
    ("[equalize]\ndecision_s = [0.2]", false),
    ("radio = 3", false),
    // Out of range.
    ("[equalize]\nk_db_per_m = 0", false),
    ("[tof]\nrays = 65", false),
    ("[packets]\ndelay_ticks = -1", false),
    ("[radio]\nalpha_free = 20.5", false),
    ("[faults]\ndead = [{ uav = 1, start_s = -3.5 }]", false),
    // Wrong words, missing keys.
    ("[equalize]\nlaw = \"Lipschitz\"", false),
    ("[center]\nlaw = \"lipschitz\"", false),
    ("[faults]\ndeaf = [{ uav = 0 }]", false),
    // A chain explores nothing.
    ("[explore]\nspawns_m = [[1, 0]]", false),
];

/// Whole lines of `apartment` written anew, and whether they are right.
const EXPLORATIONS: &[(&str, &str, bool)] = &[
    ("robots = 3", "robots = 2\nr_s_m = 2\nrange_m = 8.5\nedges = \"eq8\"", true),
    ("robots = 3", "robots = 0", false),
    ("robots = 3", "robots = 2.5", false),
    ("robots = 3", "robot = 3", false),
    ("robots = 3", "sectors = 361", false),
    ("robots = 3", "range_m = -1", false),
    ("strategy = \"cssg\"", "strategy = \"csg\"", false),
    ("[[2.25, 5.0], ", "[[2.25], ", false),
    ("[map.walls]", "[map.wall]", false),
    ("[explore]", "[link]\nlost_s = 1.0\n[explore]", false),
    ("[explore]", "[radio]\nsigma_db = 1.0\n[packets]\ndrop_rate = 0\n[explore]", true),
    ("[explore]", "[radio]\nsigma_db = -1.0\n[explore]", false),
    ("[explore]", "[packets]\ndrop_rat = 0\n[explore]", false),
    ("[explore]", "[chain]\nuavs = 2\nbase_m = [0, 5]\n[explore]", false),
    ("[explore]", "[expolre]", false),
];

/// Whole lines of `straight` written anew, all wrong.
const BAD_LINES: &[(&str, &str)] = &[
    ("name = \"straight\"", "name = \"../up\""),
    ("name = \"straight\"", "name = \"straight\"\npreset = \"cave\""),
    ("name = \"straight\"\n", ""),
    ("duration_s = 120.0", "duration_s = 86401"),
    ("uavs = 4", "uavs = 0"),
    ("uavs = 4", "uavs = 4\nspawns_m = [[0.5]]"),
    ("base_m = [0.5, 0.0]", "base_m = [0.5, 0.0, 1.0]"),
    ("base_m = [0.5, 0.0]", "base_m = [0.5, 2e9]"),
    ("[14.0, 0.0]]", "[14.0]]"),
    ("[14.0, 0.0]]", "[14.0, 0.0, -1.0]]"),
    ("[map.corridor]", "[map.ros]\nfile = \"x.yaml\"\n[map.corridor]"),
    ("[map.corridor]", "[map.corridoor]"),
    ("speed_mps = 0.2", "speed_mps = 1.5"),
    ("speed_mps = 0.2", "speed_mps = 0.2\nfollow = \"up\""),
];

#[test]
fn the_schema_refuses_what_the_reader_refuses_and_takes_what_it_takes() {
    let (judge, here) = (Judge::new(), folder());
    let straight = shown(&["straight"]);
    let first_table = "[map.corridor]";
    let with = |(lines, is_right): &(&str, bool)| {
        // A bare key stands above all tables.
        let at = if lines.starts_with('[') { "[[pilot]]" } else { first_table };
        (straight.replacen(at, &format!("{lines}\n{at}"), 1), *is_right)
    };
    let without = |(old, new): &(&str, &str)| {
        assert!(straight.contains(old), "{old}");
        (straight.replacen(old, new, 1), false)
    };
    let apartment = shown(&["apartment"]);
    let exploring = |(old, new, is_right): &(&str, &str, bool)| {
        assert!(apartment.contains(old), "{old}");
        (apartment.replacen(old, new, 1), *is_right)
    };
    let chains = CASES.iter().map(with).chain(BAD_LINES.iter().map(without));
    for (text, is_right) in chains.chain(EXPLORATIONS.iter().map(exploring)) {
        fs::write(here.path().join("mine.toml"), &text).unwrap();
        let read = uchain(here.path(), &["check", "mine.toml", "--quiet"]);
        let code = if is_right { 0 } else { 3 };
        assert_eq!((read.status.code(), stdout(&read)), (Some(code), ""), "{}\n{text}", stderr(&read));
        assert_eq!(judge.refuses(&text).is_none(), is_right, "{:?}\n{text}", judge.refuses(&text));
    }
}
