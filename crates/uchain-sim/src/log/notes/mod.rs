//! What is odd about a log and is read all the same, in a line each.

mod gaps;
mod grounded;
mod readings;

pub(super) use gaps::Gaps;
pub(super) use grounded::Grounded;
pub(super) use readings::Readings;

/// Cells with no number in them, by column: line of the first, and how many.
pub(super) fn no_numbers(label: &str, found: &[(&'static str, u64, u64)]) -> Vec<String> {
    let note = |(column, line, count): &(&str, u64, u64)| {
        let cells = if *count == 1 { "1 cell".to_owned() } else { format!("{count} cells") };
        // Of a distance that is a reading: four empty cells would leave it steering by the set before.
        let taken = if column.starts_with("tof_") {
            "with no number: a beam that sees nothing there"
        } else {
            "with no number, taken for not measured; such a cell is better left empty"
        };
        format!("{label}:{line}: {column}: {cells} {taken}")
    };
    found.iter().map(note).collect()
}
