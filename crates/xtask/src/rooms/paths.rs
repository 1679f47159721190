//! What one module declares, imports and mentions.

use std::collections::BTreeSet;

use syn::{
    Attribute, Expr, ForeignItem, ImplItem, Item, ItemMod, Meta, Stmt, Token, TraitItem, UseTree,
    ext::IdentExt as _, punctuated::Punctuated, visit, visit::Visit,
};

use super::tokens::{Kind, Mention, names, scan, scan_attribute};

/// The names of one module.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// Items that are no modules.
    pub(super) items: BTreeSet<String>,
    /// Macros by `macro_rules!`.
    pub(super) macros: BTreeSet<String>,
    /// Those of them that stand at the crate's root for everybody.
    pub(super) exported: BTreeSet<String>,
    /// Names by which the crate calls itself: `extern crate self as …`.
    pub(super) own: BTreeSet<String>,
    pub(super) imports: Vec<Import>,
    /// Every path that counts, imports among them.
    pub(super) mentions: Vec<Mention>,
}

/// One name that a `use` brings in, or all names of a module.
#[derive(Debug)]
pub(super) struct Import {
    /// Under which name; `None` for a glob.
    pub(super) name: Option<String>,
    pub(super) path: Vec<String>,
}

/// Reads a module's items. The modules in it are returned, not read.
pub(super) fn names_of(items: &[Item]) -> (Names, Vec<&ItemMod>) {
    let mut visitor = Visitor { names: Names::default(), inner: Vec::new() };
    for item in items {
        visitor.visit_item(item);
    }
    (visitor.names, visitor.inner)
}

/// Whether these attributes leave something out of every build but a test's.
pub(super) fn only_in_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let last = attribute.path().segments.last().map(|segment| segment.ident.to_string());
        match last.as_deref() {
            Some("test" | "bench") => true,
            Some("cfg") => attribute.parse_args::<Meta>().is_ok_and(|cfg| never(&cfg)),
            _ => false,
        }
    })
}

/// Whether a condition is false in every build that is no test.
fn never(cfg: &Meta) -> bool {
    match cfg {
        Meta::Path(path) => path.is_ident("test"),
        Meta::List(list) => {
            let parts = list.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
            let Ok(parts) = parts else { return false };
            if list.path.is_ident("all") {
                parts.iter().any(never)
            } else {
                list.path.is_ident("any") && parts.iter().all(never)
            }
        }
        Meta::NameValue(_) => false,
    }
}

/// Where a path begins.
fn line(path: &syn::Path) -> usize {
    path.segments.first().map_or(0, |first| first.ident.span().start().line)
}

struct Visitor<'ast> {
    names: Names,
    inner: Vec<&'ast ItemMod>,
}

impl Visitor<'_> {
    fn import(&mut self, tree: &UseTree, prefix: &[String]) {
        let with = |name: &syn::Ident| {
            let mut path = prefix.to_vec();
            // `{self}` is what stands before the brace.
            if name != "self" || prefix.is_empty() {
                path.push(name.unraw().to_string());
            }
            path
        };
        let (name, path, line) = match tree {
            UseTree::Path(step) => return self.import(&step.tree, &with(&step.ident)),
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.import(tree, prefix));
            }
            UseTree::Name(name) => (with(&name.ident).last().cloned(), with(&name.ident), name.ident.span()),
            UseTree::Rename(to) => (Some(to.rename.unraw().to_string()), with(&to.ident), to.rename.span()),
            UseTree::Glob(star) => (None, prefix.to_vec(), star.star_token.spans[0]),
        };
        let kind = if matches!(tree, UseTree::Glob(_)) { Kind::Glob } else { Kind::Name };
        self.names.mentions.push(Mention { names: path.clone(), kind, line: line.start().line });
        self.names.imports.push(Import { name, path });
    }

    fn declare(&mut self, item: &Item) {
        let name = match item {
            Item::Const(item) => &item.ident,
            Item::Enum(item) => &item.ident,
            Item::Fn(item) => &item.sig.ident,
            Item::Static(item) => &item.ident,
            Item::Struct(item) => &item.ident,
            Item::Trait(item) => &item.ident,
            Item::TraitAlias(item) => &item.ident,
            Item::Type(item) => &item.ident,
            Item::Union(item) => &item.ident,
            Item::ExternCrate(item) if item.ident == "self" => {
                self.names.own.extend(item.rename.iter().map(|(_, name)| name.unraw().to_string()));
                return;
            }
            Item::Macro(item) => {
                let Some(name) = item.ident.as_ref().map(|name| name.unraw().to_string()) else { return };
                if item.attrs.iter().any(|attribute| attribute.path().is_ident("macro_export")) {
                    self.names.exported.insert(name.clone());
                }
                self.names.macros.insert(name);
                return;
            }
            _ => return,
        };
        self.names.items.insert(name.unraw().to_string());
    }
}

