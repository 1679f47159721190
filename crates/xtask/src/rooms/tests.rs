//! Circles planted in small crates, by every way in which one room may come to name another.

use std::{collections::BTreeMap, io, path::Path};

use super::*;

/// What is wrong with the rooms of a crate of these files: names below `src/`, and texts.
fn found(package: &str, files: &[(&str, &str)]) -> Result<Vec<String>> {
    let files: BTreeMap<&Path, &str> = files.iter().map(|(name, text)| (Path::new(*name), *text)).collect();
    let read = |path: &Path| {
        let inside = path.strip_prefix("src").unwrap_or(path);
        files.get(inside).map(ToString::to_string).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    let graphs = of_root(package, Path::new("src/lib.rs"), &read)?;
    Ok(graphs.iter().flat_map(|graph| graph.complaints(Path::new(""))).collect())
}

fn passes(files: &[(&str, &str)]) {
    assert_eq!(found("planted", files).unwrap(), Vec::<String>::new());
}

/// There is one circle, of these rooms, and its text names these places.
fn fails(files: &[(&str, &str)], rooms: &str, places: &[&str]) {
    let found = found("planted", files).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    let count = rooms.split(", ").count();
    assert!(found[0].starts_with(&format!("planted: a circle of {count} rooms: {rooms}\n")), "{}", found[0]);
    for place in places {
        assert!(found[0].contains(place), "no `{place}` in {}", found[0]);
    }
}

/// A room `b` that imports `a`; `of_a` decides whether that is a circle.
fn two_rooms(of_a: &str) -> [(&'static str, &str); 3] {
    [
        ("lib.rs", "pub mod a; pub mod b;"),
        ("a.rs", of_a),
        ("b.rs", "use crate::a::A;\npub struct B; pub mod c {}"),
    ]
}

fn a_names_b(of_a: &str, place: &str) {
    fails(&two_rooms(of_a), "a, b", &[place, "  b imports a:\n    src/b.rs:1: crate::a::A\n"]);
}

#[test]
fn rooms_that_import_one_way_pass() {
    passes(&two_rooms("pub struct A;"));
    passes(&two_rooms("pub struct A;\nimpl A { fn a() -> self::A { crate::a::A } }"));
    passes(&two_rooms("use std::b::c;\nuse ::b::B;\npub struct A;\nfn a() { ::b::B; other::b::B; }"));
}

#[test]
fn a_circle_of_two_imports_is_found_and_every_import_in_it_is_named() {
    a_names_b("\nuse crate::b::B;", "  a imports b:\n    src/a.rs:2: crate::b::B\n");
    a_names_b("use crate::{b::{c::{self}, B as Other}};", "src/a.rs:1: crate::b::c\n");
    a_names_b("pub(crate) use crate::b::*;", "src/a.rs:1: crate::b::*\n");
    a_names_b("use crate::b as other;", "src/a.rs:1: crate::b\n");
    a_names_b("use {crate::b::B};", "src/a.rs:1: crate::b::B\n");
    a_names_b("fn a() {\n use crate::b::B;\n}", "src/a.rs:2: crate::b::B\n");
    a_names_b("use crate::r#b::r#B;", "src/a.rs:1: crate::b::B\n");
}

#[test]
fn a_circle_of_paths_in_the_middle_of_code_is_found() {
    a_names_b("fn a() {\n let _ = crate::b::B;\n}", "src/a.rs:2: crate::b::B\n");
    a_names_b("pub struct A {\n b: Vec<Option<crate::b::B>>,\n}", "src/a.rs:2: crate::b::B\n");
    a_names_b("pub struct A;\nimpl From<crate::b::B> for A {}", "src/a.rs:2: crate::b::B\n");
    a_names_b("fn a<T: crate::b::B>() where T: Copy {}", "src/a.rs:1: crate::b::B\n");
    a_names_b("fn a(x: X) { match x { crate::b::B => {} } }", "src/a.rs:1: crate::b::B\n");
    a_names_b("type A = <crate::b::B as Trait>::Item;", "src/a.rs:1: crate::b::B\n");
    a_names_b("const A: usize = [0; crate::b::N].len();", "src/a.rs:1: crate::b::N\n");
}

#[test]
fn a_circle_through_attributes_is_found() {
    a_names_b("#[derive(crate::b::Derive)]\npub struct A;", "src/a.rs:1: crate::b::Derive\n");
    a_names_b("#[crate::b::attribute(x)]\npub struct A;", "src/a.rs:1: crate::b::attribute\n");
    a_names_b(
        "pub struct A {\n #[cfg_attr(feature = \"x\", serde(with = \"crate::b::c\"))]\n x: f32,\n}",
        "src/a.rs:2: crate::b::c\n",
    );
    a_names_b("#[serde(default = \"crate::b::c\")]\npub struct A;", "src/a.rs:1: crate::b::c\n");
    passes(&two_rooms("#[expect(dead_code, reason = \"crate::b::B\")]\npub struct A;"));
}

#[test]
fn a_circle_through_self_and_super_is_found() {
    a_names_b("use super::b::B;", "src/a.rs:1: super::b::B\n");
    a_names_b("use self::super::b::B;", "src/a.rs:1: self::super::b::B\n");
    a_names_b(
        "mod deep { mod er {\nfn a() { super::super::super::b::B; } } }",
        "src/a.rs:2: super::super::super::b::B",
    );
    passes(&two_rooms("mod b { pub struct B; }\nmod deep { fn a() { super::b::B; } }"));
}

#[test]
fn a_circle_through_the_tokens_of_a_macro_is_found() {
    a_names_b("fn a() { println!(\"{}\",\n crate::b::B); }", "src/a.rs:2: crate::b::B\n");
    a_names_b("thread_local! { static A: [(); 1] = [crate::b::B]; }", "src/a.rs:1: crate::b::B\n");
    a_names_b("table! { use crate::b::{B, c}; }", "src/a.rs:1: crate::b::c\n");
    a_names_b("table! { use super::{b::*}; }", "src/a.rs:1: super::b::*\n");
    a_names_b("table! { #[serde(with = \"crate::b::c\")] x: f32 }", "src/a.rs:1: crate::b::c\n");
    a_names_b("macro_rules! a { ($x:expr) => {\n $crate::b::B($x) }; }", "src/a.rs:2: crate::b::B\n");
    a_names_b("use crate::b as other;\nfn a() { vec![other::B] }", "src/a.rs:1: crate::b\n");
    passes(&two_rooms("fn a() { println!(\"crate::b::B\"); x!(other::b::B, $b::B, x.b::<f32>(), b: :B) }"));
}

#[test]
fn a_circle_through_a_macro_of_another_room_is_found() {
    let of_b = "macro_rules! twice { ($x:expr) => { $x + $x }; }\nfn b() -> crate::a::A {}";
    let plant =
        |of_a, of_b| [("lib.rs", "#[macro_use] pub mod b; pub mod a;"), ("a.rs", of_a), ("b.rs", of_b)];
    fails(
        &plant("fn a() { twice!(1) }", of_b),
        "a, b",
        &["src/a.rs:1: twice!\n", "src/b.rs:2: crate::a::A\n"],
    );
    fails(&plant("fn a() { dbg!(twice!(1)) }", of_b), "a, b", &["src/a.rs:1: twice!\n"]);
    passes(&plant("macro_rules! twice { () => {}; }\nfn a() { twice!(1) }", of_b));

    let exported = format!("#[macro_export]\n{of_b}");
    fails(&plant("fn a() { crate::twice!(1) }", &exported), "a, b", &["src/a.rs:1: crate::twice!\n"]);
    fails(&plant("use crate::twice;", &exported), "a, b", &["src/a.rs:1: crate::twice\n"]);
    // A module of the macro's name is another thing.
    passes(&[
        ("lib.rs", "pub mod a; pub mod b; pub mod twice {\npub use crate::a::A; }"),
        ("a.rs", "fn a() { crate::twice!(1) }"),
        ("b.rs", "#[macro_export]\nmacro_rules! twice { () => {}; }"),
    ]);
}

#[test]
fn a_circle_through_names_that_the_root_passes_on_is_found() {
    let plant = |root, of_a| [("lib.rs", root), ("a.rs", of_a), ("b.rs", "use crate::a::A;\npub struct B;")];
    let fails =
        |root, of_a, place: &str| fails(&plant(root, of_a), "a, b", &[place, "src/b.rs:1: crate::a::A\n"]);
    fails("pub mod a; pub mod b; pub use b::B;", "use crate::B;", "src/a.rs:1: crate::B\n");
    fails(
        "pub mod a; pub mod b; pub use crate::b::B as Other;",
        "use crate::Other as B;",
        "src/a.rs:1: crate::Other\n",
    );
    fails("pub mod a; pub mod b; pub use b::*;", "fn a() { super::B; }", "src/a.rs:1: super::B\n");
    fails("pub mod a; pub mod b; use b as other;", "use crate::other::B;", "src/a.rs:1: crate::other::B\n");
    fails("pub mod a; pub mod b; pub use b::*;", "use super::*;", "src/a.rs:1: super::*\n");
    fails("extern crate self as me; pub mod a; pub mod b;", "use me::b::B;", "src/a.rs:1: me::b::B\n");
    fails("extern crate self as me; pub mod a; pub mod b;", "use ::me::b::B;", "src/a.rs:1: ::me::b::B\n");
    // Names that the root passes on of something else, and one that it has itself.
    passes(&plant("pub mod a; pub mod b; pub use b::*; pub struct C;", "use crate::C;"));
    passes(&plant("pub mod a; pub mod b; pub use b::*; pub use std::fmt;", "use crate::fmt::B;"));
}

#[test]
fn a_circle_through_three_rooms_and_renamed_names_is_found() {
    let plant = |of_c| {
        [
            ("lib.rs", "mod a; mod b; mod c; mod d;"),
            ("a.rs", "pub use crate::b::B as Renamed;"),
            ("b.rs", "pub use super::c::*;\npub struct B;"),
            ("c.rs", of_c),
            ("d.rs", "use crate::a::Renamed;\nuse crate::b::C;"),
        ]
    };
    passes(&plant("pub struct C;"));
    fails(
        &plant("fn c(x: crate::a::Renamed) {}"),
        "a, b, c",
        &["src/a.rs:1: crate::b::B\n", "src/b.rs:1: super::c::*\n", "src/c.rs:1: crate::a::Renamed\n"],
    );
}

#[test]
fn circles_of_imports_among_names_come_to_an_end() {
    passes(&[
        ("lib.rs", "mod a; pub use self::y as x; pub use self::x as y; pub use crate::*; pub use a::*;"),
        ("a.rs", "pub use crate::*; use crate::{x, y::z};\nfn a() { x::y::z; nowhere::z; }"),
    ]);
}

#[test]
fn a_circle_is_found_in_files_that_stand_elsewhere() {
    let of_b = ("elsewhere/b.rs", "mod inner;");
    let inner = ("elsewhere/inner.rs", "use crate::a::A;");
    let a = ("a/mod.rs", "#[path = \"../deep/x.rs\"]\nmod x; mod y;");
    let rest =
        [("deep/x.rs", "use super::super::b::B;"), ("a/y.rs", "mod z;"), ("a/y/z.rs", "pub struct Z;")];
    let root = ("lib.rs", "mod a;\n#[path = \"elsewhere/b.rs\"]\nmod b;");
    fails(
        &[root, a, of_b, inner, rest[0], rest[1], rest[2]],
        "a, b",
        &["src/deep/x.rs:1: super::super::b::B\n", "src/elsewhere/inner.rs:1: crate::a::A\n"],
    );
    let inline = ("lib.rs", "mod a { mod deep { mod x; } } mod b { pub use crate::a::A; }");
    fails(&[inline, ("a/deep/x.rs", "use crate::b::B;")], "a, b", &["src/a/deep/x.rs:1: crate::b::B\n"]);
}

#[test]
fn a_circle_only_in_tests_or_documentation_passes() {
    passes(&two_rooms("#[cfg(test)]\nuse crate::b::B;\n#[cfg(test)]\nmod tests { use crate::b::B; }"));
    passes(&two_rooms("#[cfg(all(test, feature = \"x\"))]\nmod tests;\n#[test]\nfn a() { crate::b::B; }"));
    passes(&two_rooms("/// [`B`](crate::b::B) is made of `crate::b::B`.\n/** crate::b::B */\nmod a {}"));
    passes(&two_rooms(
        "pub struct A { #[cfg(test)] b: crate::b::B }\nimpl A { #[cfg(test)] fn b() { crate::b::B } }",
    ));
    passes(&two_rooms("fn a() { #[cfg(test)] let b = crate::b::B; #[cfg(test)] { crate::b::B } }"));
    passes(&two_rooms("fn a(x: X) { match x { #[cfg(test)] X => crate::b::B, _ => {} } }"));
    passes(&two_rooms("#[cfg_attr(test, derive(crate::b::Derive))]\npub struct A;"));
    let inner = ("a/inner.rs", "#![cfg(test)]\nuse crate::b::B;");
    let [root, a, b] = two_rooms("mod inner;");
    passes(&[root, a, b, inner]);
    // Conditions that hold elsewhere too.
    a_names_b("#[cfg(any(test, feature = \"x\"))]\nuse crate::b::B;", "src/a.rs:2: crate::b::B\n");
    a_names_b("#[cfg(not(test))]\nuse crate::b::B;", "src/a.rs:2: crate::b::B\n");
    a_names_b("#[cfg_attr(feature = \"x\", derive(crate::b::Derive))]\npub struct A;", "crate::b::Derive\n");
}

#[test]
fn missions_are_rooms_among_themselves_and_import_no_other_mission() {
    let plant = |of_ring, shared| {
        [
            ("lib.rs", "pub mod mission; mod registry;"),
            ("registry.rs", "use crate::mission::{Ring, star::Star};"),
            ("mission/mod.rs", "pub mod ring; pub mod star; mod shared; pub use ring::Ring;"),
            ("mission/shared.rs", shared),
            ("mission/ring/mod.rs", of_ring),
            ("mission/star/mod.rs", "mod deep;\nuse super::shared::Shared;"),
            ("mission/star/deep.rs", "pub struct Deep;"),
        ]
    };
    let found = |of_ring, shared| found("uchain-sim", &plant(of_ring, shared)).unwrap();
    let none = Vec::<String>::new();
    assert_eq!(found("use super::Mission;\nuse crate::mission::shared::Shared;", ""), none);

    let stranger = found("use super::star::deep::Deep;", "");
    assert_eq!(stranger.len(), 1, "{stranger:?}");
    assert_eq!(
        stranger[0],
        "uchain-sim, mission: no folder in it may import another one\n  ring imports star:\n    \
         src/mission/ring/mod.rs:1: super::star::deep::Deep\n"
    );
    let circle = found("", "use super::star::Star;");
    assert_eq!(circle.len(), 1, "{circle:?}");
    assert!(circle[0].starts_with("uchain-sim, mission: a circle of 2 rooms: shared, star\n"), "{circle:?}");
    // Another crate's room of that name is one room.
    assert_eq!(super::tests::found("planted", &plant("use super::star::Star;", "")).unwrap(), none);
}

#[test]
fn what_cannot_be_checked_is_an_error_that_names_the_place() {
    let error = |files: &[(&str, &str)]| format!("{:#}", found("planted", files).unwrap_err());
    assert!(error(&[]).starts_with("cannot read src/lib.rs"));
    assert_eq!(
        error(&[("lib.rs", "\nmod a;")]),
        "src/lib.rs:2: no file for `mod a`: looked for src/a.rs and src/a/mod.rs"
    );
    assert!(error(&[("lib.rs", "mod a;"), ("a.rs", "fn a() {\n 1 + ; }")]).starts_with("src/a.rs:2: "));
    assert!(error(&[("lib.rs", "fn a() { \n ( }")]).starts_with("src/lib.rs:"));
    let included = error(&[("lib.rs", "mod a;"), ("a.rs", "include!(\"b.rs\");")]);
    assert_eq!(included, "src/a.rs:1: code behind `include!` cannot be checked");
    let again = error(&[("lib.rs", "#[path = \"lib.rs\"]\nmod again;")]);
    assert_eq!(again, "src/lib.rs: more than 50 modules within modules");
    let deep = "(".repeat(1000) + &")".repeat(1000);
    assert!(
        error(&[("lib.rs", &format!("\nfn a() {{ {deep} }}"))])
            .starts_with("src/lib.rs:2: more than 200 brackets")
    );
}

#[test]
fn the_crates_of_this_project_are_read_from_their_folders() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let tables: String = graphs(crates).unwrap().iter().map(Graph::table).collect();
    assert!(tables.contains("\nuchain-core: "), "{tables}");
    assert!(tables.contains("xtask (main.rs): "), "{tables}");
    assert!(tables.contains("\n  args -> bench steps web\n"), "{tables}");
    let nowhere = graphs(&crates.join("xtask")).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(nowhere.starts_with("no crate in "), "{nowhere}");
}

#[test]
fn a_failure_says_what_to_do() {
    let crates = Path::new("src/lib.rs");
    let read = |path: &Path| match path.to_str() {
        Some("src/lib.rs") => Ok("mod a { use crate::b::B; } mod b { use crate::a::A; }".to_owned()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    let error = check(&of_root("planted", crates, &read).unwrap(), Path::new("")).unwrap_err().to_string();
    assert!(error.contains("a circle of 2 rooms: a, b"), "{error}");
    assert!(error.contains("What to do: move what both need"), "{error}");
}
