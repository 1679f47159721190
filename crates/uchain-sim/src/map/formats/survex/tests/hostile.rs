//! Files that are cut off, that lie about lengths, or that are noise.

use proptest::prelude::*;

use super::*;

#[test]
fn a_file_that_is_cut_off_anywhere_is_refused() {
    for version in 3..=8 {
        let whole = by_survex(version);
        assert!(laid(&whole, "").is_ok(), "the control: version {version}");
        for length in 0..whole.len() - 1 {
            let said = laid(&whole[..length], "").unwrap_err().to_string();
            assert!(said.starts_with("cave.3d: "), "version {version}, {length} bytes: {said}");
        }
    }
}

#[test]
fn what_is_wrong_is_said_with_its_byte() {
    let head = b"Survex 3D Image File\nv8\nx\n@0\n\0";
    let with = |rest: &[u8]| [head.as_slice(), rest].concat();
    let cases: [(Vec<u8>, &str); 10] = [
        (b"Survex".to_vec(), "byte 0: expected the line \"Survex 3D Image File\""),
        (b"Survex 3D Image File\nv2\nx\n@0\n".to_vec(), "version \"v2\": expected v3 to v8"),
        (b"Survex 3D Image File\nv8\nx\n@0\n\x80".to_vec(), "an extended elevation"),
        (with(b"\x05"), "byte 30: 0x05 starts no item that version 8 knows"),
        (with(b"\0\0"), "no leg is in it"),
        (with(b"\x80\x10a"), "byte 32: 1 characters are to be cut off a name of 0"),
        (with(b"\x80\0\0\xff\xff\xff\xff\xff"), "a name of 4294967295 bytes; at most 1024 are read"),
        (with(b"\x80\0\xff\xff\xff\xff\xff\0"), "4294967295 characters are to be cut off"),
        (with(b"\x0f\0\0"), "byte 33: the file ends here; it is cut off"),
        (b"Survex 3D Image File\nv3\nx\n@0\n\x01".to_vec(), "more is to be cut off a name than it has"),
    ];
    for (bytes, expected) in &cases {
        let said = laid(bytes, "").unwrap_err().to_string();
        assert!(said.contains(expected), "expected {expected:?}: {said}");
    }
}

/// Most memory (bytes).
const MOST_BYTES: u64 = 128 << 20;

/// A survey of one line through these places, read with little memory; or in which words it was refused.
fn sparing(name: &str, count: i32, place: impl Fn(i32) -> [f64; 3]) -> Result<Map, String> {
    let through_m: Vec<[f64; 3]> = (0..count).map(place).collect();
    let stations: Vec<(&str, [f64; 3], u8)> = through_m.iter().map(|&at_m| ("", at_m, 0)).collect();
    let bytes = written(&[Way { through_m: &through_m, flags: 0 }], &stations, &[]);
    let mut read = None;
    let memory = allocation_counter::measure(|| read = Some(laid(&bytes, "")));
    assert!(memory.bytes_max < MOST_BYTES, "{name}: {} MB", memory.bytes_max >> 20);
    read.unwrap().map_err(|error| error.to_string())
}

#[test]
fn large_files_are_read_or_refused_with_little_memory() {
    let lattice = |at: i32| [f64::from(at % 1000) * 2.0, f64::from(at / 1000) * 2.0, 0.0];
    let said = sparing("a million stations", 1_000_000, lattice).unwrap_err();
    assert!(said.contains("more than 200000 legs"), "{said}");
    let said = sparing("many", 150_000, lattice).unwrap_err();
    assert!(said.contains("149999 passages, more than the 50000 of a map"), "{said}");
    let heap = |at: i32| [f64::from(at % 7) / 10.0, f64::from(at % 11) / 10.0, f64::from(at)];
    let said = sparing("heap", 40_000, heap).unwrap_err();
    assert!(said.contains("lie close together"), "{said}");
    // All legs cross in the middle.
    let star = |at: i32| {
        [f64::from(at) - 20_000.0, if at % 2 == 0 { -1e4 } else { 1e4 }, 0.0]
            .map(|m| m * f64::from(1 - at % 2 * 2))
    };
    let said = sparing("star", 40_000, star).unwrap_err();
    assert!(said.contains("lie close together"), "{said}");
    let far = |at: i32| [2.1e7, -2.1e7, 2.1e7].map(|m: f64| m * f64::from(1 - at * 2));
    let said = sparing("far", 2, far).unwrap_err();
    assert!(said.contains("size of the drawing"), "{said}");
    let ring =
        sparing("ring", 9000, |at| [[0.0; 3], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0]][at as usize % 3]).unwrap();
    let said = remarks(&ring);
    assert!(said.contains("dropped 8996 legs without length, or between the same two stations"), "{said}");
}

#[test]
fn long_names_take_no_more_room_than_is_allowed() {
    // Names of a kilobyte, each written with 15 bytes.
    let mut bytes = written(
        &[Way { through_m: &[[0.0; 3], [9.0, 0.0, 0.0]], flags: 0 }],
        &[(&"x".repeat(200), [0.0; 3], 0)],
        &[],
    );
    bytes.pop();
    for _ in 0..3 {
        bytes.extend([0x80, 0, 0, 255, 255, 0, 0, 0]);
        bytes.extend([b'y'; 255]);
        bytes.extend([0; 12]);
    }
    for _ in 0..100_000 {
        bytes.extend([0x80, 0x11, b'z']);
        bytes.extend([0; 12]);
    }
    bytes.push(0);
    let said = laid(&bytes, "").unwrap_err().to_string();
    assert!(said.contains("more than 33554432 bytes of names"), "{said}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn noise_is_refused_in_words_or_read(
        version in b'3'..=b'8', noise in prop::collection::vec(any::<u8>(), 0..400),
    ) {
        let head = [b"Survex 3D Image File\nv".as_slice(), &[version], b"\nx\n@0\n"].concat();
        let _ = laid(&noise, "");
        let _ = laid(&[head, noise].concat(), "");
    }

    #[test]
    fn a_file_with_some_bytes_changed_is_refused_in_words_or_read(
        version in 3..=8_u8, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
    ) {
        let mut bytes = by_survex(version);
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let _ = laid(&bytes, "");
        let _ = laid(&bytes, "from = \"1\"\nto = \"4\"\nbranch_m = 10");
    }
}
