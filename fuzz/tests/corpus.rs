//! What fuzzing has found, and the inputs that reach farthest, replayed without a fuzzer.

use std::{fs, path::Path};

/// All inputs of a target.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    let files = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let inputs: Vec<_> = files.map(|file| fs::read(file.unwrap().path()).unwrap()).collect();
    assert!(inputs.len() > 20, "{}: {} inputs", folder.display(), inputs.len());
    inputs
}

/// Bytes of a generator that needs no crate: SplitMix64.
fn drawn(seed: u64, length: usize) -> Vec<u8> {
    let mut state = seed;
    let mut draw = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 56) as u8
    };
    (0..length).map(|_| draw()).collect()
}

#[test]
fn a_node_keeps_its_limits_whatever_it_sees() {
    for input in corpus("node") {
        uchain_fuzz::node(&input);
    }
    for seed in 0..20_000 {
        uchain_fuzz::node(&drawn(seed, 600));
    }
}

#[test]
fn bytes_from_the_radio_are_a_packet_of_numbers_or_none() {
    for input in corpus("wire") {
        uchain_fuzz::wire(&input);
    }
    for seed in 0..100_000 {
        let mut bytes = drawn(seed, seed as usize % 40 + 1);
        // Most with the version that is read on.
        if seed % 4 != 0 {
            bytes[0] = 1;
        }
        uchain_fuzz::wire(&bytes);
    }
}

/// Inputs of a target as they are, and with pieces of them lost, doubled or replaced.
fn replay(target: &str, read: fn(&[u8])) {
    for (index, input) in corpus(target).into_iter().enumerate() {
        read(&input);
        for seed in 0..40 {
            let draws = drawn(1000 * index as u64 + seed, 8);
            let at = |draw: usize| usize::from(draws[draw]) * 256 + usize::from(draws[draw + 1]);
            let mut damaged = input.clone();
            if damaged.is_empty() {
                continue;
            }
            let from = at(0) % damaged.len();
            let to = (from + at(2) % 40).min(damaged.len());
            match draws[4] % 3 {
                0 => drop(damaged.drain(from..to)),
                1 => damaged.splice(from..from, input[from..to].iter().copied()).for_each(drop),
                _ => damaged[from] = draws[5] % 128,
            }
            read(&damaged);
        }
    }
}

#[test]
fn an_svg_drawing_is_a_map_or_refused() {
    replay("svg", uchain_fuzz::svg);
}

#[test]
fn a_geojson_file_is_a_map_or_refused() {
    replay("geojson", uchain_fuzz::geojson);
}

#[test]
fn a_dxf_drawing_is_a_map_or_refused() {
    replay("dxf", uchain_fuzz::dxf);
}

#[test]
fn a_survey_is_a_map_or_refused() {
    replay("survex", uchain_fuzz::survex);
}

#[test]
fn a_layout_of_tiles_is_a_map_or_refused() {
    replay("subt", uchain_fuzz::subt);
}
