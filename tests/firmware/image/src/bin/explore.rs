//! Explorers, on a chip with a heap.
#![no_std]
#![no_main]

use core::{
    alloc::{GlobalAlloc, Layout},
    cell::Cell,
};

use critical_section::{Impl, RawRestoreState};
use embedded_alloc::LlffHeap;
use image::{clock, flight, host, say};
use replay::Heap;

/// What a program has for its heap, of 128 KiB (bytes): the rest is stack, and the rooms that records are read into.
const ROOM: usize = 104 * 1024;

/// A heap that remembers how full it was.
struct Remembering {
    heap: LlffHeap,
    peak: Cell<usize>,
}

// SAFETY: one core, and no interrupt is on.
unsafe impl Sync for Remembering {}

// SAFETY: all it does is hand through.
unsafe impl GlobalAlloc for Remembering {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are those that the heap asks for.
        let place = unsafe { self.heap.alloc(layout) };
        self.peak.set(self.heap.used().max(self.peak.get()));
        place
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { self.heap.dealloc(place, layout) }
    }
}

#[global_allocator]
static HEAP: Remembering = Remembering { heap: LlffHeap::empty(), peak: Cell::new(0) };

/// One core and no interrupts: nobody else is there.
struct Alone;
critical_section::set_impl!(Alone);

// SAFETY: as it says.
unsafe impl Impl for Alone {
    unsafe fn acquire() -> RawRestoreState {}

    unsafe fn release(_: RawRestoreState) {}
}

struct Watched;

impl flight::Watched for Watched {
    fn heap(&self) -> Heap {
        Heap { used: HEAP.heap.used() as u32, peak: HEAP.peak.get() as u32 }
    }

    fn forget_peak(&mut self) {
        HEAP.peak.set(HEAP.heap.used());
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    static mut PLACE: [u8; ROOM] = [0; ROOM];
    clock::start();
    // SAFETY: the heap begins here, once, and nobody else knows this place.
    unsafe { HEAP.heap.init(PLACE.as_mut_ptr() as usize, ROOM) }
    say!("heap room {ROOM}");
    flight::fly::<4096>(Watched);
    host::end(true)
}
