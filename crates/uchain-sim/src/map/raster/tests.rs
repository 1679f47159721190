//! The importer on pictures drawn here, on files that are wrong, and on real buildings.

use std::{fs, path::PathBuf};

use glam::{DVec2, vec2};
use proptest::prelude::*;

use super::{
    cells::{Cells, Levels},
    contour, simplify,
};
use crate::map::{Map, MapError, Unknown, formats::ros::read::Meta, read_ros};

const YAML: &str = "image: map.pgm\nresolution: 0.5\norigin: [10.0, 20.0, 0.0]\nnegate: 0\n\
                    occupied_thresh: 0.65\nfree_thresh: 0.196\nmade_by: nobody\n";
/// Two free cells above two unknown ones, rock to their right.
const PGM: &str = "P2\n# a comment\n3 2\n255\n254 254 0\n205 205 0\n";

/// `yaml` and the picture beside it, read.
fn read(yaml: &str, picture: &[u8], unknown: Unknown) -> Result<Map, MapError> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("map.yaml");
    fs::write(&file, yaml).unwrap();
    fs::write(folder.path().join("map.pgm"), picture).unwrap();
    read_ros(&file, unknown, None, 0.0)
}

#[test]
fn a_map_stands_where_its_yaml_says_with_its_first_row_on_top() {
    let map = read(YAML, PGM.as_bytes(), Unknown::Rock).unwrap();
    assert_eq!(map.offset_m(), [10.5, 20.75]);
    assert_eq!(map.bounds(), (vec2(-0.5, -0.25), vec2(0.5, 0.25)));
    assert!(!map.in_rock(map.to_local([10.9, 20.9])) && map.in_rock(map.to_local([10.9, 20.1])));
    let open = read(YAML, PGM.as_bytes(), Unknown::Free).unwrap();
    assert!(!open.in_rock(open.to_local([10.9, 20.1])) && open.in_rock(open.to_local([11.1, 20.1])));
}

#[test]
fn a_picture_without_a_yaml_is_read_as_map_saver_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("room.pgm");
    fs::write(&file, PGM).unwrap();
    let bounds = |cell_m| read_ros(&file, Unknown::Rock, cell_m, 0.0).map(|map| map.bounds());
    assert_eq!(bounds(Some(0.05)).unwrap(), (vec2(-0.05, -0.025), vec2(0.05, 0.025)));
    assert_eq!(bounds(Some(2.0)).unwrap(), (vec2(-2.0, -1.0), vec2(2.0, 1.0)));
    // Its scale stands nowhere: nobody guesses it.
    let said = bounds(None).unwrap_err().to_string();
    assert!(
        said.contains("a picture does not say how large its pixels are") && said.contains("--cell 0.05"),
        "{said}"
    );
    // By what it holds, not by what it is called.
    let other = folder.path().join("room");
    fs::write(&other, PGM).unwrap();
    assert_eq!(read_ros(&other, Unknown::Rock, Some(0.05), 0.0).unwrap().bounds().1, vec2(0.05, 0.025));
}

#[test]
fn yaw_turns_the_picture_about_its_lower_left_corner() {
    let map = read(&YAML.replace("0.0]", "1.5707963267948966]"), PGM.as_bytes(), Unknown::Rock).unwrap();
    // The free row lay 0.5 m to 1 m above the corner; a quarter turn left puts it to the left of the corner.
    assert!(!map.in_rock(map.to_local([9.25, 20.9])) && map.in_rock(map.to_local([9.75, 20.9])));
    assert!((map.offset_m()[0] - 9.25).abs() < 1e-9 && (map.offset_m()[1] - 20.5).abs() < 1e-9);
}

#[test]
fn negate_and_thresholds_are_read_as_map_server_reads_them() {
    let negated = read(&YAML.replace("negate: 0", "negate: true"), PGM.as_bytes(), Unknown::Rock).unwrap();
    assert!(
        !negated.in_rock(negated.to_local([11.25, 20.5])) && negated.in_rock(negated.to_local([10.2, 20.7]))
    );
    // Grey 205 is just too dark for 0.196, and free for 0.2.
    let lenient = read(&YAML.replace("0.196", "0.2"), PGM.as_bytes(), Unknown::Rock).unwrap();
    assert!(!lenient.in_rock(lenient.to_local([10.2, 20.2])));
}

