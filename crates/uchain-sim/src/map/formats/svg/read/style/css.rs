//! Style sheets within a drawing: rules for elements by tag, class or id, as drawing programs write them.

use std::collections::BTreeMap;

/// Most bytes of all style sheets together.
const MOST_BYTES: usize = 1 << 18;

/// Declarations by selector: `*`, `tag`, `.class`, `tag.class` or `#id`.
#[derive(Debug, Default)]
pub(in super::super) struct Sheet<'a> {
    rules: BTreeMap<&'a str, Vec<(&'a str, &'a str)>>,
    bytes: usize,
    /// Selectors that are none of these.
    pub(in super::super) strange: usize,
}

impl<'a> Sheet<'a> {
    /// Takes the rules of one more sheet, or says what is wrong with it.
    pub(in super::super) fn take(&mut self, text: &'a str) -> Result<(), String> {
        self.bytes += text.len();
        if self.bytes > MOST_BYTES {
            return Err(format!(
                "more than {MOST_BYTES} bytes of style sheets; expected fewer: save it as plain SVG"
            ));
        }
        let mut rest = text;
        while let Some(open) = rest.find('{') {
            let selectors = after_comments(&rest[..open]);
            let close = rest[open..].find('}').map_or(rest.len(), |close| open + close);
            let body = &rest[open + 1..close.max(open + 1)];
            rest = rest.get(close + 1..).unwrap_or_default();
            for selector in selectors.split(',').map(str::trim).filter(|selector| !selector.is_empty()) {
                if is_simple(selector) {
                    self.rules.entry(selector).or_default().extend(declarations(body));
                } else {
                    self.strange += 1;
                }
            }
        }
        Ok(())
    }

    /// What the sheets say of an element, the weightiest last.
    pub(in super::super) fn of<'s>(
        &'s self,
        tag: &'s str,
        classes: &'s str,
        id: &'s str,
    ) -> impl Iterator<Item = (&'a str, &'a str)> + 's {
        let classes = || classes.split_whitespace().take(20);
        let names = ["*".to_owned(), tag.to_owned()].into_iter();
        let names = names.chain(classes().map(|class| format!(".{class}")));
        let names = names.chain(classes().map(move |class| format!("{tag}.{class}")));
        let names = names.chain([format!("#{id}")]);
        names.flat_map(|name| self.rules.get(name.as_str()).into_iter().flatten().copied())
    }

    pub(in super::super) fn is_empty(&self) -> bool {
        self.rules.is_empty()
    }
}

/// `name: value; name: value`.
pub(in super::super) fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let pairs = text.split(';').filter_map(|pair| pair.split_once(':'));
    pairs.map(|(name, value)| (name.trim(), value.trim().trim_end_matches("!important").trim_end()))
}

/// What follows the last comment.
fn after_comments(text: &str) -> &str {
    text.rfind("*/").map_or(text, |end| &text[end + 2..]).trim()
}

fn is_simple(selector: &str) -> bool {
    let word = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
    let rest = selector.trim_start_matches(word);
    let rest = rest.strip_prefix(['.', '#']).unwrap_or(rest);
    selector == "*" || rest.chars().all(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_by_tag_class_and_id_count_in_this_order_and_others_are_counted() {
        let mut sheet = Sheet::default();
        sheet
            .take("/* x */ #a{fill:none} path, .b { fill : red; stroke:blue!important } g > .c{fill:green}")
            .unwrap();
        let of: Vec<_> = sheet.of("path", "b other", "a").collect();
        assert_eq!(
            of,
            [("fill", "red"), ("stroke", "blue"), ("fill", "red"), ("stroke", "blue"), ("fill", "none")]
        );
        assert_eq!(sheet.of("g", "c", "").count(), 0);
        assert_eq!(sheet.strange, 1);
        for odd in ["{", "}", "a{", "a{b", "a{b:", "@media x{a{b:c}}", "/*", "*/{}", "a{}}{"] {
            Sheet::default().take(odd).unwrap();
        }
        assert!(Sheet::default().take(&"a{}".repeat(100_000)).is_err());
    }
}
