//! The rules as sentences, and drawings that mean harm.

mod oracle;

use proptest::prelude::*;

use super::*;
use crate::map::RemarkKind;

fn config() -> SvgConfig {
    // One unit of the drawings here is a metre.
    SvgConfig { unit_m: Some(1.0), ..SvgConfig::default() }
}

fn svg(inside: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' viewBox='0 0 40 20'>{inside}</svg>"
    )
}

fn drawn(inside: &str) -> Drawing {
    read(svg(inside).as_bytes(), &config()).unwrap_or_else(|why| panic!("{inside}: {why}"))
}

/// Walls, areas of rock, areas of free space.
fn counts(inside: &str) -> [usize; 3] {
    let text = svg(inside);
    match read(text.as_bytes(), &config()) {
        Ok(drawing) => [drawing.walls.len(), drawing.solids.len(), drawing.free.len()],
        Err(why) => {
            assert!(why.starts_with("nothing in it is a wall"), "{inside}: {why}");
            [0; 3]
        }
    }
}

fn said(drawing: &Drawing, kind: RemarkKind, part: &str) -> usize {
    let of_it = drawing.import.remarks.iter().filter(|said| said.kind == kind && said.what.contains(part));
    of_it.map(|said| said.count).sum()
}

#[test]
fn what_is_stroked_is_a_wall_and_what_is_filled_is_rock() {
    assert_eq!(counts("<path d='M1 1H9' fill='none' stroke='black'/>"), [1, 0, 0]);
    assert_eq!(counts("<line x1='1' y1='2' x2='3' y2='4' stroke='#00f'/>"), [1, 0, 0]);
    assert_eq!(counts("<rect width='3' height='4'/>"), [0, 1, 0], "black by default");
    assert_eq!(counts("<rect width='3' height='4' stroke='red'/>"), [1, 1, 0], "both");
    assert_eq!(counts("<g fill='none' stroke='red'><circle r='3'/><path d='M1 1H9M1 2H9'/></g>"), [3, 0, 0]);
    assert_eq!(counts("<g style='fill:none;stroke:#111'><polygon points='0,0 3,0 3,3'/></g>"), [1, 0, 0]);
}

#[test]
fn what_shows_no_ink_is_dropped_and_counted() {
    for (element, why) in [
        ("<text>hi</text>", "text elements"),
        ("<image href='a.png'/>", "images"),
        ("<rect width='3' height='4' display='none'/>", "hidden"),
        ("<rect width='3' height='4' style='visibility:hidden'/>", "hidden"),
        ("<g opacity='0'><rect width='3' height='4'/></g>", "hidden"),
        ("<rect width='3' height='4' fill='none'/>", "neither filled nor stroked"),
        ("<rect width='3' height='4' fill='red' fill-opacity='0'/>", "neither filled nor stroked"),
        ("<rect width='3' height='4' fill='#fff'/>", "white"),
        ("<g id='notes'><rect width='3' height='4'/></g>", "called notes"),
        ("<use href='other.svg#a'/>", "not in the file"),
        ("<use href='#a'/>", "not in the file"),
        ("<path d='M1 1'/>", "without an extent"),
        ("<blob/>", "unknown"),
        ("<style>g > rect {fill: none}</style>", "selector"),
    ] {
        assert_eq!(counts(element), [0; 3], "{element}");
        let drawing = drawn(&format!("{element}<path d='M1 1H9' stroke='black'/>"));
        assert_eq!(said(&drawing, RemarkKind::Dropped, why), 1, "{element}: {:?}", drawing.import);
    }
    let drawing =
        drawn("<path d='M1 1H9' stroke='black'/><metadata/><defs><rect width='3' height='4'/></defs>");
    let dropped = drawing.import.remarks.iter().any(|said| said.kind == RemarkKind::Dropped);
    assert!(!dropped, "the control: {:?}", drawing.import);
}

