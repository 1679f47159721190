//! What was linked for the chip, read with binutils.

use std::{path::Path, process::Command};

use anyhow::{Context as _, Result};

use crate::house::read;

/// Flash that a program takes: code, constants, and the first values of its variables (bytes).
pub(crate) fn flash_bytes(program: &Path) -> Result<u64> {
    let listing = read(Command::new("size").arg(program))?;
    flash_of(&listing).with_context(|| format!("`size` says what nobody understands:\n{listing}"))
}

/// Of a listing with the columns text, data, bss.
fn flash_of(listing: &str) -> Option<u64> {
    let mut numbers = listing.lines().nth(1)?.split_whitespace();
    let text: u64 = numbers.next()?.parse().ok()?;
    let data: u64 = numbers.next()?.parse().ok()?;
    Some(text + data)
}

/// Functions that compute with doubles in software: the chip's own floating point unit is for `f32` alone.
pub(crate) fn doubles(program: &Path) -> Result<Vec<String>> {
    Ok(doubles_in(&read(Command::new("nm").arg(program))?))
}

fn doubles_in(listing: &str) -> Vec<String> {
    let names = listing.lines().filter_map(|line| line.split_whitespace().next_back());
    names.filter(|name| is_double(name)).map(str::to_owned).collect()
}

/// Arm's names: `__aeabi_dadd`, and conversions from `__aeabi_f2d` to `__aeabi_ul2d`; and the compiler's own, `__adddf3`.
fn is_double(name: &str) -> bool {
    let compilers = name.strip_prefix("__").is_some_and(|rest| {
        rest.contains("df") && rest.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit())
    });
    name.starts_with("__aeabi_d")
        || name.starts_with("__aeabi_cd")
        || (name.starts_with("__aeabi_") && name.ends_with("2d"))
        || compilers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_takes_its_code_and_its_variables_first_values() {
        let listing = "   text\t   data\t    bss\t    dec\t    hex\tfilename\n  13744\t     16\t      8\t  13768\t   35c8\timage\n";
        assert_eq!(flash_of(listing), Some(13_760));
        assert_eq!(flash_of("size: 'image': No such file\n"), None);
    }

    #[test]
    fn whatever_computes_with_doubles_is_seen_and_nothing_else() {
        let listing = "08000a00 T __aeabi_dadd\n08000a00 T __aeabi_f2d\n08000a00 t __muldf3\n08000a00 T __aeabi_d2f\n\
            08000a00 T __aeabi_cdcmple\n08000a00 T __aeabi_memcpy\n08000a00 T __aeabi_uldivmod\n08000a00 T main\n\
            08000a00 T __aeabi_fadd\n08000a00 t _ZN5padfoo\n";
        assert_eq!(
            doubles_in(listing),
            ["__aeabi_dadd", "__aeabi_f2d", "__muldf3", "__aeabi_d2f", "__aeabi_cdcmple"]
        );
    }
}
