//! Every picture is read as the crate `image` reads it, and refused where it refuses.

use std::io::Cursor;

use image::{DynamicImage, ImageError, ImageReader};
use png::{BitDepth, ColorType};
use proptest::prelude::*;

use super::{MOST_CELLS, MOST_SIDE, Picture, PictureError};

/// What is asked of a picture: its width, and the mean colour and whether it is opaque of every pixel.
type Read = Result<(usize, Vec<(f64, bool)>), PictureError>;

fn read(file: &[u8]) -> Read {
    let picture = Picture::decode(file)?;
    Ok((picture.cols(), picture.pixels().map(|pixel| (pixel.mean, pixel.opaque)).collect()))
}

/// The same by the crate `image`.
fn oracle(file: &[u8]) -> Read {
    let why = |error: ImageError| match error {
        ImageError::Unsupported(_) => PictureError::Unknown,
        ImageError::Limits(_) => PictureError::TooLarge,
        _ => PictureError::Damaged,
    };
    let mut reader = ImageReader::new(Cursor::new(file)).with_guessed_format().unwrap();
    let mut limits = image::Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MOST_SIDE), Some(MOST_SIDE));
    reader.limits(limits);
    let picture = reader.decode().map_err(why)?;
    let cols = picture.width() as usize;
    let alpha = picture.color().has_alpha();
    let opaque: Vec<bool> =
        picture.to_rgba16().pixels().map(|pixel| !alpha || pixel.0[3] == u16::MAX).collect();
    let means: Vec<f64> = match picture {
        DynamicImage::ImageLuma8(grey) => grey.pixels().map(|pixel| f64::from(pixel.0[0])).collect(),
        colours => {
            let mean = |[r, g, b]: [u8; 3]| f64::from(u16::from(r) + u16::from(g) + u16::from(b)) / 3.0;
            colours.into_rgb8().pixels().map(|pixel| mean(pixel.0)).collect()
        }
    };
    Ok((cols, means.into_iter().zip(opaque).collect()))
}

/// What the oracle says of `file`, which is what we say of it but for two limits: it bounds the sides and not the cells
/// in all, and takes what does not fit its numbers for another format.
#[track_caller]
fn agreed(file: &[u8]) -> Read {
    let read = read(file);
    let told = String::from_utf8_lossy(&file[..file.len().min(200)]);
    match read {
        Err(PictureError::TooManyCells { cols, rows }) => {
            assert!(cols <= MOST_SIDE && rows <= MOST_SIDE, "{told:?}");
            assert!(u64::from(cols) * u64::from(rows) > MOST_CELLS, "{told:?}");
        }
        Err(PictureError::TooLarge) => {
            let refused = oracle(file);
            assert!(
                matches!(refused, Err(PictureError::TooLarge | PictureError::Unknown)),
                "{told:?}: {refused:?}"
            );
        }
        _ => assert_eq!(read, oracle(file), "{told:?}"),
    }
    read
}

/// A PNG of such pixels, in bytes as PNG packs them.
fn png(cols: u32, rows: u32, color: ColorType, depth: BitDepth, data: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, cols, rows);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ColorType::Indexed {
        // Every index a byte may hold, some of them half seen through.
        encoder.set_palette((0..=255_u8).flat_map(|i| [i, i.wrapping_mul(7), 255 - i]).collect::<Vec<u8>>());
        if data.first().is_some_and(|first| first & 1 == 1) {
            encoder.set_trns((0..=255_u8).map(|i| i | 0x80).collect::<Vec<u8>>());
        }
    }
    let row_bytes = (cols as usize * color.samples() * depth as usize).div_ceil(8);
    let data: Vec<u8> = data.iter().copied().cycle().take(row_bytes * rows as usize).collect();
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
    file
}

const PNG_KINDS: [(ColorType, BitDepth); 15] = [
    (ColorType::Grayscale, BitDepth::One),
    (ColorType::Grayscale, BitDepth::Two),
    (ColorType::Grayscale, BitDepth::Four),
    (ColorType::Grayscale, BitDepth::Eight),
    (ColorType::Grayscale, BitDepth::Sixteen),
    (ColorType::Rgb, BitDepth::Eight),
    (ColorType::Rgb, BitDepth::Sixteen),
    (ColorType::Indexed, BitDepth::One),
    (ColorType::Indexed, BitDepth::Two),
    (ColorType::Indexed, BitDepth::Four),
    (ColorType::Indexed, BitDepth::Eight),
    (ColorType::GrayscaleAlpha, BitDepth::Eight),
    (ColorType::GrayscaleAlpha, BitDepth::Sixteen),
    (ColorType::Rgba, BitDepth::Eight),
    (ColorType::Rgba, BitDepth::Sixteen),
];

