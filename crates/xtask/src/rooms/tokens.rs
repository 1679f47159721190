//! Paths in tokens that nobody has parsed: what stands in a macro call, a macro's definition or an attribute.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::ext::IdentExt as _;

/// Attributes whose text holds paths: `#[serde(with = "crate::seconds")]`.
const WITH_PATHS_IN_TEXT: [&str; 2] = ["serde", "schemars"];

/// A path as it is written, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Mention {
    /// Its names; the first is empty if the path begins with `::`, and `crate` for a macro's `$crate`.
    pub(super) names: Vec<String>,
    pub(super) kind: Kind,
    /// From 1.
    pub(super) line: usize,
}

/// What a path stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A module or something in one.
    Name,
    /// Everything in a module.
    Glob,
    /// A macro that is called.
    Macro,
}

impl Mention {
    /// The path as it stands in the source.
    pub(super) fn text(&self) -> String {
        let end = match self.kind {
            Kind::Name => "",
            Kind::Glob => "::*",
            Kind::Macro => "!",
        };
        self.names.join("::") + end
    }
}

/// Appends the paths of two names and more, and the macros that are called.
pub(super) fn scan(tokens: TokenStream, found: &mut Vec<Mention>) {
    scan_with(tokens, false, found);
}

/// The same for what stands in the brackets of an attribute.
pub(super) fn scan_attribute(name: &str, tokens: TokenStream, found: &mut Vec<Mention>) {
    scan_with(tokens, WITH_PATHS_IN_TEXT.contains(&name), found);
}

/// `named`: string literals are paths.
fn scan_with(tokens: TokenStream, named: bool, found: &mut Vec<Mention>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut i = 0;
    while i < tokens.len() {
        match &tokens[i] {
            TokenTree::Group(group) => {
                let named = named || (i > 0 && has_paths_in_text(&tokens[i - 1]));
                scan_with(group.stream(), named, found);
                i += 1;
            }
            TokenTree::Literal(literal) if named => {
                found.extend(in_text(literal));
                i += 1;
            }
            // A macro's own variable stands for whatever the caller writes, and is read there.
            TokenTree::Punct(dollar) if dollar.as_char() == '$' && !is_crate(tokens.get(i + 1)) => i += 2,
            _ => i = path_at(&tokens, i, &[], found).max(i + 1),
        }
    }
}

/// Reads the path that begins at token `i`, if one does, and returns where it ends.
fn path_at(tokens: &[TokenTree], mut i: usize, prefix: &[String], found: &mut Vec<Mention>) -> usize {
    let line = tokens.get(i).map_or(0, |token| token.span().start().line);
    let mut names = prefix.to_vec();
    if colons(tokens, i) {
        names.push(String::new());
        i += 2;
    }
    loop {
        match tokens.get(i) {
            Some(TokenTree::Ident(name)) => names.push(name.unraw().to_string()),
            Some(TokenTree::Punct(dollar)) if dollar.as_char() == '$' && is_crate(tokens.get(i + 1)) => {
                names.push("crate".to_owned());
                i += 1;
            }
            Some(TokenTree::Punct(star)) if star.as_char() == '*' && !names.is_empty() => {
                found.push(Mention { names, kind: Kind::Glob, line });
                return i + 1;
            }
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace && !names.is_empty() => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                for piece in inner.split(|token| is(token, ',')) {
                    path_at(piece, 0, &names, found);
                }
                return i + 1;
            }
            _ => break,
        }
        i += 1;
        if !colons(tokens, i) {
            break;
        }
        i += 2;
    }
    let called = tokens.get(i).is_some_and(|token| is(token, '!'))
        && matches!(tokens.get(i + 1), Some(TokenTree::Group(_)));
    if names.last().is_some_and(|last| last == "self") && names.len() > 1 {
        names.pop();
    }
    if called && !names.is_empty() {
        found.push(Mention { names, kind: Kind::Macro, line });
    } else if names.len() > 1 {
        found.push(Mention { names, kind: Kind::Name, line });
    }
    i
}

fn has_paths_in_text(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Ident(name) if WITH_PATHS_IN_TEXT.iter().any(|known| name == known))
}

fn in_text(literal: &proc_macro2::Literal) -> Option<Mention> {
    let text: syn::LitStr = syn::parse_str(&literal.to_string()).ok()?;
    let path: syn::Path = syn::parse_str(&text.value()).ok()?;
    let names = names(&path);
    (names.len() > 1).then(|| Mention { names, kind: Kind::Name, line: literal.span().start().line })
}

/// The names of a parsed path.
pub(super) fn names(path: &syn::Path) -> Vec<String> {
    let root = path.leading_colon.as_ref().map(|_| String::new());
    root.into_iter().chain(path.segments.iter().map(|s| s.ident.unraw().to_string())).collect()
}

fn is_crate(token: Option<&TokenTree>) -> bool {
    matches!(token, Some(TokenTree::Ident(name)) if name == "crate")
}

fn is(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign)
}

fn colons(tokens: &[TokenTree], i: usize) -> bool {
    let colon = |i: usize| tokens.get(i).is_some_and(|token| is(token, ':'));
    colon(i) && colon(i + 1)
}