/// One row of pixels as a PNG: two of grey 254, then what is asked about, each of a colour and an opacity.
fn png(pixels: &[(u8, u8)], kind: image::ColorType) -> Vec<u8> {
    let width = pixels.len() as u32 + 2;
    let row = image::RgbaImage::from_fn(width, 1, |x, _| {
        let (grey, opacity) = if x < 2 { (254, 255) } else { pixels[x as usize - 2] };
        image::Rgba([grey, grey, grey, opacity])
    });
    let row = image::DynamicImage::ImageRgba8(row);
    let row = match kind {
        image::ColorType::La8 => row.into_luma_alpha8().into(),
        image::ColorType::La16 => row.into_luma_alpha16().into(),
        image::ColorType::Rgba16 => row.into_rgba16().into(),
        _ => row,
    };
    let mut bytes = std::io::Cursor::new(Vec::new());
    row.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

#[test]
fn in_mode_scale_what_is_not_opaque_is_unknown_whatever_its_colour_and_in_trinary_it_is_not() {
    let kinds =
        [image::ColorType::La8, image::ColorType::Rgba8, image::ColorType::La16, image::ColorType::Rgba16];
    let width_m = |mode: &str, picture: &[u8], unknown| {
        let map = read(&format!("{YAML}{mode}"), picture, unknown).unwrap();
        f64::from(map.bounds().1.x - map.bounds().0.x)
    };
    for kind in kinds {
        for opacity in [0, 254] {
            for grey in [254, 0] {
                let clear = png(&[(grey, opacity)], kind);
                assert_eq!(width_m("mode: scale\n", &clear, Unknown::Rock), 1.0, "{kind:?} {grey} {opacity}");
                assert_eq!(width_m("mode: scale\n", &clear, Unknown::Free), 1.5, "{kind:?} {grey} {opacity}");
                let as_if_opaque = if grey == 254 { 1.5 } else { 1.0 };
                for mode in ["", "mode: trinary\n"] {
                    assert_eq!(
                        width_m(mode, &clear, Unknown::Rock),
                        as_if_opaque,
                        "{kind:?} {grey} {opacity}"
                    );
                }
            }
        }
        let solid = png(&[(254, 255)], kind);
        assert_eq!(width_m("mode: scale\n", &solid, Unknown::Rock), 1.5, "{kind:?}");
    }
}

#[test]
fn a_broken_file_is_told_in_its_own_lines_and_in_words_for_people() {
    let said = |yaml: &str, picture: &[u8]| read(yaml, picture, Unknown::Rock).unwrap_err().to_string();
    let yaml = |from: &str, to: &str| said(&YAML.replace(from, to), PGM.as_bytes());
    for (said, expected) in [
        (
            yaml("made_by: nobody", "resolution: 2"),
            "line 7: 'resolution' is written a second time; expected every key once",
        ),
        (
            yaml("made_by: nobody", "---\nimage: x"),
            "line 7: a second document begins; expected one, without --- after it",
        ),
        (
            yaml("0.196", "0.7"),
            "free_thresh = 0.7: expected at most occupied_thresh, 0.65; are the two exchanged?",
        ),
        (yaml("map.pgm", "*x"), "line 1: a * refers to what is named nowhere; expected the value itself"),
        (yaml("map.pgm", "[x"), "not the yaml of a map; expected lines such as resolution: 0.05"),
        (yaml("resolution", "\tresolution"), "line 2: begins with a tab; yaml is indented by spaces"),
        (
            yaml("10.0, 20.0", "a, 20.0"),
            "origin = a list of 3, not all of them numbers: expected [x, y, yaw]",
        ),
        (yaml("negate: 0", "negate:"), "negate = (empty): expected 0 or 1"),
        (said("[1, 2]", b""), "line 1: not the yaml of a map; expected lines such as resolution: 0.05"),
        (said(YAML, b"not a picture"), "no picture that is read here; expected a PNG or PGM"),
        (said(YAML, b"P2 3000000 2 255 0"), "too large a picture; expected at most 16384 cells a side"),
        (
            said(YAML, b"P2 3 2 255 254 254"),
            "the picture is cut short or damaged; save it anew as PNG or PGM",
        ),
        (said(YAML, b"P2 3 2 255 254 x 3 4 5 6"), "the picture is cut short or damaged"),
    ] {
        assert!(said.contains(expected) && said.lines().count() == 1, "{said}\n  wanted {expected}");
    }
}

#[test]
fn binary_and_ascii_pgm_give_the_same_map() {
    let binary = [b"P5 3 2 255\n".as_slice(), &[254, 254, 0, 205, 205, 0]].concat();
    let walls = |picture: &[u8]| read(YAML, picture, Unknown::Rock).unwrap().walls().to_vec();
    assert_eq!(walls(&binary), walls(PGM.as_bytes()));
}

#[test]
fn what_is_wrong_is_named_by_file_key_and_expectation() {
    let error =
        |from: &str, to: &str| read(&YAML.replace(from, to), PGM.as_bytes(), Unknown::Rock).unwrap_err();
    for (from, to, wrong_key) in [
        ("image: map.pgm\n", "", "image"),
        ("map.pgm", "[1, 2]", "image"),
        ("0.5", "0", "resolution"),
        ("0.5", "fine", "resolution"),
        ("[10.0, 20.0, 0.0]", "[10.0, 20.0]", "origin"),
        ("[10.0, 20.0, 0.0]", "[10.0, 20.0, 1e9]", "origin"),
        ("negate: 0", "negate: 2", "negate"),
        ("0.65", "65", "occupied_thresh"),
        ("0.196", "0.7", "free_thresh"),
        ("made_by: nobody", "mode: raw", "mode"),
    ] {
        let got = error(from, to);
        assert!(matches!(got, MapError::Key { key, .. } if key == wrong_key), "{from} → {to}: {got}");
        assert!(got.to_string().contains("map.yaml"));
    }
    assert!(matches!(error("image", "\t{image"), MapError::Read { .. }));
    assert!(error("0.5", ".nan").to_string().ends_with("line 2: .nan: expected a finite number"));
    let absent = error("map.pgm", "other.pgm").to_string();
    assert!(["map.yaml", "image", "other.pgm"].iter().all(|part| absent.contains(part)), "{absent}");
    let solid = read(YAML, b"P2 1 1 255 0", Unknown::Rock).unwrap_err();
    assert!(solid.to_string().contains("no free cell"));
    assert!(matches!(
        read_ros("nowhere.yaml".as_ref(), Unknown::Rock, None, 0.0),
        Err(MapError::Read { .. })
    ));
    assert!(matches!(
        read_ros("nowhere.yaml".as_ref(), Unknown::Rock, None, f64::NAN),
        Err(MapError::Range { .. })
    ));
}

#[test]
fn a_slanted_wall_becomes_one_segment_and_a_speck_beside_it_stays() {
    // Free below the line y = x / 3, but for one cell of rock right under the slanted wall.
    let (cols, rows) = (90, 32);
    let free = |col: usize, row: usize| 3 * row < col && (col, row) != (45, 13);
    let cells = Cells::new(cols, (0..cols * rows).map(|cell| free(cell % cols, cell / cols)).collect());
    let loops = contour::loops(&cells).unwrap();
    let map = simplify::simplify(&loops, 1.2, 1.0, DVec2::as_vec2).unwrap();
    assert_eq!(map.loops().count(), 2);
    assert!(map.walls().len() <= 12, "{} walls", map.walls().len());
    assert!(map.in_rock(vec2(45.5, 13.5)) && !map.in_rock(vec2(45.5, 12.5)));
    let longest_m = map.walls().iter().map(|wall| wall.a.distance(wall.b)).fold(0.0, f32::max);
    assert!(longest_m > 80.0, "{longest_m}");
}

proptest! {
    #[test]
    fn every_cell_centre_is_what_its_cell_is(cols in 1_usize..12, free in prop::collection::vec(any::<bool>(), 1..144)) {
        let rows = free.len() / cols;
        prop_assume!(rows > 0 && free[..rows * cols].contains(&true));
        let cells = Cells::new(cols, free[..rows * cols].to_vec());
        let loops = contour::loops(&cells).unwrap();
        let map = simplify::simplify(&loops, 0.0, 1.0, DVec2::as_vec2).unwrap();
        prop_assert_eq!(map.first_crossing(), None);
        for (cell, free) in free[..rows * cols].iter().enumerate() {
            let centre = vec2((cell % cols) as f32 + 0.5, (cell / cols) as f32 + 0.5);
            prop_assert_eq!(map.in_rock(centre), !free, "cell {}", cell);
        }
        // Free cells that share a side see one another; those that share a corner only, do not.
        for (cell, &here) in free[..rows * cols].iter().enumerate() {
            let centre = vec2((cell % cols) as f32 + 0.5, (cell / cols) as f32 + 0.5);
            let (col, row) = ((cell % cols).cast_signed(), (cell / cols).cast_signed());
            prop_assert_eq!(here && cells.is_free(col + 1, row), map.sees(centre, centre + vec2(1.0, 0.0)));
            let block = [(1, 0), (0, 1), (1, 1)].map(|(x, y)| cells.is_free(col + x, row + y));
            if here && block == [false, false, true] {
                prop_assert!(!map.sees(centre, centre + vec2(1.0, 1.0)));
            }
        }
    }

    #[test]
    fn simplified_loops_keep_their_number_their_sides_and_their_distance(
        cols in 4_usize..40,
        free in prop::collection::vec(prop::bool::weighted(0.7), 16..1200),
        tolerance in 0.0_f64..4.0,
    ) {
        let rows = free.len() / cols;
        let cells = Cells::new(cols, free[..rows * cols].to_vec());
        let loops = contour::loops(&cells).unwrap();
        prop_assume!(!loops.is_empty());
        let map = simplify::simplify(&loops, tolerance, 1.0, DVec2::as_vec2).unwrap();
        prop_assert_eq!(map.first_crossing(), None);
        prop_assert_eq!(map.loops().count(), loops.len());
        for (walls, corners) in map.loops().zip(&loops) {
            let doubled = |corners: &[DVec2]| -> f64 {
                corners.iter().zip(corners.iter().cycle().skip(1)).map(|(p, q)| p.perp_dot(*q)).sum()
            };
            let kept: Vec<DVec2> = walls.iter().map(|wall| wall.a.as_dvec2()).collect();
            prop_assert_eq!(doubled(&kept) > 0.0, doubled(corners) > 0.0);
            for corner in corners {
                let off = walls.iter().map(|wall| wall.distance_m(corner.as_vec2())).fold(f32::INFINITY, f32::min);
                prop_assert!(f64::from(off) <= tolerance + 1e-6, "{} off by {}", corner, off);
            }
        }
    }

    #[test]
    fn no_bytes_make_the_importer_panic(yaml in prop::collection::vec(any::<u8>(), 0..200), picture in prop::collection::vec(any::<u8>(), 0..200), cut in 0_usize..200, kind in 0_usize..4) {
        let levels = Levels { negate: false, occupied: 0.65, free: 0.196, by_opacity: true };
        let head = [b"P5 ".as_slice(), b"P2 9 9 9 ", b"\x89PNG\r\n\x1a\n", b""][kind];
        let _ = Cells::decode(&[head, &picture].concat(), levels, Unknown::Free);
        let mut png = std::io::Cursor::new(Vec::new());
        image::GrayImage::from_fn(9, 7, |x, y| image::Luma([(x * y * 5) as u8])).write_to(&mut png, image::ImageFormat::Png).unwrap();
        let mut png = png.into_inner();
        prop_assert!(Cells::decode(&png, levels, Unknown::Rock).is_ok());
        let at = cut % png.len();
        png[at] ^= yaml.first().copied().unwrap_or(1) | 1;
        let _ = Cells::decode(&png, levels, Unknown::Rock);
        png.truncate(at);
        let _ = Cells::decode(&png, levels, Unknown::Rock);
        let cut = cut % YAML.len();
        let _ = read(&String::from_utf8_lossy(&[&YAML.as_bytes()[..cut], &yaml].concat()), PGM.as_bytes(), Unknown::Rock);
        let _ = Meta::parse("map.yaml".as_ref(), &yaml);
    }
}

/// A folder of the shared real maps; `None` where this machine has none.
fn shared(folder: &str) -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/maps/ros").join(folder);
    if path.is_dir() {
        return Some(path);
    }
    assert!(std::env::var_os("CI").is_none_or(|ci| ci != "true"), "{} is absent", path.display());
    eprintln!("skipped: {} is absent", path.display());
    None
}