#[test]
fn what_is_called_free_a_room_or_a_passage_is_free_space() {
    for name in ["id='free'", "id='room-3'", "class='passage'", "inkscape:label='Tunnels'"] {
        assert_eq!(counts(&format!("<rect {name} width='3' height='4' fill='white'/>")), [0, 0, 1], "{name}");
        assert_eq!(
            counts(&format!("<g {name}><rect width='3' height='4' fill='none' stroke='red'/></g>")),
            [0, 0, 1]
        );
    }
    let passage = drawn("<path id='tunnel' d='M1 10H9' fill='none' stroke='grey' stroke-width='2'/>");
    assert_eq!(
        passage.free[0].outline,
        [[1.0, 9.0], [9.0, 9.0], [9.0, 11.0], [1.0, 11.0]],
        "as wide as its stroke"
    );
    assert_eq!(
        counts("<g id='free'><rect id='rock' width='3' height='4'/></g>"),
        [0, 1, 0],
        "the innermost name counts"
    );
    assert_eq!(
        counts("<rect id='pillar' width='3' height='4' fill='none' stroke='red'/>"),
        [0, 1, 0],
        "only outlined"
    );
}

#[test]
fn materials_come_from_layers_ids_and_classes() {
    let drawing = drawn(
        "<g inkscape:groupmode='layer' inkscape:label='Concrete walls'><path d='M0 0H1' stroke='red'/>\
         <path id='wood-12' d='M0 0H1' stroke='red'/></g><g inkscape:label='Layer 1'><path d='M0 0H1' stroke='red'/>\
         <path class='brick' data-loss-db='7.5' d='M0 0H1' stroke='red'/></g>",
    );
    let of = |index: usize| drawing.walls[index].material.map(|of| &drawing.materials[of]);
    let names: Vec<_> = (0..4).map(|index| of(index).map(|material| material.name.as_str())).collect();
    assert_eq!(names, [Some("concrete"), Some("wood"), None, Some("brick")]);
    assert_eq!(of(3).unwrap().loss_db, Some(7.5));
}

#[test]
fn a_style_sheet_styles_by_tag_class_and_id() {
    let sheet = "<style>.cls-1{fill:none;stroke:#231f20} #room{fill:#eee} path{stroke-width:3}</style>";
    let drawing = drawn(&format!("{sheet}<path class='cls-1' d='M0 0H9'/><path id='room' d='M0 0H9V9'/>"));
    assert_eq!((drawing.walls.len(), drawing.free.len(), drawing.solids.len()), (1, 1, 0));
    assert_eq!((drawing.walls[0].thickness_m, drawing.walls[0].material), (3.0, None));
}

#[test]
fn a_place_is_what_stands_in_a_layer_of_places() {
    let drawing = drawn(
        "<g inkscape:label='places'><text x='3' y='5'><tspan>Base </tspan>camp</text><circle cx='7' cy='1' r='.5' id='goal'/>\
         </g><path d='M0 0H9' stroke='red'/>",
    );
    let places: Vec<_> = drawing.places.iter().map(|place| (place.name.as_str(), place.at_m)).collect();
    assert_eq!(places, [("Base camp", [3.0, 15.0]), ("goal", [7.0, 19.0])]);
}

#[test]
fn the_page_says_the_size_and_the_scale_makes_metres_of_it() {
    let text = |head: &str| format!("<svg {head}><path d='M0 0L10 10' stroke='black'/></svg>");
    let end = |head: &str, config: &SvgConfig| {
        let drawing = read(text(head).as_bytes(), config).unwrap();
        let guessed = said(&drawing, RemarkKind::Guessed, "scale");
        (drawing.walls[0].line[1].map(|m| (m * 1e6).round() / 1e6), guessed)
    };
    let with = |scale, unit_m, width_m| SvgConfig { scale, unit_m, width_m, ..SvgConfig::default() };
    let none = with(None, None, None);
    assert_eq!(end("width='210mm' height='297mm' viewBox='0 0 210 297'", &none), ([1.0, 28.7], 1), "1:100");
    assert_eq!(end("width='21cm' height='29.7cm' viewBox='0 0 210 297'", &none), ([1.0, 28.7], 1));
    assert_eq!(end("width='960' height='960'", &none), ([0.264_583, 25.135_417], 1), "px are 96 to the inch");
    assert_eq!(
        end("width='210mm' height='297mm' viewBox='0 0 210 297'", &with(Some(500.0), None, None)),
        ([5.0, 143.5], 0)
    );
    assert_eq!(
        end("width='210mm' height='297mm' viewBox='0 0 21 29.7'", &with(None, Some(2.0), None)),
        ([20.0, 39.4], 0)
    );
    assert_eq!(end("width='100%' viewBox='0 0 20 10'", &with(None, None, Some(40.0))), ([20.0, 0.0], 0));
    assert_eq!(end("viewBox='-5 -5 20 10' data-uchain-unit-m='1'", &none), ([15.0, -5.0], 0));
    let own = "viewBox='0 0 20 10' data-uchain-unit-m='1' data-uchain-origin-m='500000 4650000.25'";
    assert_eq!(end(own, &none), ([500_010.0, 4_650_000.25], 0), "to the millimetre, far from home");
}

