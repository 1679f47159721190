//! Exploration as a drone would link it: on a heap, and nothing else.

extern crate alloc;

use alloc::vec::Vec;
use core::{
    alloc::{GlobalAlloc, Layout},
    cell::UnsafeCell,
    hint::black_box,
    ptr::null_mut,
    sync::atomic::{AtomicUsize, Ordering},
};

use uchain_core::explore::{ExploreParams, Explorer, Observation, Pose, Ssg, rule};

/// A heap that only grows.
struct Bump {
    room: UnsafeCell<[u8; 65536]>,
    used: AtomicUsize,
}

// SAFETY: every byte of the room is handed out once.
unsafe impl Sync for Bump {}

// SAFETY: what is handed out lies in the room, is aligned, and overlaps with nothing handed out before.
unsafe impl GlobalAlloc for Bump {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let start = self.room.get() as usize;
        let mut used = self.used.load(Ordering::Relaxed);
        loop {
            let at = (start + used).next_multiple_of(layout.align());
            let end = at - start + layout.size();
            if end > 65536 {
                return null_mut();
            }
            match self.used.compare_exchange(used, end, Ordering::Relaxed, Ordering::Relaxed) {
                Ok(_) => return at as *mut u8,
                Err(other) => used = other,
            }
        }
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static HEAP: Bump = Bump { room: UnsafeCell::new([0; 65536]), used: AtomicUsize::new(0) };

/// A robot that flies where it is told and scans walls at one distance; how far it got.
#[unsafe(no_mangle)]
pub extern "C" fn explore(rounds: u32, wall_m: f32) -> f32 {
    let params = black_box(ExploreParams::default());
    let Ok(mut ssg) = Ssg::new(params.clone(), 2) else { return -1.0 };
    let (mut robot, mut said, mut pose) = (Explorer::new(0, 2), Vec::new(), Pose::default());
    let mut bits = rounds;
    let mut draw = || {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        bits
    };
    let mut flown_m = 0.0;
    for _ in 0..rounds {
        let scan: [Option<f32>; 18] = core::array::from_fn(|k| (k % 3 == 0).then_some(wall_m));
        let seen = Observation { pose, arrived: true, scan: Some(&scan) };
        if robot.perceive(&mut ssg, &seen, &mut said).is_err() {
            return -1.0;
        }
        let target = robot.announce(&mut ssg, &mut draw, &mut said);
        for message in said.drain(..) {
            robot.hear(&message);
        }
        let told = match rule(&[target], &params).first() {
            Some(&ruling) => robot.follow_ruling(ruling, &params),
            None => robot.resolve(&params),
        };
        flown_m += pose.at.distance_m(told.to);
        pose = Pose { at: told.to, heading_rad: told.heading_rad };
    }
    flown_m
}
