//! The columns a log of losses may have.

use std::fmt::Write as _;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Of {
    Rssi,
    Loss,
    Distance,
    /// x, y, z of the first end, then of the second.
    End(usize),
    Seq,
    Link,
    Walk,
}

/// A column that a log may have.
#[derive(Debug)]
pub(super) struct Column {
    pub(super) name: &'static str,
    pub(super) of: Of,
    /// Smallest and largest number that is no mistake of unit or sign, and what to do about it.
    pub(super) sound: (f64, f64, &'static str),
    about: &'static str,
}

const FAR_M: f64 = 1e6;
const METRES: (f64, f64, &str) =
    (-FAR_M, FAR_M, "expected metres; from millimetres: --columns OURS=THEIRS*0.001");

const fn column(name: &'static str, of: Of, sound: (f64, f64, &'static str), about: &'static str) -> Column {
    Column { name, of, sound, about }
}

/// All columns.
pub(super) const COLUMNS: &[Column] = &[
    column(
        "rssi_dbm",
        Of::Rssi,
        (-200.0, 40.0, "is it without its minus? then the column is loss_db: --columns loss_db=THEIRS"),
        "received power; empty or nan: sent and not heard. This or the next one must be there",
    ),
    column(
        "loss_db",
        Of::Loss,
        (
            -40.0,
            400.0,
            "is it a received power in dBm? then the column is rssi_dbm: --columns rssi_dbm=THEIRS",
        ),
        "instead of it: what the link lost, positive; empty or nan: sent and not heard",
    ),
    column(
        "distance_m",
        Of::Distance,
        (0.0, FAR_M, "expected metres, from 0; from centimetres: --columns distance_m=THEIRS*0.01"),
        "between the two ends. This or the places of both ends must be there; places tell more",
    ),
    column("x1_m", Of::End(0), METRES, "where one end is; x_m is the same"),
    column("y1_m", Of::End(1), METRES, "y_m is the same"),
    column("z1_m", Of::End(2), METRES, "counts if the other end's is there as well"),
    column("x2_m", Of::End(3), METRES, "where the other end is; or --anchors FILE says it by link"),
    column("y2_m", Of::End(4), METRES, ""),
    column("z2_m", Of::End(5), METRES, ""),
    column(
        "seq",
        Of::Seq,
        (0.0, 9e15, "expected a whole number, counted up by one at every packet that is sent"),
        "number of the packet, by link and walk: a gap is packets that were not heard",
    ),
    column("link", Of::Link, (0.0, 0.0, ""), "a name for who hears whom; empty: all one link"),
    column("walk", Of::Walk, (0.0, 0.0, ""), "a name for a part of the log; seq starts anew in each"),
];

/// Other names that are understood.
const ALIASES: [(&str, &str); 7] = [
    ("x_m", "x1_m"),
    ("y_m", "y1_m"),
    ("z_m", "z1_m"),
    ("anchor_x_m", "x2_m"),
    ("anchor_y_m", "y2_m"),
    ("anchor_z_m", "z2_m"),
    ("anchor", "link"),
];

/// The column of this name.
pub(super) fn find(name: &str) -> Option<&'static Column> {
    let name = ALIASES.iter().find(|(alias, _)| *alias == name).map_or(name, |(_, name)| name);
    COLUMNS.iter().find(|column| column.name == name)
}

/// All columns with what each means, for people.
pub fn about_columns() -> String {
    let mut text = String::new();
    for Column { name, about, .. } in COLUMNS {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {}", format!("{name:<12}{about}").trim_end());
    }
    text
}

/// A log of three rows, for a radio to go on with.
pub fn template() -> String {
    "# A log for `uchain radio fit`: a row for every packet that was sent; an empty rssi_dbm is one that was not heard.\n\
     # Walk slowly, many packets a metre, out and back, from where the link is good to where it ends.\n\
     rssi_dbm,x1_m,y1_m,x2_m,y2_m,seq,link\n\
     -41.0,1.00,0.00,0.00,0.00,0,base\n\
     -43.5,1.05,0.00,0.00,0.00,1,base\n\
     ,1.10,0.00,0.00,0.00,2,base\n"
        .to_owned()
}
