use super::*;

fn log(text: &str) -> Result<Log, String> {
    Log::of(text, "log.csv", None, &ReadOptions::default()).map_err(|error| error.to_string())
}

fn mapped(text: &str, mapping: &str, anchors: Option<&str>) -> Result<Log, String> {
    let options = ReadOptions { mapping: mapping.parse()?, ..ReadOptions::default() };
    Log::of(text, "log.csv", anchors.map(|text| (text, "anchors.csv")), &options)
        .map_err(|error| error.to_string())
}

#[test]
fn the_template_is_a_log_of_two_heard_packets_and_a_lost_one() {
    let log = log(&template()).unwrap();
    assert_eq!((log.samples.len(), log.heard(), log.has_places), (3, 2, true));
    assert_eq!(log.samples[0].loss_db, Some(41.0));
    assert_eq!((log.samples[2].line, log.samples[2].loss_db, log.samples[2].distance_m), (6, None, 1.1));
    assert_eq!(log.links, ["base"]);
}

#[test]
fn a_gap_in_seq_is_packets_that_were_not_heard_on_the_way_between() {
    let log = log(
        "loss_db,x_m,y_m,anchor_x_m,anchor_y_m,seq,walk\n40,1,0,0,0,7,a\n46,4,0,0,0,10,a\n50,1,0,0,0,0,b\n",
    )
    .unwrap();
    let told: Vec<_> = log.samples.iter().map(|sample| (sample.loss_db, sample.distance_m)).collect();
    assert_eq!(told, [(Some(40.0), 1.0), (None, 2.0), (None, 3.0), (Some(46.0), 4.0), (Some(50.0), 1.0)]);
    assert!(log.notes.iter().any(|note| note.starts_with("2 packets were not heard")), "{:?}", log.notes);
}

#[test]
fn somebody_elses_columns_are_read_without_a_copy() {
    let wide = "n,x,y,rssi_a,rssi_b,extra\n0,3,4,-50,,x\n1,0,3,nan,-61,x\n";
    let anchors = "id,x,y,z\na,0,0,2\nb,0,0,2\n";
    let log = mapped(wide, "x1_m=x,y1_m=y,rssi_dbm=rssi_*", Some(anchors)).unwrap();
    assert_eq!(log.links, ["a", "b"]);
    let told: Vec<_> = log.samples.iter().map(|s| (s.link, s.loss_db, s.distance_m)).collect();
    assert_eq!(told, [(0, Some(50.0), 5.0), (1, None, 5.0), (0, None, 3.0), (1, Some(61.0), 3.0)]);
    let raised = mapped(wide, "x1_m=x,y1_m=y,z1_m=2,rssi_dbm=rssi_*", Some(anchors)).unwrap();
    assert_eq!(raised.samples[0].distance_m, 5.0, "both 2 m high");
    let floor = mapped(wide, "x1_m=x,y1_m=y,z1_m=14,rssi_dbm=rssi_*", Some(anchors)).unwrap();
    assert_eq!(floor.samples[0].distance_m, 13.0, "5 m across, 12 m up");
    let cm = mapped("d,power\n150,-40\n", "distance_m=d*0.01,rssi_dbm=power", None).unwrap();
    assert_eq!((cm.samples[0].distance_m, cm.samples[0].loss_db), (1.5, Some(40.0)));
}

#[test]
fn what_is_wrong_is_said_with_line_column_and_remedy() {
    let cases = [
        ("", "log.csv: empty: expected a table"),
        (
            "rsi_dbm,distance_m\n-4,2\n",
            "log.csv:1: no column rssi_dbm or loss_db; did you mean 'rssi_dbm' by 'rsi_dbm'?",
        ),
        ("rssi_dbm,x_m,y_m\n-4,2,1\n", "log.csv:1: x1_m and y1_m are there, but not where the other end is"),
        ("rssi_dbm,loss_db,distance_m\n-4,4,2\n", "are one thing"),
        ("rssi_dbm,distance_m\n-40\n", "log.csv:2: 1 cells: expected 2"),
        ("rssi_dbm,distance_m\n# a remark\n\n57,2\n", "log.csv:4: rssi_dbm = 57: is it without its minus?"),
        ("loss_db,distance_m\n-57,2\n", "log.csv:2: loss_db = -57: is it a received power in dBm?"),
        ("loss_db,distance_m\nabc,2\n", "log.csv:2: loss_db = abc: expected a number"),
        ("loss_db,distance_m\n40,-2\n", "log.csv:2: distance_m = -2: expected metres, from 0"),
        ("loss_db,distance_m\n\"40,-2\n", "log.csv:2: a quotation that does not end"),
        ("1,2,3\n4,5,6\n", "numbers only: expected a first line with names"),
        ("loss_db;distance_m\n4;5\n", "cells between semicolons: expected commas"),
    ];
    for (text, expected) in cases {
        let error = log(text).unwrap_err();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    let error = mapped("d,rssi\n1,-2\n", "distance_m=dd,rssi_dbm=rssi", None).unwrap_err();
    assert!(error.contains("no column is called 'dd'"), "{error}");
    let error =
        mapped("x,y,link,r\n1,2,c,-3\n", "x1_m=x,y1_m=y,rssi_dbm=r", Some("id,x,y\na,0,0\n")).unwrap_err();
    assert!(error.contains("log.csv:2: no anchor 'c' in anchors.csv: it has a"), "{error}");
    for wrong in ["distance=d", "distance_m", "distance_m=a*b*", "distance_m=inf", "loss_db=a,loss_db=b"] {
        assert!(wrong.parse::<Mapping>().is_err(), "{wrong}");
    }
}

#[test]
fn no_text_makes_it_panic() {
    let base = "loss_db,x_m,y_m,anchor_x_m,anchor_y_m,seq,walk\n40,1,0,0,0,7,a\n46,4,0,0,0,10,a\n";
    for cut in 0..base.len() {
        let _ = log(&base[..cut]);
        for byte in ["\"", ",", "\n", "-", "9e99", "nan", "\u{feff}", "#", "é"] {
            let _ = log(&format!("{}{byte}{}", &base[..cut], &base[cut..]));
        }
    }
}