#[test]
fn transforms_inner_pages_and_uses_put_things_where_browsers_do() {
    let at = |inside: &str| {
        drawn(inside).walls[0].line.iter().map(|p| p.map(|m| (m * 1e9).round() / 1e9)).collect::<Vec<_>>()
    };
    let path = "<path d='M0 0H1' stroke='red'/>";
    assert_eq!(
        at(&format!("<g transform='translate(3,4) rotate(90)'>{path}</g>")),
        [[3.0, 16.0], [3.0, 15.0]]
    );
    assert_eq!(
        at(&format!("<svg x='10' y='5' width='8' height='4' viewBox='0 0 2 1'>{path}</svg>")),
        [[10.0, 15.0], [14.0, 15.0]]
    );
    let symbol = format!(
        "<symbol id='s' viewBox='0 0 1 1'>{path}</symbol><use href='#s' x='2' y='3' width='4' height='4'/>"
    );
    assert_eq!(at(&symbol), [[2.0, 17.0], [6.0, 17.0]]);
    let xlink = format!("<defs><g id='a'>{path}</g></defs><use xlink:href='#a' transform='scale(2)' y='1'/>");
    assert_eq!(at(&xlink), [[0.0, 18.0], [2.0, 18.0]]);
    let arc = drawn("<path d='M0 0A5 5 0 0 1 10 0' fill='none' stroke='red'/>");
    let top = arc.walls[0].line.iter().map(|p| p[1]).fold(0.0, f64::max);
    assert!((top - 25.0).abs() < 0.011, "the half circle bulges up: {top}");
}

#[test]
fn a_ring_of_rock_has_a_hole_in_it() {
    let ring = "<path fill-rule='evenodd' d='M0 0H9V9H0zM1 1H8V8H1z'/>";
    let drawing = drawn(ring);
    assert_eq!((drawing.solids.len(), drawing.solids[0].shape.holes.len()), (1, 1));
}

fn each(count: usize, text: impl Fn(usize) -> String) -> String {
    let mut all = String::new();
    for index in 0..count {
        all += &text(index);
    }
    all
}