/// The attributes of an enum's variants, by name.
macro_rules! attributes {
    ($kind:ident, $of:expr; $($variant:ident)*) => {
        match $of {
            $( $kind::$variant(inner) => &inner.attrs, )*
            _ => &[][..],
        }
    };
}

/// Visits what is no test's.
macro_rules! unless_in_tests {
    ($($visit:ident($kind:ident: $($variant:ident)*);)*) => {$(
        fn $visit(&mut self, node: &'ast $kind) {
            if !only_in_tests(attributes!($kind, node; $($variant)*)) {
                visit::$visit(self, node);
            }
        }
    )*};
}

/// The same for nodes that have attributes of their own.
macro_rules! unless_marked {
    ($($visit:ident($kind:ident);)*) => {$(
        fn $visit(&mut self, node: &'ast syn::$kind) {
            if !only_in_tests(&node.attrs) {
                visit::$visit(self, node);
            }
        }
    )*};
}

impl<'ast> Visit<'ast> for Visitor<'ast> {
    fn visit_item(&mut self, item: &'ast Item) {
        let attributes = attributes!(
            Item, item;
            Const Enum ExternCrate Fn ForeignMod Impl Macro Mod Static Struct Trait TraitAlias Type Union Use
        );
        if only_in_tests(attributes) {
            return;
        }
        self.declare(item);
        match item {
            Item::Mod(module) => {
                for attribute in attributes {
                    self.visit_attribute(attribute);
                }
                self.inner.push(module);
            }
            Item::Use(item) => {
                let root = item.leading_colon.as_ref().map(|_| String::new());
                self.import(&item.tree, root.as_slice());
            }
            other => visit::visit_item(self, other),
        }
    }

    unless_in_tests! {
        visit_impl_item(ImplItem: Const Fn Type Macro);
        visit_trait_item(TraitItem: Const Fn Type Macro);
        visit_foreign_item(ForeignItem: Fn Static Type Macro);
        visit_stmt(Stmt: Local Macro);
        visit_expr(
            Expr: Array Assign Async Await Binary Block Break Call Cast Closure Const Continue Field ForLoop Group If
                Index Infer Let Lit Loop Macro Match MethodCall Paren Path Range RawAddr Reference Repeat Return
                Struct Try TryBlock Tuple Unary Unsafe While Yield
        );
    }

    unless_marked! {
        visit_arm(Arm);
        visit_field(Field);
        visit_variant(Variant);
        visit_field_value(FieldValue);
        visit_field_pat(FieldPat);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = names(path);
        if names.len() > 1 {
            self.names.mentions.push(Mention { names, kind: Kind::Name, line: line(path) });
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, called: &'ast syn::Macro) {
        let line = line(&called.path);
        self.names.mentions.push(Mention { names: names(&called.path), kind: Kind::Macro, line });
        scan(called.tokens.clone(), &mut self.names.mentions);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        let Meta::List(list) = &attribute.meta else { return visit::visit_attribute(self, attribute) };
        let condition = || list.tokens.clone().into_iter().take_while(|token| token.to_string() != ",");
        if list.path.is_ident("cfg_attr")
            && syn::parse2::<Meta>(condition().collect()).is_ok_and(|cfg| never(&cfg))
        {
            return;
        }
        self.visit_path(&list.path);
        let name = list.path.segments.last().map(|last| last.ident.to_string());
        scan_attribute(&name.unwrap_or_default(), list.tokens.clone(), &mut self.names.mentions);
    }

    fn visit_token_stream(&mut self, tokens: &'ast proc_macro2::TokenStream) {
        scan(tokens.clone(), &mut self.names.mentions);
    }
}
