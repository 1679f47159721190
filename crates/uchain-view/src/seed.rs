//! Seeds in JSON. A page reads numbers as `f64`, which rounds those beyond 2⁵³ − 1, and a rounded seed is another flight: larger
//! ones are their digits in quotes.

use serde::{Deserialize as _, Deserializer, Serialize as _, Serializer, de::Error as _};
use serde_json::Value;

/// Largest number that a page reads as it was written.
const SAFE_MAX: u64 = (1 << 53) - 1;

/// A seed for a page.
pub(crate) fn to_json(seed: u64) -> Value {
    if seed <= SAFE_MAX { seed.into() } else { seed.to_string().into() }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
pub(crate) fn serialize<S: Serializer>(seed: &u64, to: S) -> Result<S::Ok, S::Error> {
    to_json(*seed).serialize(to)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
    let value = Value::deserialize(from)?;
    let seed = value.as_u64().or_else(|| value.as_str()?.parse().ok());
    seed.ok_or_else(|| {
        D::Error::custom(format!("seed = {value}: expected a whole number from 0 to {}", u64::MAX))
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn read(seed: &Value) -> Option<u64> {
        deserialize(seed).ok()
    }

    #[test]
    fn every_seed_comes_back_from_a_page_that_rounds_numbers() {
        for seed in [0, 1, SAFE_MAX, SAFE_MAX + 1, SAFE_MAX + 2, u64::MAX] {
            let json = to_json(seed);
            let is_rounded =
                json.as_f64().is_some_and(|number| number as u64 != seed || number > SAFE_MAX as f64);
            assert!(!is_rounded, "{json}");
            assert_eq!(read(&json), Some(seed));
        }
        assert_ne!((SAFE_MAX + 2) as f64 as u64, SAFE_MAX + 2, "the control: as a number it is rounded");
    }

    #[test]
    fn what_is_no_seed_is_refused() {
        for seed in
            [json!(-1), json!(1.5), json!("one"), json!("-1"), json!("18446744073709551616"), json!(null)]
        {
            assert_eq!(read(&seed), None, "{seed}");
        }
    }
}
