//! The host behind the debugger, by Arm's semihosting: its files, its console, the words the program was started with.

use core::{
    arch::asm,
    ffi::{CStr, c_void},
    fmt,
};

const OPEN: usize = 0x01;
const CLOSE: usize = 0x02;
const WRITE: usize = 0x05;
const READ: usize = 0x06;
const COMMAND_LINE: usize = 0x15;
const EXIT: usize = 0x18;

/// Why the program ended: it was done, or it failed.
const DONE: usize = 0x20026;
const FAILED: usize = 0x20023;

/// One request. What comes back is the request's own affair.
fn ask(request: usize, with: *const c_void) -> usize {
    let answer;
    // SAFETY: a breakpoint with this number is the request; the host reads what `with` points at, and writes to buffers
    // that the callers below own and lend mutably.
    unsafe {
        asm!("bkpt 0xab", inlateout("r0") request => answer, in("r1") with, options(nostack, preserves_flags));
    }
    answer
}

fn ask_block<const N: usize>(request: usize, block: &mut [usize; N]) -> usize {
    ask(request, block.as_mut_ptr().cast())
}

/// Ends the program: well, or so that the host notices.
pub fn end(well: bool) -> ! {
    ask(EXIT, (if well { DONE } else { FAILED }) as *const c_void);
    loop {
        core::hint::spin_loop();
    }
}

/// A file, or the console, of the host. Nothing is buffered.
pub struct File {
    handle: usize,
}

/// How a file is opened, as in C's `fopen`.
#[derive(Clone, Copy)]
pub enum Mode {
    /// `"rb"`
    Read = 1,
    /// `"wb"`
    Write = 5,
}

impl File {
    /// `None` if the host cannot open it. The name ends in a NUL of its own.
    pub fn open(name: &CStr, mode: Mode) -> Option<Self> {
        let handle = ask_block(OPEN, &mut [name.as_ptr() as usize, mode as usize, name.to_bytes().len()]);
        (handle != usize::MAX).then_some(Self { handle })
    }

    /// How many bytes were read: fewer than asked for at the end of the file only.
    pub fn read(&mut self, into: &mut [u8]) -> usize {
        let left = ask_block(READ, &mut [self.handle, into.as_mut_ptr() as usize, into.len()]);
        into.len().saturating_sub(left)
    }

    /// Whether all was written.
    pub fn write(&mut self, bytes: &[u8]) -> bool {
        ask_block(WRITE, &mut [self.handle, bytes.as_ptr() as usize, bytes.len()]) == 0
    }
}

impl Drop for File {
    fn drop(&mut self) {
        ask_block(CLOSE, &mut [self.handle]);
    }
}

/// The words the program was started with, its own name first, each with a NUL behind it; none if the host does not tell.
pub fn words(room: &mut [u8]) -> impl Iterator<Item = &CStr> {
    room.fill(0);
    // The last byte stays what it is: the NUL behind the last word.
    let mut block = [room.as_mut_ptr() as usize, room.len().saturating_sub(1)];
    let told = ask_block(COMMAND_LINE, &mut block) == 0;
    let (line, _) = room.split_at_mut(if told { room.len().min(block[1] + 1) } else { 0 });
    for byte in line.iter_mut().filter(|byte| **byte == b' ') {
        *byte = 0;
    }
    line.split_inclusive(|byte| *byte == 0).filter_map(|word| CStr::from_bytes_with_nul(word).ok())
}

/// Longest line that goes out in one request: a request costs far more than a byte.
const LINE_MAX: usize = 160;

/// The host's console.
struct Console {
    file: Option<File>,
    line: [u8; LINE_MAX],
    length: usize,
}

impl Console {
    fn flush(&mut self) {
        if let Some(file) = &mut self.file {
            file.write(&self.line[..self.length]);
        }
        self.length = 0;
    }
}

impl fmt::Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for &byte in text.as_bytes() {
            if self.length == LINE_MAX {
                self.flush();
            }
            self.line[self.length] = byte;
            self.length += 1;
        }
        Ok(())
    }
}

/// Prints a line, or several.
pub fn print(words: fmt::Arguments<'_>) {
    let mut console = Console { file: File::open(c":tt", Mode::Write), line: [0; LINE_MAX], length: 0 };
    let _ = fmt::write(&mut console, words);
    let _ = fmt::Write::write_str(&mut console, "\n");
    console.flush();
}

/// Prints a line on the host's console.
#[macro_export]
macro_rules! say {
    ($($words:tt)*) => { $crate::host::print(format_args!($($words)*)) };
}
