//! The items of versions 3 to 7: items that shorten the name stand before those that add to it.

use super::Reader;

impl Reader<'_> {
    pub(super) fn items_v3(&mut self, version: u8) -> Result<(), String> {
        loop {
            let code = self.bytes.byte()?;
            match code {
                0x00 if self.label.is_empty() => return Ok(()),
                0x00 => self.label.clear(),
                0x01..=0x0e => self.trim(code)?,
                0x0f => self.here_cm = self.bytes.place()?,
                0x10..=0x1f => self.relabel(usize::from(code) - 15, 0)?,
                // Dates: seconds since 1970, from version 7 on days since 1900.
                0x20 if version >= 7 => drop(self.bytes.take(2)?),
                0x21 if version >= 7 => drop(self.bytes.take(3)?),
                0x20 if version >= 4 => drop(self.bytes.take(4)?),
                0x21 if version >= 4 => drop(self.bytes.take(8)?),
                0x23 if version >= 7 => drop(self.bytes.take(4)?),
                0x24 if version >= 7 => {}
                // How well a traverse closes: since version 6, and in what newer programs write as an older one.
                0x22 => drop(self.bytes.take(20)?),
                0x30..=0x33 if version >= 5 => {
                    self.label_v3()?;
                    self.section(code)?;
                }
                0x40..=0x7f => {
                    self.label_v3()?;
                    self.station(code)?;
                }
                0x80..=0xbf => {
                    self.label_v3()?;
                    self.leg(code, false)?;
                }
                _ => return Err(self.unknown(code, version)),
            }
        }
    }

    /// Cuts 16 characters off the name and then all behind the last dot but `dots - 1`.
    fn trim(&mut self, dots: u8) -> Result<(), String> {
        let too_much = format!("byte {}: more is to be cut off a name than it has", self.bytes.at - 1);
        let searched = self.label.len().checked_sub(16).and_then(|end| self.label.get(..end));
        let mut found =
            searched.unwrap_or_default().iter().enumerate().rev().filter(|(_, byte)| **byte == b'.');
        let (dot, _) = found.nth(usize::from(dots) - 1).ok_or(too_much)?;
        self.label.truncate(dot + 1);
        Ok(())
    }

    fn label_v3(&mut self) -> Result<(), String> {
        let length = match self.bytes.byte()? {
            0xfe => 254 + usize::from(self.bytes.u16()?),
            0xff => self.bytes.u32()? as usize,
            length => length.into(),
        };
        self.relabel(0, length)
    }
}
