//! The bytes of a `.3d` file, versions 3 to 8, as <https://survex.com/docs/3dformat.htm> describes them.

mod items_v3;
mod items_v8;

use super::MAGIC;

/// Most bytes of a file.
pub(super) const MOST_BYTES: u64 = 32 << 20;
/// Most stations, legs and cross-sections of a file, each: more than the longest cave known has.
const MOST: usize = 200_000;
/// Longest name of a station (bytes).
const LONGEST_NAME: usize = 1024;
/// Most bytes of all names together.
const MOST_NAMES_BYTES: usize = 32 << 20;

/// What a file says of a cave.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Survey {
    /// What stands between a survey's name and a station's.
    pub(super) separator: char,
    pub(super) stations: Vec<Station>,
    pub(super) legs: Vec<Leg>,
    pub(super) sections: Vec<Section>,
}

/// A named place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Station {
    /// With the names of its surveys: "dowcave.dow1.12"; empty for one that nobody named.
    pub(super) name: String,
    pub(super) at_cm: [i32; 3],
    pub(super) entrance: bool,
}

/// A measured line between two places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    pub(super) from_cm: [i32; 3],
    pub(super) to_cm: [i32; 3],
    /// Of [`Leg::SURFACE`], [`Leg::DUPLICATE`], [`Leg::SPLAY`] and ones without a meaning here.
    pub(super) flags: u8,
    /// Known to lead on, but not measured.
    pub(super) unsurveyed: bool,
}

impl Leg {
    /// Above ground.
    pub(super) const SURFACE: u8 = 0x01;
    /// Of a passage that others have surveyed.
    pub(super) const DUPLICATE: u8 = 0x02;
    /// From a station to the wall.
    pub(super) const SPLAY: u8 = 0x04;

    pub(super) fn is(&self, flag: u8) -> bool {
        self.flags & flag != 0
    }
}

/// How far the walls are at a station, seen in the direction of the passage; `None` is not measured.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Section {
    pub(super) station: String,
    pub(super) left_m: Option<f64>,
    pub(super) right_m: Option<f64>,
    /// The passage ends here.
    pub(super) last: bool,
}

/// What a file holds, or what is wrong at which byte.
pub(super) fn read(bytes: &[u8]) -> Result<Survey, String> {
    let mut bytes = Bytes { bytes, at: 0 };
    if bytes.line() != Some(MAGIC) {
        return Err(format!("byte 0: expected the line \"{}\"", String::from_utf8_lossy(MAGIC)));
    }
    let version = match bytes.line() {
        Some([b'v', digit @ b'3'..=b'8']) => digit - b'0',
        other => {
            let got: String = String::from_utf8_lossy(other.unwrap_or_default()).chars().take(20).collect();
            return Err(format!(
                "byte {}: version {got:?}: expected v3 to v8; cavern of Survex 0.97 or later writes it",
                MAGIC.len() + 1
            ));
        }
    };
    let mut survey = Survey { separator: '.', stations: Vec::new(), legs: Vec::new(), sections: Vec::new() };
    let head = bytes.line().ok_or("the file ends within its title")?;
    bytes.line().ok_or("the file ends within its date")?;
    let mut reader = Reader { bytes, survey, label: Vec::new(), names_bytes: 0, here_cm: [0; 3] };
    if version == 8 {
        // Title, coordinates' system, separator.
        if let Some(&[separator]) = head.split(|&byte| byte == 0).nth(2) {
            reader.survey.separator = char::from(separator);
        }
        if reader.bytes.byte()? & 0x80 != 0 {
            return Err("an extended elevation, a cave unrolled to be seen from the side; expected the survey itself, \
                        as cavern writes it"
                .to_owned());
        }
        reader.items_v8()?;
    } else {
        reader.items_v3(version)?;
    }
    survey = reader.survey;
    if survey.legs.is_empty() {
        return Err("no leg is in it".to_owned());
    }
    Ok(survey)
}

