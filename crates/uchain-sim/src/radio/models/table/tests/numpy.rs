//! Two files of numpy 2.4: `savez` of float32, and `savez_compressed` of float64. Places 10, 12, 14 m by -3, 0 m; 40 dB, and
//! 2 dB more for each metre along x and along y; NaN from the least corner to the greatest.

use super::{assert_db, db, make, of, params};
use crate::radio::NO_LINK_DB;

const STORED: &[u8] = include_bytes!("../numpy/stored.npz");
const DEFLATED: &[u8] = include_bytes!("../numpy/deflated.npz");

#[test]
fn what_numpy_writes_is_read_stored_or_deflated() {
    for bytes in [STORED, DEFLATED] {
        let model = of(bytes);
        // Rows are y, columns x: 40 + 2 · (4 + 3), and so on.
        assert_db(db(&*model, [14.0, -3.0], [10.0, 0.0]), 54.0);
        assert_db(db(&*model, [10.0, -3.0], [14.0, -3.0]), 48.0);
        assert_db(db(&*model, [10.0, -3.0], [10.0, 0.0]), 46.0);
        assert_db(db(&*model, [12.0, 0.0], [12.0, 0.0]), 40.0);
        // Along a line from the first cell to the last, |Δx| is no bend: 40 + 2 · 3.
        assert_db(db(&*model, [10.5, 0.0], [13.5, 0.0]), 46.0);
        assert_eq!(db(&*model, [10.0, -3.0], [14.0, 0.0]), NO_LINK_DB);
    }
}

#[test]
fn a_damaged_file_is_refused_and_none_makes_a_panic() {
    for bytes in [STORED, DEFLATED] {
        for length in 0..bytes.len() {
            assert!(super::super::read_npz(&bytes[..length]).is_err(), "cut to {length} bytes");
        }
        let mut refused = 0;
        for place in 0..bytes.len() {
            for bit in [0, 3, 7] {
                let mut damaged = bytes.to_vec();
                damaged[place] ^= 1 << bit;
                // Dates and the like mean nothing here.
                refused += usize::from(super::super::read_npz(&damaged).is_err());
            }
        }
        assert!(refused > bytes.len(), "{refused} of {}", 3 * bytes.len());
    }
    let file = super::file(&STORED[..500]);
    let error = make(&params(file.path())).unwrap_err().to_string();
    assert!(error.ends_with("no NPZ file: its directory is missing: is it cut short?"), "{error}");
}