#[test]
#[expect(clippy::disallowed_methods, reason = "how long it takes is what is asked")]
fn what_means_harm_is_refused_in_words_and_in_time() {
    let deep = format!("<svg>{}", "<g>".repeat(1_000_000));
    let wide = format!("<svg>{}</svg>", "<g/>".repeat(1_000_000));
    let names = format!("<svg {}/>", each(300_000, |i| format!("a{i}='' ")));
    let spaces = format!("<svg {}/>", each(70_000, |i| format!("xmlns:a{i}='b' ")));
    let lots = format!("<svg>{}</svg>", "<g a='' b='' c='' d='' e='' f='' g='' h=''/>".repeat(90_000));
    let bomb = each(19, |i| format!("<g id='a{}'>{}</g>", i + 1, format!("<use href='#a{i}'/>").repeat(10)));
    let bomb = svg(&format!("<defs><rect id='a0' width='1' height='1'/>{bomb}</defs><use href='#a19'/>"));
    let ring = svg("<g id='a'><use href='#a'/></g>");
    let entities = "<!DOCTYPE svg [<!ENTITY a 'xxxx'><!ENTITY b '&a;&a;'>]><svg>&b;</svg>".to_owned();
    let far = svg("<path d='M0 0L1e300 0' stroke='red'/>");
    let none = svg("<path d='M0 0L1e999 0C1e999 1e999 nan 0 0 1' stroke='red'/>");
    let curves = svg(&format!("<path stroke='red' d='M0 0{}'/>", "c1e7 1e7 -1e7 1e7 0 0".repeat(200_000)));
    let corners = svg(&format!("<path stroke='red' d='M0 0{}'/>", "h1v1".repeat(600_000)));
    let rings = svg(&format!("<path d='{}'/>", "M0 0H9V9H0z".repeat(30_000)));
    let css = svg(&format!("<style>{}</style>", ".a{fill:red}".repeat(90_000)));
    let page =
        "<svg width='1e300' height='1e300' viewBox='0 0 1e-300 1e-300'><rect width='1' height='1'/></svg>"
            .to_owned();
    let cases: [(&str, String, &str); 18] = [
        ("a million levels", deep, "more than 128 elements within each other"),
        ("a million elements", wide, "more than 100000 elements"),
        ("attributes of one element", names, "more than 200 attributes of one element"),
        ("namespaces", spaces, "more than 1000 declarations of namespaces"),
        ("attributes", lots, "more than 500000 attributes"),
        ("a bomb of uses", bomb, "all that <use> draws again"),
        ("a use of itself", ring, "does a <use> name what it is in"),
        ("entities", entities, "declares entities"),
        ("far", far, "is the scale right?"),
        ("no number", none, "nothing in it is a wall"),
        ("curves", curves, "more than 1000000 corners"),
        ("corners", corners, "more than 1000000 corners"),
        ("rings", rings, "more rings within each other than can be told apart"),
        ("sheets", css, "bytes of style sheets"),
        ("page", page, "expected numbers: look at width"),
        ("compressed", "\u{1f}".to_owned(), "no XML"),
        ("no SVG", "<html/>".to_owned(), "its root is <html>; expected <svg>"),
        ("cut off", "<svg><g".to_owned(), "no XML"),
    ];
    for (name, text, expected) in cases {
        let start = std::time::Instant::now();
        let mut refused = None;
        let memory = allocation_counter::measure(|| refused = Some(read(text.as_bytes(), &config())));
        let why = refused.unwrap().unwrap_err();
        let took_s = start.elapsed().as_secs_f64();
        println!("{name}: {took_s:.3} s, {} MB: {why}", memory.bytes_max >> 20);
        assert!(memory.bytes_max < 128 << 20, "{name}: {} MB", memory.bytes_max >> 20);
        assert!(why.contains(expected), "{name}: {why}");
        assert!(took_s < 4.0, "{name}: {took_s} s");
    }
    let packed = read(&[0x1f, 0x8b, 8], &config()).unwrap_err();
    assert!(packed.contains(".svgz"), "{packed}");
    assert!(read(b"\xff\xfe<\0", &config()).unwrap_err().contains("no text in UTF-8 from byte 0"));
}

const EXAMPLE: &str = "<svg xmlns='http://www.w3.org/2000/svg' xmlns:i='http://www.inkscape.org/namespaces/inkscape' \
    width='40mm' height='20mm' viewBox='0 0 40 20'><!-- c --><style>.a{fill:none;stroke:#000}</style><defs><symbol id='s' \
    viewBox='0 0 2 2'><circle cx='1' cy='1' r='1'/></symbol></defs><g i:label='room'><rect x='1' y='1' width='30' height='9' \
    rx='1'/></g><path class='a' d='M1 1c2 3 4 5 6 7s1 2 3 4q1 2 3 4t1 2a3 4 30 0 1 5 6zM9 9H3V2l-1-2z'/><use href='#s' x='3' \
    width='4' height='4' transform='rotate(30) skewX(10) matrix(1 0 0 1 2 3)'/><g id='places'><text x='1' y='2'>A</text></g>\
    <polygon points='1,2 3,4 5,6.5e0' style='fill:#123;opacity:.5'/></svg>";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_damaged_drawing_is_read_or_refused_in_words(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..6),
        bytes in prop::option::weighted(0.1, prop::collection::vec(any::<u8>(), 0..200)),
    ) {
        let mut text = bytes.unwrap_or_else(|| EXAMPLE.as_bytes().to_vec());
        for (at, byte, what) in cuts {
            if text.is_empty() { break }
            let at = at.index(text.len());
            match what {
                0 => text[at] = byte % 128,
                1 => { text.remove(at); }
                2 => text.insert(at, b"0123456789-.eE<>/'\"= #M"[usize::from(byte) % 23]),
                _ => { let piece = text[at..(at + usize::from(byte)).min(text.len())].to_vec(); text.splice(at..at, piece); }
            }
        }
        if let Ok(drawing) = read(&text, &SvgConfig::default()) {
            let ends = drawing.walls.iter().flat_map(|wall| &wall.line).flatten();
            prop_assert!(ends.into_iter().all(|m| m.is_finite()));
        }
    }
}