#[test]
fn the_stata_basement_is_one_building_of_few_walls() {
    let Some(folder) = shared("f1tenth") else { return };
    let map = read_ros(&folder.join("stata_basement.yaml"), Unknown::Rock, None, 0.06).unwrap();
    let raw = read_ros(&folder.join("stata_basement.yaml"), Unknown::Rock, None, 0.0).unwrap();
    assert_eq!(map.loops().count(), raw.loops().count());
    assert!(3 * map.walls().len() < raw.walls().len(), "{} of {}", map.walls().len(), raw.walls().len());
    assert_eq!(map.offset_m(), raw.offset_m());
}

#[test]
fn a_yaml_that_names_an_absent_picture_is_an_error_naming_both() {
    let Some(folder) = shared("f1tenth") else { return };
    let error = read_ros(&folder.join("porto.yaml"), Unknown::Rock, None, 0.06).unwrap_err().to_string();
    assert!(error.contains("porto.yaml") && error.contains("image") && error.contains("map.pgm"), "{error}");
}

#[test]
fn the_middle_of_the_stata_basement_is_a_little_longer_than_its_shortest_way() {
    let Some(folder) = shared("f1tenth") else { return };
    let map = read_ros(&folder.join("stata_basement.yaml"), Unknown::Rock, None, 0.06).unwrap();
    let (from, to) = (map.to_local([-50.15, 34.03]), map.to_local([-4.0, 25.6]));
    let path = map.centre_path(from, to).unwrap();
    let shortest_m = map.geodesic(from).unwrap().distance_m(&map, to).unwrap();
    // The shortest way cuts three corners of a corridor 2.4 m wide, a metre each.
    assert!((1.0..1.08).contains(&(path.length_m() / shortest_m)), "{} {shortest_m}", path.length_m());
    for i in 0..=10_000 {
        let p = path.at(path.length_m() * i as f32 / 10_000.0).0;
        assert!(!map.in_rock(p) && map.clearance_m(p) > 0.2, "{p}: {} m from a wall", map.clearance_m(p));
    }
}
