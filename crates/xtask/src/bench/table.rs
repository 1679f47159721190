//! Criterion's estimates as one table.

use std::{collections::BTreeMap, fmt::Write as _, fs, path::Path, time::SystemTime};

use anyhow::{Context as _, Result, ensure};
use serde_json::Value;

/// What the function of a pair that is ours is called; the other one is the baseline.
const OURS: &str = "ours";

/// The median of one benchmark.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Estimate {
    /// What is measured; ends in `[unit]`, what one element is.
    group: String,
    /// `ours`, or the baseline's name.
    function: String,
    /// The size.
    value: String,
    /// Median time of one element (ns).
    each_ns: f64,
}

/// All estimates written since `since`.
pub(super) fn read(folder: &Path, since: SystemTime) -> Result<Vec<Estimate>> {
    let mut estimates = Vec::new();
    collect(folder, since, &mut estimates)?;
    ensure!(!estimates.is_empty(), "no benchmark ran; does the filter match one?");
    Ok(estimates)
}

fn collect(folder: &Path, since: SystemTime, into: &mut Vec<Estimate>) -> Result<()> {
    let shown = folder.display();
    for entry in fs::read_dir(folder).with_context(|| format!("cannot list {shown}"))? {
        let path = entry.with_context(|| format!("cannot list {shown}"))?.path();
        if !path.is_dir() {
            continue;
        }
        let file = path.join("estimates.json");
        let fresh = file.metadata().and_then(|data| data.modified()).is_ok_and(|at| at >= since);
        if path.ends_with("new") && fresh {
            into.push(estimate(&json(&path.join("benchmark.json"))?, &json(&file)?).with_context(|| {
                format!(
                    "{} and benchmark.json beside it are not as criterion 0.8 writes them",
                    file.display()
                )
            })?);
        } else {
            collect(&path, since, into)?;
        }
    }
    Ok(())
}

fn json(file: &Path) -> Result<Value> {
    let text = fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
    serde_json::from_str(&text).with_context(|| format!("{} is not JSON", file.display()))
}

fn estimate(about: &Value, estimates: &Value) -> Option<Estimate> {
    let text = |key: &str| about[key].as_str().unwrap_or_default().to_owned();
    let elements = about["throughput"]["Elements"].as_f64().unwrap_or(1.0);
    let each_ns = estimates["median"]["point_estimate"].as_f64()? / elements;
    Some(Estimate {
        group: about["group_id"].as_str()?.to_owned(),
        function: text("function_id"),
        value: text("value_str"),
        each_ns,
    })
}

/// Pairs with their ratios first, then what has no baseline, then how the cost grows with the size.
pub(super) fn table(estimates: &[Estimate]) -> String {
    let mut groups: BTreeMap<&str, Vec<&Estimate>> = BTreeMap::new();
    for estimate in estimates {
        groups.entry(&estimate.group).or_default().push(estimate);
    }
    let (mut pairs, mut alone, mut growth) = (Vec::new(), Vec::new(), Vec::new());
    for (group, mut members) in groups {
        members.sort_by(|a, b| size(&a.value).total_cmp(&size(&b.value)).then(a.function.cmp(&b.function)));
        let (ours, others): (Vec<&Estimate>, Vec<&Estimate>) =
            members.iter().copied().partition(|member| member.function == OURS);
        for mine in &ours {
            let baselines = others.iter().filter(|other| other.value == mine.value);
            let before = pairs.len();
            pairs.extend(baselines.map(|other| (other.each_ns / mine.each_ns, *mine, *other)));
            if pairs.len() == before {
                alone.push(*mine);
            }
        }
        if ours.is_empty() {
            alone.extend(others);
        }
        if let [first, .., last] = ours.as_slice() {
            growth.push((group, last.each_ns / first.each_ns, *first, *last));
        }
    }
    let mut text = String::from("  ratio         ours      baseline  workload\n");
    // Writing to a String cannot fail.
    for (ratio, mine, other) in pairs {
        let (name, function) = (name(mine), &other.function);
        let (ours, theirs) = (time(mine.each_ns), time(other.each_ns));
        let _ = writeln!(text, "{ratio:6.1}x {ours:>12} {theirs:>13}  {name}, against {function}");
    }
    for mine in alone {
        let _ = writeln!(text, "      –  {:>12}             –  {}", time(mine.each_ns), name(mine));
    }
    if !growth.is_empty() {
        text.push_str("\n  cost of one, largest size : smallest\n");
    }
    for (group, factor, first, last) in growth {
        let _ = writeln!(text, "{factor:6.1}x  {group}, {} : {}", last.value, first.value);
    }
    text
}

fn size(value: &str) -> f64 {
    value.parse().unwrap_or(0.0)
}

/// The workload, its size, and what one element is.
fn name(estimate: &Estimate) -> String {
    let (what, unit) = estimate.group.split_once(" [").unwrap_or((&estimate.group, "call]"));
    let function = if estimate.function == OURS { "" } else { estimate.function.as_str() };
    let words = [what, function, &estimate.value].map(str::to_owned);
    let words: Vec<String> = words.into_iter().filter(|word| !word.is_empty()).collect();
    format!("{} per {}", words.join(" "), unit.trim_end_matches(']'))
}

fn time(ns: f64) -> String {
    match ns {
        ..1e3 => format!("{ns:.1} ns"),
        ..1e6 => format!("{:.2} µs", ns / 1e3),
        _ => format!("{:.2} ms", ns / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(group: &str, function: &str, value: &str, each_ns: f64) -> Estimate {
        Estimate { group: group.into(), function: function.into(), value: value.into(), each_ns }
    }

    #[test]
    fn a_pair_gives_a_ratio_and_sizes_are_compared_as_numbers() {
        let estimates = [
            estimate("rays [ray]", "parry", "400", 200.0),
            estimate("rays [ray]", "ours", "4000", 30.0),
            estimate("rays [ray]", "ours", "400", 10.0),
            estimate("laws", "kalman", "", 5.0),
        ];
        assert_eq!(
            table(&estimates),
            "  ratio         ours      baseline  workload\n  \
               20.0x      10.0 ns      200.0 ns  rays 400 per ray, against parry\n      \
               –        5.0 ns             –  laws kalman per call\n      \
               –       30.0 ns             –  rays 4000 per ray\n\n  \
             cost of one, largest size : smallest\n   \
               3.0x  rays [ray], 4000 : 400\n"
        );
    }

    #[test]
    fn an_estimate_is_a_median_over_the_elements_of_an_iteration() {
        let about: Value = serde_json::from_str(
            r#"{"group_id":"w1","function_id":"ours","value_str":"64","throughput":{"Elements":64}}"#,
        )
        .unwrap();
        let estimates = serde_json::from_str(r#"{"median":{"point_estimate":6400.0}}"#).unwrap();
        assert_eq!(super::estimate(&about, &estimates), Some(estimate("w1", "ours", "64", 100.0)));
        assert_eq!(super::estimate(&about, &Value::Null), None);
    }
}
