use super::*;

fn axis(text: &str) -> Axis {
    Axis::table(text, "d.csv").unwrap_or_else(|error| panic!("{text:?}: {error}"))
}

/// All cells of a table, row by row, with their lines.
fn rows(text: &str) -> Vec<(String, Vec<Option<String>>)> {
    let axis = axis(text);
    let cells = |row| (0..axis.keys.len()).map(|key| axis.value(row, key).map(Cow::into_owned)).collect();
    (0..axis.len()).map(|row| (axis.origin(row, "").to_string(), cells(row))).collect()
}

fn refused(text: &str) -> String {
    match Axis::table(text, "d.csv") {
        Ok(axis) => panic!("{text:?} is read: {axis:?}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_table_gives_a_row_per_variant_and_says_which_line_is_wrong() {
    let axis = axis("chain.uavs, pilot.0.follow\n3,left\n\n4,\n");
    assert_eq!((axis.len(), axis.value(0, 1).as_deref(), axis.value(1, 1)), (2, Some("left"), None));
    assert_eq!(axis.origin(1, "").to_string(), "d.csv:4");
    for (text, place) in
        [("", "d.csv:1"), ("a,b\n", "d.csv:1"), ("a,,b\n1,2,3", "d.csv:1"), ("a,b\n1,2\n3\n", "d.csv:3")]
    {
        let message = refused(text);
        assert!(message.starts_with(place) && message.contains("expected"), "{message}");
    }
}

#[test]
fn an_empty_line_of_a_one_column_table_is_a_row_that_keeps_the_scenarios_value() {
    let some = |value: &str| vec![Some(value.to_owned())];
    let wanted = vec![
        ("d.csv:2".to_owned(), some("1")),
        ("d.csv:3".to_owned(), vec![None]),
        ("d.csv:4".to_owned(), some("2.5")),
        ("d.csv:5".to_owned(), vec![None]),
        ("d.csv:6".to_owned(), vec![None]),
    ];
    for end in ["\n", "\r\n", "\r"] {
        // polars writes nothing for null, pandas two quotes.
        for null in ["", "\"\"", " "] {
            let text = format!("a\n1.0\n{null}\n2.5\n{null}\n{null}\n").replace('\n', end);
            assert_eq!(rows(&text), wanted, "{text:?}");
        }
    }
    assert_eq!(rows("a\n\n1\n"), [("d.csv:2".to_owned(), vec![None]), ("d.csv:3".to_owned(), some("1"))]);
    assert_eq!(rows("a\n\n\n").len(), 2, "nothing but empty lines");
    assert_eq!(rows("a\n1\n2").len(), 2, "the last line may lack its end");
    // A line within quotes is none of the table's, and above the keys there are no rows.
    assert_eq!(
        rows("\n\na\n\"[1,\n\n2]\"\n\n3\n").iter().map(|(at, _)| &**at).collect::<Vec<_>>(),
        ["d.csv:4", "d.csv:7", "d.csv:8"]
    );
    // With several columns a null has its comma, and an empty line is none.
    assert_eq!(rows("a,b\n1,2\n\n,\n3,\n").len(), 3);
}

#[test]
fn what_is_clear_is_read_as_it_is_meant() {
    let plain = rows("chain.uavs,radio.sigma_db\n2,1.5\n3,2\n");
    let same = [
        "# chain.uavs,radio.sigma_db\n2.000000000000000000e+00,1.500000000000000000e+00\n3.0,2.0\n",
        "#chain.uavs,radio.sigma_db\n2,1.5\n3,2\n",
        "\u{feff}chain.uavs,radio.sigma_db\r\n2,1.5\r\n3,2\r\n",
        "\u{feff}# chain.uavs,radio.sigma_db\n2,1.5\n3,2",
        "\"chain.uavs\",\"radio.sigma_db\"\n\"2\",\"1.5\"\n\"3\",\"2\"\n",
        " chain.uavs , radio.sigma_db \n 2.0 , 1.5 \n 3.0,\t2 \n",
    ];
    for text in same {
        assert_eq!(rows(text), plain, "{text:?}");
    }
    let keys = |text: &str| axis(text).keys.into_iter().map(|key| key.name).collect::<Vec<_>>();
    assert_eq!(keys("# chain.uavs,radio . sigma_db\n2,1\n"), ["chain.uavs", "radio.sigma_db"]);
}

#[test]
fn what_is_not_clear_is_refused_at_its_line_for_what_it_is() {
    let table = [
        ("# made by me\nchain.uavs\n2\n", "d.csv:1: a comment; expected keys such as"),
        ("# a, b c\nchain.uavs,b\n2,3\n", "d.csv:1: a comment"),
        (",chain.uavs\n0,2\n", "d.csv:1: column 1 has no name, as the index of a data frame"),
        ("\"\",\"chain.uavs\"\n\"1\",2\n", "d.csv:1: column 1 has no name, as the index of a data frame"),
        ("Unnamed: 0,chain.uavs\n0,2\n", "d.csv:1: column 1 has no name"),
        ("chain.uavs,\n2,\n", "d.csv:1: column 2 has no name: is there a comma too many"),
        ("chain.uavs\tradio.sigma_db\n2\t1\n", "d.csv:1: columns are separated by tabs, expected commas"),
        ("chain.uavs;radio.sigma_db\n2;1,5\n", "d.csv:1: columns are separated by semicolons"),
        ("# chain.uavs radio.sigma_db\n2.0e+00 1.0e+00\n", "d.csv:1: columns are separated by spaces"),
        ("chain.uavs | radio.sigma_db\n2|1\n", "d.csv:1: columns are separated by bars"),
        ("2,3\n4,5\n", "d.csv:1: values without keys above them"),
        ("my column,chain.uavs\n2,3\n", "d.csv:1: column 1 is called 'my column'"),
        ("chain.uavs,radio.sigma_db\n2,1,\n", "d.csv:2: 3 cells, expected 2"),
        (
            "chain.uavs,radio.sigma_db\n2,1\n3,nan\n",
            "d.csv:3: radio.sigma_db = nan: no value; expected one, or an empty cell",
        ),
        ("chain.uavs\n2\n\nNA\n", "d.csv:4: chain.uavs = NA: no value"),
    ];
    for (text, wanted) in table {
        let message = refused(text);
        assert!(message.starts_with(wanted), "{text:?}\n  got    {message}\n  wanted {wanted}");
    }
}

#[test]
fn values_that_no_chunk_could_hold_are_refused() {
    let long = "1".repeat(VARIANT_MAX_BYTES / 2);
    let parse = |vary: &[String]| Design::parse(&DesignText { vary: vary.to_vec(), table: None }, "");
    assert!(parse(&[format!("a={long}")]).is_ok());
    let message =
        parse(&[format!("a={long}"), format!("b={long},1"), "c=12".to_owned()]).unwrap_err().to_string();
    assert_eq!(message, "the values of a variant have 65538 bytes: expected at most 65536");
}
