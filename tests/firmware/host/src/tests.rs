use replay::{
    Cause, Fault,
    rows::{FLOWN, Flown, RowWriter},
};

use crate::compare::{Differences, Unlike, compare};

/// The place of a field in a row.
fn at(name: &str) -> usize {
    FLOWN.iter().position(|field| field.name == name).unwrap()
}

/// A result of these rows.
fn result(rows: &[Flown]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = RowWriter::begin(&mut bytes);
    writer.mission("circuit");
    for row in rows {
        writer.flown(row);
    }
    writer.end();
    bytes
}

/// Two UAVs at two ticks.
fn rows() -> Vec<Flown> {
    let row = |tick, uav| {
        let mut row = [1.0_f32.to_bits(); FLOWN.len()];
        (row[0], row[1]) = (tick, uav);
        row
    };
    vec![row(0, 0), row(0, 1), row(1, 0), row(1, 1)]
}

fn compared(ours: &[Flown], theirs: &[Flown]) -> Result<Differences, Unlike> {
    compare(&mut result(ours).as_slice(), &mut result(theirs).as_slice())
}

#[test]
fn equal_results_have_no_difference() {
    let found = compared(&rows(), &rows()).unwrap();
    assert_eq!(found, Differences { ticks: 4, ..Differences::default() });
}

#[test]
fn one_bit_of_a_state_is_found_and_named_with_mission_tick_and_uav() {
    let mut theirs = rows();
    theirs[3][at("back.variance_db2")] += 1;
    let found = compared(&rows(), &theirs).unwrap();
    assert_eq!((found.rows, found.commands, found.states), (1, 0, 1));
    assert_eq!(
        found.first.unwrap().to_string(),
        "circuit, tick 1, uav 1, back.variance_db2: 0x3f800001 (1.0000001), where the host has 0x3f800000 (1)"
    );
}

#[test]
fn a_command_that_differs_is_told_from_a_state_and_the_first_one_is_named() {
    let mut theirs = rows();
    theirs[1][at("airborne")] = 0;
    theirs[2][at("forward_mps")] ^= 1 << 31;
    theirs[2][at("walls")] = 7;
    let found = compared(&rows(), &theirs).unwrap();
    assert_eq!((found.rows, found.commands, found.states), (2, 2, 1));
    assert!(found.first.unwrap().to_string().contains("tick 0, uav 1, airborne: 0x00000000 (0)"));
}

#[test]
fn results_of_other_flights_are_not_compared() {
    assert_eq!(compared(&rows(), &rows()[..3]), Err(Unlike::Row(3)));
    assert_eq!(compared(&rows()[..3], &rows()), Err(Unlike::Row(3)));
    let mut other = rows();
    other[2][at("tick")] = 9;
    assert_eq!(compared(&rows(), &other), Err(Unlike::Row(2)));
}

#[test]
fn a_result_that_ends_early_is_a_fault_and_not_equal() {
    let theirs = result(&rows());
    for length in 0..theirs.len() {
        let cut = compare(&mut result(&rows()).as_slice(), &mut &theirs[..length]);
        assert!(matches!(cut, Err(Unlike::Theirs(Fault { cause: Cause::Short, .. }))), "{length}: {cut:?}");
    }
}
