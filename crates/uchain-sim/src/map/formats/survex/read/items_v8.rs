//! The items of version 8: names change by how much is cut off and what is added.

use super::Reader;

impl Reader<'_> {
    pub(super) fn items_v8(&mut self) -> Result<(), String> {
        // How legs were measured; normal twice is the end.
        let mut style = None;
        loop {
            let code = self.bytes.byte()?;
            match code {
                0x00 if style == Some(0) => return Ok(()),
                0x00..=0x04 => style = Some(code),
                0x0f => self.here_cm = self.bytes.place()?,
                0x10 => {}
                // Dates.
                0x11 => drop(self.bytes.take(2)?),
                0x12 => drop(self.bytes.take(3)?),
                0x13 => drop(self.bytes.take(4)?),
                // How well a traverse closes.
                0x1f => drop(self.bytes.take(20)?),
                0x30..=0x33 => {
                    self.label_v8()?;
                    self.section(code)?;
                }
                0x40..=0x7f => {
                    if code & 0x20 == 0 {
                        self.label_v8()?;
                    }
                    self.leg(code, style == Some(4))?;
                }
                0x80..=0xff => {
                    self.label_v8()?;
                    self.station(code)?;
                }
                _ => return Err(self.unknown(code, 8)),
            }
        }
    }

    fn label_v8(&mut self) -> Result<(), String> {
        let both = self.bytes.byte()?;
        let (cut, add) = if both == 0 {
            (self.length_v8()?, self.length_v8()?)
        } else {
            (usize::from(both >> 4), usize::from(both & 0x0f))
        };
        self.relabel(cut, add)
    }

    fn length_v8(&mut self) -> Result<usize, String> {
        match self.bytes.byte()? {
            0xff => Ok(self.bytes.u32()? as usize),
            length => Ok(length.into()),
        }
    }
}
