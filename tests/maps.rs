//! A map that somebody drew is flown in.

use uchain_sim::{config::Source, run::run};

use crate::lay;

#[test]
fn a_chain_flies_round_the_bend_of_a_mine_drawn_in_svg_to_its_face() {
    let course = lay(&Source::find("examples/maps/mine.toml").unwrap(), &[]);
    let map = &course.map;
    let import = map.import();
    assert_eq!((import.format, map.places().len()), ("SVG", 2), "{import:?}");
    let said: Vec<String> = import.remarks.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|said| said.contains("1:200 by scale")), "{said:?}");
    assert!(said.iter().any(|said| said.starts_with("dropped 1 elements called notes")), "{said:?}");
    let summary = run(&course, 1, &mut ()).unwrap();
    assert!(summary.head_reach_m > 50.0, "{summary:?}");
    assert!(summary.connected_fraction >= Some(0.95), "{summary:?}");
}
