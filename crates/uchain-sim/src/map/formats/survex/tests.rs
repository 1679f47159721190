//! Surveys that a writer of this file makes, the ones that Survex itself wrote, and a real cave.

mod caves;
mod hostile;
mod real;

use std::{
    fmt::Write as _,
    path::{Path, PathBuf},
};

use super::*;

/// One way of legs through places (m), with flags of the legs.
struct Way<'a> {
    through_m: &'a [[f64; 3]],
    flags: u8,
}

/// A survey's bytes, version 8: ways, stations by name, and cross-sections (station, left and right in m, last of its passage).
fn written(ways: &[Way], stations: &[(&str, [f64; 3], u8)], sections: &[(&str, [f64; 2], bool)]) -> Vec<u8> {
    let mut bytes = b"Survex 3D Image File\nv8\nmade up\0\0.\n@0\n\0".to_vec();
    let place = |bytes: &mut Vec<u8>, at_m: &[f64; 3]| {
        for m in at_m {
            bytes.extend(((m * 100.0).round() as i32).to_le_bytes());
        }
    };
    bytes.push(0x00);
    let mut known = String::new();
    let mut label = |bytes: &mut Vec<u8>, name: &str| {
        bytes.extend([0, known.len() as u8, name.len() as u8]);
        bytes.extend(name.bytes());
        name.clone_into(&mut known);
    };
    for way in ways {
        bytes.push(0x0f);
        place(&mut bytes, &way.through_m[0]);
        for at_m in &way.through_m[1..] {
            bytes.push(0x60 | way.flags);
            place(&mut bytes, at_m);
        }
    }
    for (name, at_m, flags) in stations {
        bytes.push(0x80 | flags);
        label(&mut bytes, name);
        place(&mut bytes, at_m);
    }
    for (name, [left_m, right_m], last) in sections {
        bytes.push(0x30 | u8::from(*last));
        label(&mut bytes, name);
        for m in [*left_m, *right_m, 1.0, 1.0] {
            bytes.extend(((m * 100.0).round() as i16).to_le_bytes());
        }
    }
    bytes.push(0x00);
    bytes
}

fn settings(text: &str) -> SurvexConfig {
    toml::from_str(&format!("file = \"cave.3d\"\n{text}")).unwrap()
}

fn laid(bytes: &[u8], text: &str) -> Result<Map, MapError> {
    survex_in_memory("cave.3d".as_ref(), bytes, &settings(text))
}

fn remarks(map: &Map) -> String {
    let mut said = String::new();
    for remark in &map.import().remarks {
        writeln!(said, "{remark}").unwrap();
    }
    said
}

/// A survey that Survex wrote of one cave, in each version of the format.
fn by_survex(version: u8) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/survex");
    std::fs::read(folder.join(format!("v{version}.3d"))).unwrap()
}

/// The real cave; `None` where this machine has none.
fn dow() -> Option<PathBuf> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let path = data.join("caves/dow_providence/DowProv.3d");
    if path.is_file() {
        return Some(path);
    }
    assert!(std::env::var_os("CI").is_none_or(|ci| ci != "true"), "{} is absent", path.display());
    eprintln!("skipped: {} is absent", path.display());
    None
}