/// What is left of a file.
struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    /// Up to the next line feed, which is left out.
    fn line(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..)?;
        let length = rest.iter().position(|&byte| byte == b'\n')?;
        self.at += length + 1;
        rest.get(..length)
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count).filter(|&end| end <= self.bytes.len());
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let taken =
            taken.ok_or_else(|| format!("byte {}: the file ends here; it is cut off", self.bytes.len()))?;
        self.at += count;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    fn byte(&mut self) -> Result<u8, String> {
        self.array().map(|[byte]| byte)
    }

    fn u16(&mut self) -> Result<u16, String> {
        self.array().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Result<u32, String> {
        self.array().map(u32::from_le_bytes)
    }

    fn i32(&mut self) -> Result<i32, String> {
        self.array().map(i32::from_le_bytes)
    }

    fn place(&mut self) -> Result<[i32; 3], String> {
        Ok([self.i32()?, self.i32()?, self.i32()?])
    }
}

/// Walks over the items.
struct Reader<'a> {
    bytes: Bytes<'a>,
    survey: Survey,
    /// The name that items change bit by bit.
    label: Vec<u8>,
    names_bytes: usize,
    here_cm: [i32; 3],
}

impl Reader<'_> {
    /// Cuts bytes off the name's end and puts some of the file's there.
    fn relabel(&mut self, cut: usize, add: usize) -> Result<(), String> {
        let at = self.bytes.at;
        let kept = self.label.len().checked_sub(cut).ok_or_else(|| {
            let known = self.label.len();
            format!("byte {at}: {cut} characters are to be cut off a name of {known}")
        })?;
        if kept.saturating_add(add) > LONGEST_NAME {
            return Err(format!(
                "byte {at}: a name of {} bytes; at most {LONGEST_NAME} are read",
                kept.saturating_add(add)
            ));
        }
        self.label.truncate(kept);
        let added = self.bytes.take(add)?;
        self.label.extend_from_slice(added);
        Ok(())
    }

    fn name(&mut self) -> Result<String, String> {
        self.names_bytes += self.label.len();
        if self.names_bytes > MOST_NAMES_BYTES {
            return Err(format!("byte {}: more than {MOST_NAMES_BYTES} bytes of names", self.bytes.at));
        }
        Ok(String::from_utf8_lossy(&self.label).into_owned())
    }

    fn room(&self, got: usize, what: &str) -> Result<(), String> {
        if got < MOST { Ok(()) } else { Err(format!("byte {}: more than {MOST} {what}", self.bytes.at)) }
    }

    fn station(&mut self, flags: u8) -> Result<(), String> {
        self.room(self.survey.stations.len(), "stations")?;
        let at_cm = self.bytes.place()?;
        let name = self.name()?;
        self.survey.stations.push(Station { name, at_cm, entrance: flags & 0x04 != 0 });
        Ok(())
    }

    fn leg(&mut self, flags: u8, unsurveyed: bool) -> Result<(), String> {
        self.room(self.survey.legs.len(), "legs")?;
        let (from_cm, to_cm) = (self.here_cm, self.bytes.place()?);
        self.survey.legs.push(Leg { from_cm, to_cm, flags: flags & 0x07, unsurveyed });
        self.here_cm = to_cm;
        Ok(())
    }

    /// A cross-section whose name has been read; its item's code says how wide the numbers are.
    fn section(&mut self, code: u8) -> Result<(), String> {
        self.room(self.survey.sections.len(), "cross-sections")?;
        let mut sides_m = [None; 4];
        for side_m in &mut sides_m {
            // Negative: not measured.
            let cm = if code & 0x02 == 0 {
                i16::from_le_bytes(self.bytes.array()?).into()
            } else {
                self.bytes.i32()?
            };
            *side_m = (cm >= 0).then(|| f64::from(cm) / 100.0);
        }
        let [left_m, right_m, ..] = sides_m;
        let station = self.name()?;
        self.survey.sections.push(Section { station, left_m, right_m, last: code & 0x01 != 0 });
        Ok(())
    }

    fn unknown(&self, code: u8, version: u8) -> String {
        let at = self.bytes.at.saturating_sub(1);
        format!("byte {at}: 0x{code:02x} starts no item that version {version} knows")
    }
}
