//! What an XML text is made of, counted in one flat pass before anything is built from it: a parser asks for memory for
//! every element and attribute, compares the attributes of one element pair by pair, and goes down with each level.

/// Most bytes of a drawing.
pub(super) const MOST_BYTES: u64 = 32 << 20;
/// Most elements.
pub(super) const MOST_ELEMENTS: usize = 100_000;
/// Most attributes, of all elements together.
const MOST_ATTRIBUTES: usize = 500_000;
/// Most attributes of one element.
const MOST_OF_ONE: usize = 200;
/// Most attributes that declare a namespace.
const MOST_NAMESPACES: usize = 1000;
/// Most elements within each other.
pub(super) const DEEPEST: usize = 128;

/// The first count that is too great, in words.
pub(super) fn scan(text: &str) -> Result<(), String> {
    at_most("declarations of namespaces", text.matches("xmlns").count(), MOST_NAMESPACES)?;
    let mut seen = Seen::default();
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let skip = if rest.starts_with("<!--") {
            rest.find("-->").map(|end| end + 3)
        } else if rest.starts_with("<![CDATA[") {
            rest.find("]]>").map(|end| end + 3)
        } else if rest.starts_with("<?") {
            rest.find("?>").map(|end| end + 2)
        } else if rest.starts_with("<!") {
            Some(doctype(rest)?)
        } else {
            Some(seen.tag(rest)?)
        };
        rest = &rest[skip.unwrap_or(rest.len())..];
    }
    Ok(())
}

#[derive(Default)]
struct Seen {
    depth: usize,
    elements: usize,
    attributes: usize,
}

impl Seen {
    /// Counts a tag, and says where it ends.
    fn tag(&mut self, tag: &str) -> Result<usize, String> {
        let bytes = tag.as_bytes();
        if bytes.get(1) == Some(&b'/') {
            self.depth = self.depth.saturating_sub(1);
            return Ok(tag.find('>').map_or(tag.len(), |end| end + 1));
        }
        let (mut quote, mut own, mut end) = (None, 0, tag.len());
        for (index, &byte) in bytes.iter().enumerate() {
            match (quote, byte) {
                (None, b'"' | b'\'') => quote = Some(byte),
                (Some(open), _) if byte == open => quote = None,
                (None, b'=') => own += 1,
                (None, b'>') => {
                    end = index + 1;
                    break;
                }
                _ => {}
            }
            at_most("attributes of one element", own, MOST_OF_ONE)?;
        }
        self.elements += 1;
        self.attributes += own;
        if end < 2 || bytes[end - 2] != b'/' {
            self.depth += 1;
        }
        at_most("elements", self.elements, MOST_ELEMENTS)?;
        at_most("attributes", self.attributes, MOST_ATTRIBUTES)?;
        at_most("elements within each other", self.depth, DEEPEST)?;
        Ok(end)
    }
}

/// Where a document type ends. Entities can stand for entities that stand for others, a thousand times each; no drawing
/// program of these days writes any.
fn doctype(text: &str) -> Result<usize, String> {
    let end = match (text.find('['), text.find('>')) {
        (Some(open), Some(end)) if open < end => {
            let close = text[open..].find(']').map_or(text.len(), |close| open + close);
            if text[open..close].contains("<!ENTITY") {
                return Err(
                    "it declares entities (<!ENTITY …>); expected a drawing without: save it as plain SVG"
                        .into(),
                );
            }
            text[close..].find('>').map(|end| close + end)
        }
        (_, end) => end,
    };
    Ok(end.map_or(text.len(), |end| end + 1))
}

fn at_most(what: &str, got: usize, most: usize) -> Result<(), String> {
    if got <= most {
        return Ok(());
    }
    Err(format!(
        "more than {most} {what}; expected a drawing with fewer: simplify it, or cut it into several"
    ))
}