#[test]
fn a_sample_of_two_bytes_is_rounded_to_one_as_the_oracle_does_whatever_it_is() {
    let all: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_be_bytes).collect();
    for (color, cols) in
        [(ColorType::Grayscale, 256), (ColorType::GrayscaleAlpha, 128), (ColorType::Rgba, 64)]
    {
        assert_eq!(
            agreed(&png(cols, 256, color, BitDepth::Sixteen, &all)).unwrap().1.len(),
            cols as usize * 256
        );
    }
    let pgm = [b"P5 256 256 65535\n".as_slice(), &all].concat();
    assert_eq!(agreed(&pgm).unwrap().1.last(), Some(&(255.0, true)));
}

#[test]
fn every_largest_sample_scales_every_sample_as_the_oracle_does() {
    for white in (1..=255_u32).chain([256, 300, 1023, 4095, 40_000, 65_534, 65_535, 65_536, 0]) {
        let all: Vec<u8> =
            (0..=u16::MAX).step_by(if white > 255 { 7 } else { 1 }).flat_map(u16::to_be_bytes).collect();
        let _ = agreed(&[format!("P5 128 64 {white}\n").as_bytes(), &all].concat());
        for kind in ["", "TUPLTYPE GRAYSCALE\n"] {
            let pam = format!("P7\nWIDTH 128\nHEIGHT 64\nDEPTH 1\nMAXVAL {white}\n{kind}ENDHDR\n");
            let _ = agreed(&[pam.as_bytes(), &all].concat());
        }
    }
}

#[test]
fn heads_are_read_with_the_oracles_eyes() {
    let good: &[&str] = &[
        "P1 3 2\n010\n1 0 1",
        "P1 3 2 010101 and more",
        "P2\n# a comment\n3 1\n255\n254 254 0",
        "P2 3#glued to its number\n0 1 255 ",
        "P2\x0b3\x0c1\r0255 1 2 3",
        "P3 1 1 9 1 2 3",
        "P3 1 1 999 1 2 998",
        "P4 9 1\n\u{1}\u{1}",
        "P5 3 1 200\nabc",
        "P6 1 1 255\nabc",
        "P2 0 7 255\n",
        "P5 7 0 255\n",
        "P2 1 1 9 77",
        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nENDHDR\na",
        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 4\nMAXVAL 4000000000\nENDHDR\nabcd",
        "P7\n#\nWIDTH +1\nHEIGHT \t 1 \nDEPTH 2\nMAXVAL 1\nTUPLTYPE BLACKANDWHITE_ALPHA\nENDHDR so be it\n\u{1}\0",
        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 0\nMAXVAL 9\nTUPLTYPE GRAYSCALE\nENDHDR\nab",
        "P7\nWIDTH 0\nHEIGHT 1\nDEPTH 1\nMAXVAL 9\nENDHDR",
    ];
    let mut accepted = 0;
    for head in good {
        accepted += usize::from(agreed(head.as_bytes()).is_ok());
    }
    assert_eq!(accepted, good.len() - 1, "all but the one whose comment runs into a number");
    for (head, why) in [
        ("", PictureError::Unknown),
        ("P", PictureError::Unknown),
        ("P8 1 1 1", PictureError::Unknown),
        ("GIF89a", PictureError::Unknown),
        ("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nTUPLTYPE\nENDHDR\na", PictureError::Unknown),
        (
            "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nTUPLTYPE A\nTUPLTYPE RGB\nENDHDR\na",
            PictureError::Unknown,
        ),
        ("P2", PictureError::Damaged),
        ("P7", PictureError::Damaged),
        ("P2 -1 1 1 1", PictureError::Damaged),
        ("P2 1 1 255 256", PictureError::Damaged),
        ("P2 1 1 256 65536", PictureError::Damaged),
        ("P2 1 1 65536 1", PictureError::Damaged),
        ("P2 1 1 0 1", PictureError::Damaged),
        ("P2 1 1 255 #c\n1", PictureError::Damaged),
        ("P2 4294967296 1 255 1", PictureError::Damaged),
        ("P1 1 1 2", PictureError::Damaged),
        ("P4 9 1\na", PictureError::Damaged),
        (
            "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nTUPLTYPE BLACKANDWHITE\nENDHDR\na",
            PictureError::Damaged,
        ),
        (
            "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 2\nTUPLTYPE BLACKANDWHITE\nENDHDR\n\0",
            PictureError::Damaged,
        ),
        ("P7\nWIDTH 1\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nENDHDR\na", PictureError::Damaged),
        ("P7\n WIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nENDHDR\na", PictureError::Damaged),
        ("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 5\nMAXVAL 1\nENDHDR\nabcde", PictureError::Damaged),
        ("P7\nWIDTH 1\n\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nENDHDR\na", PictureError::Damaged),
        ("P7 WIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nENDHDR\na", PictureError::Damaged),
        ("P7\n# \u{fc}\nH\u{f6}he 1\nENDHDR\n", PictureError::Damaged),
        ("P2 3000000 2 255 0", PictureError::TooLarge),
        ("P5 16385 1 255\n", PictureError::TooLarge),
        ("P5 16384 1 255\n", PictureError::Damaged),
    ] {
        assert_eq!(agreed(head.as_bytes()), Err(why), "{head:?}");
    }
}

