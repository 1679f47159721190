use std::fmt::Write as _;

use super::{make, params};
use crate::radio::RadioParams;

fn refused(bytes: &[u8]) -> String {
    let file = super::file(bytes);
    let error = make(&params(file.path())).unwrap_err().to_string();
    let name = format!("radio.table_file: {}: ", file.path().display());
    error.strip_prefix(&name).unwrap_or_else(|| panic!("{error}")).to_owned()
}

#[test]
fn what_is_no_table_is_refused_by_line_column_and_what_was_expected() {
    let header = "x1_m,y1_m,x2_m,y2_m,loss_db";
    let body = |rows: &str| format!("{header}\n{rows}");
    let far = "a coordinate in metres, at most 1e9 from the origin";
    let decibels = "decibels from -50 to 2000, or nothing for no link";
    let cases = [
        (String::new(), format!("line 1: \"\": expected {header}")),
        ("a,b\n".to_owned(), format!("line 1: \"a,b\": expected {header}")),
        (header.to_owned(), "0 places: expected two or more".to_owned()),
        (body("0,0,1,0\n"), "line 2: 4 cells: expected 5, as many as there are columns".to_owned()),
        (body("0,0,1,0,5,5\n"), "line 2: 6 cells: expected 5, as many as there are columns".to_owned()),
        (body("0,0,1,0,50\n\n0,x,1,0,50\n"), format!("line 4, y1_m = \"x\": expected {far}")),
        (body("0,0,1e10,0,50\n"), format!("line 2, x2_m = \"1e10\": expected {far}")),
        (body("0,0,1,NaN,50\n"), format!("line 2, y2_m = \"NaN\": expected {far}")),
        (body("0,0,1,0,nan\n"), format!("line 2, loss_db = \"nan\": expected {decibels}")),
        (body("0,0,1,0,inf\n"), format!("line 2, loss_db = \"inf\": expected {decibels}")),
        (body("0,0,1,0,-51\n"), format!("line 2, loss_db = \"-51\": expected {decibels}")),
        (body("0,0,0,0,50\n"), "1 places: expected two or more".to_owned()),
        (body("0,0,1,0,\n"), "no pair of places has a loss".to_owned()),
        (
            body("0,0,1,0,50\n1,0,0,0,50.002\n"),
            "line 3, loss_db = 50.002: the same two places have 50 in another line; expected the same both ways, within \
             0.001 dB"
                .to_owned(),
        ),
        (
            body("0,0,1,0,50\n0,0,2.4,0,50\n0,0,3.4,0,50\n"),
            "x = 1 m lies on no grid that begins at 0 m with steps of 1 m".to_owned(),
        ),
        (
            body("0,0,0.001,0,50\n0,0,1e9,0,50\n"),
            "x: a grid of 1000000000001 lines, expected at most 4194304: are its places evenly spaced?".to_owned(),
        ),
        (
            body("0,0,1,1,50\n0,0,2000,2000,50\n"),
            "x and y: a grid of 4004001 lines, expected at most 1048576: are its places evenly spaced?".to_owned(),
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(refused(text.as_bytes()), expected, "{text}");
    }
    let not_text = "not text from byte 1 on: expected CSV, or NPZ as numpy.savez writes it";
    assert_eq!(refused(b"x\xff"), not_text);
}

#[test]
fn a_table_with_too_many_places_or_bytes_is_refused() {
    let line = |places: u32| {
        let mut text = "x1_m,y1_m,x2_m,y2_m,loss_db\n".to_owned();
        (1..places).for_each(|x_m| writeln!(text, "0,0,{x_m},0,50").unwrap());
        text
    };
    let file = super::file(line(2048).as_bytes());
    assert!(make(&params(file.path())).is_ok(), "the control");
    for places in [2049, 10_000] {
        let error = refused(line(places).as_bytes());
        assert!(error.starts_with("more than 2048 places, whose pairs are 4194304"), "{error}");
    }
    let long = super::file(b"");
    long.as_file().set_len((64 << 20) + 1).unwrap();
    let error = make(&params(long.path())).unwrap_err().to_string();
    assert!(error.ends_with("longer than 67108864 bytes"), "{error}");
}

#[test]
fn a_file_that_is_not_there_or_not_named_is_said() {
    let missing = make(&params("/no/such/losses.csv".as_ref())).unwrap_err().to_string();
    assert!(missing.starts_with("radio.table_file: /no/such/losses.csv: cannot be read: "), "{missing}");
    let unnamed = make(&RadioParams { model: "table".to_owned(), ..RadioParams::default() }).unwrap_err();
    let expected = "radio.table_file = nothing: the model \"table\" needs a file, such as \"losses.csv\"";
    assert_eq!(unnamed.to_string(), expected);
}
