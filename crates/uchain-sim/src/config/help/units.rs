//! Units, by the suffix of a key's name.

/// A unit of measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unit {
    /// As in formulae: `dB/m`.
    pub symbol: &'static str,
    /// In words: decibels per metre.
    pub words: &'static str,
}

/// What stands at the end of a key's name, the longer before the shorter.
const SUFFIXES: [(&str, Unit); 18] = [
    ("_db2_per_s", Unit { symbol: "dB²/s", words: "decibels squared per second" }),
    ("_rad_per_s_m", Unit { symbol: "rad/(s·m)", words: "radians per second and metre" }),
    ("_db_per_m", Unit { symbol: "dB/m", words: "decibels per metre" }),
    ("_per_s2", Unit { symbol: "1/s²", words: "per second squared" }),
    ("_per_s", Unit { symbol: "1/s", words: "per second" }),
    ("_radps", Unit { symbol: "rad/s", words: "radians per second" }),
    ("_mps2", Unit { symbol: "m/s²", words: "metres per second squared" }),
    ("_mps", Unit { symbol: "m/s", words: "metres per second" }),
    ("_db2", Unit { symbol: "dB²", words: "decibels squared" }),
    ("_ticks", Unit { symbol: "ticks of 0.05 s", words: "ticks of 0.05 seconds" }),
    ("_packets", Unit { symbol: "packets", words: "packets" }),
    ("_deg", Unit { symbol: "degrees", words: "degrees" }),
    ("_rad", Unit { symbol: "rad", words: "radians" }),
    ("_mhz", Unit { symbol: "MHz", words: "megahertz" }),
    ("_kg", Unit { symbol: "kg", words: "kilograms" }),
    ("_db", Unit { symbol: "dB", words: "decibels" }),
    ("_m", Unit { symbol: "m", words: "metres" }),
    ("_s", Unit { symbol: "s", words: "seconds" }),
];

/// The unit of a number with this name; `None` for a pure number.
pub(super) fn unit(name: &str) -> Option<Unit> {
    SUFFIXES.iter().find(|(suffix, _)| name.ends_with(suffix)).map(|(_, unit)| *unit)
}
