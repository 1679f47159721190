//! What programs on the chip print: lines of a name and numbers.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result};

/// Numbers by name, line by line where a name comes more than once.
#[derive(Debug, Clone, Default)]
pub(crate) struct Figures(BTreeMap<String, Vec<Vec<u64>>>);

impl Figures {
    /// Takes in what a program printed. A line begins with its name, in words, and goes on with numbers; others are for
    /// people.
    pub(crate) fn read(&mut self, printed: &str) {
        for line in printed.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let first = words.iter().position(|word| word.parse::<u64>().is_ok()).unwrap_or(words.len());
            let (name, numbers) = words.split_at(first);
            let numbers: Option<Vec<u64>> = numbers.iter().map(|word| word.parse().ok()).collect();
            if let Some(numbers) = numbers.filter(|numbers| !numbers.is_empty() && !name.is_empty()) {
                self.0.entry(name.join(" ")).or_default().push(numbers);
            }
        }
    }

    /// A figure that was worked out here.
    pub(crate) fn put(&mut self, name: &str, number: u64) {
        self.0.entry(name.to_owned()).or_default().push(vec![number]);
    }

    /// A number of the first line of this name.
    pub(crate) fn at(&self, name: &str, column: usize) -> Result<u64> {
        self.in_line(name, 0, column)
    }

    /// A number of the line of this name that comes after `line` others of it.
    pub(crate) fn in_line(&self, name: &str, line: usize, column: usize) -> Result<u64> {
        let numbers = self.0.get(name).and_then(|lines| lines.get(line));
        let number = numbers.and_then(|numbers| numbers.get(column));
        number
            .copied()
            .with_context(|| format!("the chip said nothing of `{name}`, line {line}, number {column}"))
    }

    /// The largest of these numbers of all lines of this name.
    pub(crate) fn most_in(&self, name: &str, column: usize) -> Result<u64> {
        let lines = self.0.get(name).into_iter().flatten();
        let most = lines.filter_map(|numbers| numbers.get(column)).max();
        most.copied().with_context(|| format!("the chip said nothing of `{name}`, number {column}"))
    }

    /// The largest of the first numbers of all lines whose names begin like this.
    pub(crate) fn most(&self, prefix: &str) -> Result<u64> {
        let lines = self.0.iter().filter(|(name, _)| name.starts_with(prefix)).flat_map(|(_, lines)| lines);
        let most = lines.filter_map(|numbers| numbers.first()).max();
        most.copied().with_context(|| format!("the chip said nothing of `{prefix}…`"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_a_name_and_numbers_and_others_are_passed_over() {
        let mut figures = Figures::default();
        figures.read(
            "size_of Node 372\ncall say 10 20 30\nfor people\nexplored 1 2\nexplored 3 4\n7 8\nit 9 is\n",
        );
        assert_eq!(figures.at("size_of Node", 0).unwrap(), 372);
        assert_eq!(figures.at("call say", 2).unwrap(), 30);
        assert_eq!(figures.in_line("explored", 1, 1).unwrap(), 4);
        assert_eq!(figures.most_in("explored", 1).unwrap(), 4);
        assert!(figures.most_in("explored", 2).is_err() && figures.most_in("heap", 0).is_err());
        assert_eq!(figures.0.len(), 3);
        let missing = figures.at("call say", 3).unwrap_err().to_string();
        assert!(missing.contains("`call say`, line 0, number 3"), "{missing}");
    }

    #[test]
    fn the_largest_of_several_is_found_by_how_their_names_begin() {
        let mut figures = Figures::default();
        figures.read("stack head 10\nstack relay-tof 30\nstack relay-radio 20\n");
        assert_eq!(figures.most("stack ").unwrap(), 30);
        assert!(figures.most("heap ").is_err());
    }
}
