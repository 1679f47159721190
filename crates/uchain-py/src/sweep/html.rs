//! A table as a notebook shows it.

use uchain_sim::{
    analyse::{Column, Kind},
    sweep::table::Table,
};

/// Most rows that are shown.
const ROWS: usize = 10;

/// The first rows of a table, lists left out.
pub(super) fn of(table: &Table, title: &str) -> String {
    let is_short = |(_, column): &(usize, &Column)| !matches!(column.kind, Kind::Numbers | Kind::Singles);
    let columns: Vec<(usize, &Column)> = table.columns().iter().enumerate().filter(is_short).collect();
    let heads: Vec<String> =
        columns.iter().map(|(_, column)| format!("<th>{}</th>", escaped(&column.name))).collect();
    let heads = heads.concat();
    let rows = table.blocks().iter().flat_map(|block| (0..block.rows()).map(move |row| (block, row)));
    let rows: Vec<String> = rows
        .take(ROWS)
        .map(|(block, row)| {
            let cell = |(place, _): &(usize, &Column)| {
                let cell = block.values().get(*place).map(|values| values.cell(row));
                let text = cell.as_ref().and_then(|cell| {
                    cell.text().map(str::to_owned).or_else(|| cell.number().map(|number| number.to_string()))
                });
                format!("<td>{}</td>", escaped(&text.unwrap_or_default()))
            };
            format!("<tr>{}</tr>", columns.iter().map(cell).collect::<Vec<_>>().concat())
        })
        .collect();
    let (title, rows) = (escaped(title), rows.concat());
    format!(
        "<div style=\"overflow-x:auto\"><p>{title}</p><table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>"
    )
}

/// Words that may stand in HTML.
fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
