//! Flies a trace of the host's again, and writes what came of it: `image TRACE RESULT [equalize | reading]`.

use core::ffi::CStr;

use replay::{Call, Heap, Input, Meter, Output, Plant, Short, Tally, replay};

use crate::{
    clock, host,
    host::{File, Mode},
    say,
    stack::depth_of,
};

/// Bytes that are asked for at once.
const BUFFER: usize = 2048;

/// A file that is read.
struct Reader {
    file: File,
    buffer: [u8; BUFFER],
    /// What of the buffer is still to be read.
    from: usize,
    to: usize,
}

impl Input for Reader {
    fn read(&mut self, mut into: &mut [u8]) -> Result<(), Short> {
        while !into.is_empty() {
            if self.from == self.to {
                (self.from, self.to) = (0, self.file.read(&mut self.buffer));
            }
            let there = &self.buffer[self.from..self.to];
            let bytes = there.len().min(into.len());
            if bytes == 0 {
                return Err(Short);
            }
            let (now, later) = into.split_at_mut(bytes);
            now.copy_from_slice(&there[..bytes]);
            self.from += bytes;
            into = later;
        }
        Ok(())
    }
}

/// A file that is written.
struct Writer {
    file: File,
    buffer: [u8; BUFFER],
    length: usize,
    /// Whether the host took everything.
    well: bool,
}

impl Writer {
    fn flush(&mut self) -> bool {
        self.well &= self.file.write(&self.buffer[..self.length]);
        self.length = 0;
        self.well
    }
}

impl Output for Writer {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            if self.length == BUFFER {
                self.flush();
            }
            self.buffer[self.length] = byte;
            self.length += 1;
        }
    }
}

/// Looks at the clock, at the stack below a call of up to `BYTES`, and at a heap.
pub struct Watch<const BYTES: usize, H> {
    heap: H,
    /// Deepest stack by kind of call (bytes).
    depth: [usize; Call::ALL.len()],
}

/// A heap that can be looked at.
pub trait Watched {
    /// What is taken of it.
    fn heap(&self) -> Heap;
    /// Its peak is counted anew.
    fn forget_peak(&mut self);
}

/// No heap.
pub struct None;

impl Watched for None {
    fn heap(&self) -> Heap {
        Heap::default()
    }

    fn forget_peak(&mut self) {}
}

impl<const BYTES: usize, H: Watched> Meter for Watch<BYTES, H> {
    fn now(&mut self) -> u32 {
        clock::now()
    }

    fn call<T>(&mut self, call: Call, make: impl FnOnce() -> T) -> (T, u32) {
        let (made, depth) = depth_of::<BYTES, _>(|| clock::cost_of(make));
        if let Some(most) = self.depth.get_mut(call as usize) {
            *most = depth.max(*most);
        }
        made
    }

    fn heap(&mut self) -> Heap {
        self.heap.heap()
    }

    fn forget_peak(&mut self) {
        self.heap.forget_peak();
    }
}

/// Does what the program's words say, and prints what it cost. It ends the program if that cannot be done.
pub fn fly<const BYTES: usize>(heap: impl Watched) {
    let mut room = [0; 1024];
    let mut words = host::words(&mut room).skip(1);
    let (Some(trace), Some(result)) = (words.next(), words.next()) else {
        say!("expected: image TRACE RESULT [equalize | reading]");
        host::end(false)
    };
    let plant = match words.next().map(CStr::to_bytes) {
        Option::None | Some(b"") => Plant::None,
        Some(b"equalize") => Plant::Equalize,
        Some(b"reading") => Plant::Reading,
        Some(_) => {
            say!("a fault is planted in: equalize, reading");
            host::end(false)
        }
    };
    let (Some(input), Some(output)) = (File::open(trace, Mode::Read), File::open(result, Mode::Write)) else {
        say!("the host cannot open {trace:?} or {result:?}");
        host::end(false)
    };
    let mut input = Reader { file: input, buffer: [0; BUFFER], from: 0, to: 0 };
    let mut output = Writer { file: output, buffer: [0; BUFFER], length: 0, well: true };
    let mut watch = Watch::<BYTES, _> { heap, depth: [0; Call::ALL.len()] };
    match replay(&mut input, &mut output, &mut watch, plant) {
        Ok(tally) if output.flush() => tell(&tally, &watch.depth),
        Ok(_) => {
            say!("the host did not take all of {result:?}");
            host::end(false)
        }
        Err(fault) => {
            say!("{trace:?}: {fault}");
            host::end(false)
        }
    }
}

fn tell(tally: &Tally, depth: &[usize]) {
    say!("{tally}");
    for (call, depth) in Call::ALL.iter().zip(depth).filter(|(_, depth)| **depth > 0) {
        say!("stack {} {depth}", call.word());
    }
}
