//! Trees of values, put together.

use std::ops::Range;

use toml::{Spanned, de::DeValue};

/// Gives a value and all it holds other spans. The parser bounds the depth (80).
pub(super) fn map_spans(value: &mut Spanned<DeValue<'_>>, to: &impl Fn(Range<usize>) -> Range<usize>) {
    let span = to(value.span());
    let mut inner = std::mem::replace(value.get_mut(), DeValue::Boolean(false));
    match &mut inner {
        DeValue::Table(table) => {
            let entries = std::mem::take(table);
            for (key, mut held) in entries {
                map_spans(&mut held, to);
                table.insert(Spanned::new(to(key.span()), key.into_inner()), held);
            }
        }
        DeValue::Array(items) => items.iter_mut().for_each(|held| map_spans(held, to)),
        _ => {}
    }
    *value = Spanned::new(span, inner);
}

/// Writes into a table what it does not hold, and so on into the tables within. What is no table stays.
pub(super) fn fill_in<'i>(written: &mut Spanned<DeValue<'i>>, more: Spanned<DeValue<'i>>) {
    let DeValue::Table(more) = more.into_inner() else { return };
    let DeValue::Table(table) = written.get_mut() else { return };
    for (key, value) in more {
        match table.get_mut(&**key.get_ref()) {
            Some(held) => fill_in(held, value),
            None => _ = table.insert(key, value),
        }
    }
}
