//! Files that somebody has made to do harm, or that were cut off: of every kind, refused in words, with little memory.

use std::{fmt::Write as _, fs, io::Write as _, path::Path};

use super::*;

/// Most memory that a file may take that is then refused (bytes).
const MOST_BYTES: u64 = 128 << 20;

/// Reads a file of this name, as the kind that it looks like, with a scale where it needs one. The words it is refused in.
fn refused(name: &str, files: &[(&str, &[u8])]) -> String {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let mut read = None;
    let memory = allocation_counter::measure(|| read = Some(lay(&folder.path().join(name))));
    let words = read.unwrap().unwrap_err();
    assert!(memory.bytes_max < MOST_BYTES, "{name}: {} MB", memory.bytes_max >> 20);
    words
}

fn lay(file: &Path) -> Result<Map, String> {
    let kind = kind_of_map(file).ok_or("no kind of map")?;
    let cell = if kind == "ros" { "cell_m = 0.05\n" } else { "" };
    let text = format!("[{kind}]\nfile = {:?}\n{cell}", file.display().to_string());
    let config: MapConfig = toml::from_str(&text).map_err(|error| error.to_string())?;
    let (map, _) = config.lay("".as_ref(), [0.0; 2]).map_err(|error| error.to_string())?;
    Ok(map)
}

/// A PNG of so many grey pixels, all of them black, and only as many rows as asked for.
fn png(side: u32, rows: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(::png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    let mut stream = writer.stream_writer().unwrap();
    let row = vec![0; side as usize];
    for _ in 0..rows {
        stream.write_all(&row).unwrap();
    }
    // What is not written is what is cut off.
    drop(stream.finish());
    drop(writer);
    bytes
}

#[test]
fn pictures_that_promise_too_much_get_no_memory() {
    let words = refused("a.pgm", &[("a.pgm", b"P5\n4000000000 4000000000\n255\n\0")]);
    assert!(words.contains("too large a picture"), "{words}");
    let words = refused("a.png", &[("a.png", &png(60_000, 100))]);
    assert!(words.contains("too large a picture"), "{words}");
    let head = b"type octile\nheight 4000000000\nwidth 4000000000\nmap\n.\n";
    let words = refused("a.map", &[("a.map", head)]);
    assert!(words.contains("expected 1 to 8192 cells"), "{words}");
    let words = refused("a.map", &[("a.map", b"type octile\nheight 8192\nwidth 8192\nmap\n.\n")]);
    assert!(words.contains("expected 8192, the width"), "{words}");
    // The control: a small one is read.
    let map = lay_bytes("a.map", b"type octile\nheight 1\nwidth 2\nmap\n..\n").unwrap();
    assert_eq!(map.walls().len(), 4);
}

fn lay_bytes(name: &str, bytes: &[u8]) -> Result<Map, String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, bytes).unwrap();
    lay(&file)
}

#[test]
fn a_yaml_that_doubles_itself_or_nests_without_end_is_refused() {
    let mut doubling = "image: a.pgm\nresolution: 0.05\na0: &a0 [x, x]\n".to_owned();
    for i in 1..60 {
        let _ = writeln!(doubling, "a{i}: &a{i} [*a{}, *a{}]", i - 1, i - 1);
    }
    refused("a.yaml", &[("a.yaml", doubling.as_bytes())]);
    for (open, close) in [("[", "]"), ("{a: ", "}"), ("- ", "")] {
        let text =
            format!("image: a.pgm\nresolution: 0.05\nb: {}{}\n", open.repeat(60_000), close.repeat(60_000));
        refused("a.yaml", &[("a.yaml", text.as_bytes())]);
    }
    for number in [".nan", ".inf", "1e400", "-1", "0"] {
        let text = format!(
            "image: a.pgm\nresolution: {number}\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.1\n"
        );
        let words = refused("a.yaml", &[("a.yaml", text.as_bytes()), ("a.pgm", b"P5\n1 1\n255\n\xff")]);
        assert!(words.contains("resolution") || words.contains("finite"), "{number}: {words}");
    }
}

#[test]
fn a_table_of_walls_of_endless_lines_is_refused() {
    let long = format!("loop,x_m,y_m\n0,0,{}\n", "1".repeat(10_000_000));
    refused("a.csv", &[("a.csv", long.as_bytes())]);
    let many = format!("loop,x_m,y_m\n{}", "0,0,0\n".repeat(2_000_000));
    let words = refused("a.csv", &[("a.csv", many.as_bytes())]);
    assert!(words.contains("must be 3 to"), "{words}");
}
