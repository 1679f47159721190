//! Lines of CSV, each with its number: comments and empty lines are passed over, and an error names the line as an editor
//! counts it.

/// Lines that hold something, from 1, a `#` at their beginning and what follows left out.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.split('\n').enumerate();
    lines
        .map(|(index, line)| (index + 1, line.trim_end_matches('\r')))
        .filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'))
}

/// The cells of a line, without the spaces around them; `None` where a quotation does not end.
pub(super) fn cells<'t>(line: &'t str, into: &mut Vec<&'t str>) -> Option<()> {
    into.clear();
    let mut rest = line;
    loop {
        let start = rest.trim_start();
        if let Some(quoted) = start.strip_prefix('"') {
            let end = quoted.find('"')?;
            into.push(quoted.get(..end)?.trim());
            let after = quoted.get(end + 1..)?.trim_start();
            if after.is_empty() {
                return Some(());
            }
            rest = after.strip_prefix(',')?;
        } else {
            let Some((cell, more)) = rest.split_once(',') else {
                into.push(rest.trim());
                return Some(());
            };
            into.push(cell.trim());
            rest = more;
        }
    }
}