#[test]
fn what_a_head_promises_beyond_the_file_gets_no_memory() {
    for file in [
        "P1 8192 8192 1",
        "P2 8192 8192 65535 1",
        "P3 8192 8192 65535 1",
        "P4 8192 8192 1",
        "P6 8192 8192 255 1",
    ] {
        let mut read = None;
        let allocated = allocation_counter::measure(|| read = Some(Picture::decode(file.as_bytes()).err()));
        assert_eq!(read, Some(Some(PictureError::Damaged)));
        assert!(allocated.bytes_max < 1000, "{file}: {} bytes", allocated.bytes_max);
    }
    let too_many = PictureError::TooManyCells { cols: 16_384, rows: 4097 };
    assert_eq!(agreed(b"P5 16384 4097 255\n"), Err(too_many));
    // Two numbers on their own are no picture for the oracle either, and too many cells all the same.
    assert_eq!(agreed(b"P1 7210 9310 "), Err(PictureError::TooManyCells { cols: 7210, rows: 9310 }));
    assert_eq!(agreed(b"P1 8192 8192 "), Err(PictureError::Damaged));
    assert_eq!(too_many.to_string(), "16384 × 4097 cells: more than 67108864");
    // What the oracle takes for another format is too large.
    assert_eq!(agreed(b"P6 4294967295 4294967295 65535\n"), Err(PictureError::TooLarge));
}

/// Bytes that hold the words of PNM files more often than chance would.
fn pnm() -> impl Strategy<Value = Vec<u8>> {
    let word = prop_oneof![
        4 => (0..300_u32).prop_map(|number| number.to_string()),
        2 => (0..4_u32).prop_map(|number| number.to_string()),
        1 => prop::sample::select(vec!["4096 ", "16384 ", "16385 ", "4294967295 "]).prop_map(str::to_owned),
        1 => prop::sample::select(vec!["#c", "#\n", "65535", "65536", "-1", "+1", "x", "\u{fc}"]).prop_map(str::to_owned),
    ];
    let blank = prop::sample::select(vec![" ", "\n", "\t", "  ", "\r", ""]);
    let words = prop::collection::vec((word, blank), 0..12)
        .prop_map(|words| words.into_iter().map(|(word, blank)| word + blank).collect::<String>());
    let plain = (b'1'..=b'6', words).prop_map(|(kind, words)| format!("P{} {words}", char::from(kind)));
    let line = (
        prop::sample::select(vec!["WIDTH", "HEIGHT", "DEPTH", "MAXVAL", "#", "TUPLTYPE", "\u{fc}"]),
        prop::sample::select(vec!["0", "1", "2", "3", "4", "255", "256", "RGB", "GRAYSCALE", " 1", "x", ""]),
    );
    let pam = (
        [0..4_u32, 0..4, 0..6],
        prop::sample::select(vec![0_u32, 1, 2, 200, 255, 256, 65_535, 65_536]),
        prop::sample::select(vec![
            "",
            "TUPLTYPE BLACKANDWHITE\n",
            "TUPLTYPE BLACKANDWHITE_ALPHA\n",
            "TUPLTYPE GRAYSCALE\n",
            "TUPLTYPE GRAYSCALE_ALPHA\n",
            "TUPLTYPE RGB\n",
            "TUPLTYPE RGB_ALPHA\n",
        ]),
        prop::option::weighted(0.2, line),
    )
        .prop_map(|([cols, rows, depth], white, kind, line)| {
            let line = line.map_or_else(String::new, |(word, value)| format!("{word} {value}\n"));
            format!("P7\nWIDTH {cols}\nHEIGHT {rows}\n{line}DEPTH {depth}\nMAXVAL {white}\n{kind}ENDHDR\n")
        });
    (prop_oneof![plain, pam], prop::collection::vec(prop_oneof![any::<u8>(), 0..3_u8], 0..100))
        .prop_map(|(head, samples)| [head.as_bytes(), &samples].concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_pnm_is_read_or_refused_as_by_the_oracle(file in pnm()) {
        agreed(&file).ok();
    }

    #[test]
    fn any_png_is_read_as_by_the_oracle_and_refused_once_damaged(
        kind in prop::sample::select(PNG_KINDS.to_vec()),
        sides in [1..20_u32, 1..9],
        data in prop::collection::vec(any::<u8>(), 1..200),
        cut in any::<prop::sample::Index>(),
        flip in 1..=255_u8,
    ) {
        let mut file = png(sides[0], sides[1], kind.0, kind.1, &data);
        prop_assert!(agreed(&file).is_ok());
        let at = cut.index(file.len());
        agreed(&file[..at]).ok();
        file[at] ^= flip;
        agreed(&file).ok();
    }
}
