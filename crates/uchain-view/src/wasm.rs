//! The engine's face to a page: five functions, and bytes in the memory that both share. A page writes a request where
//! [`input`] says, calls [`call`], and reads the answer where [`answer`] and [`payload`] say, before it asks again.
//!
//! One page, one thread: nothing here is called while something here runs.
#![expect(unsafe_code, reason = "names that a page finds are declared by unsafe attributes")]

use std::{cell::RefCell, ptr};

use crate::Engine;

struct Shared {
    engine: Engine,
    input: Vec<u8>,
    answer: Vec<u8>,
}

thread_local! {
    static SHARED: RefCell<Shared> =
        RefCell::new(Shared { engine: Engine::default(), input: Vec::new(), answer: Vec::new() });
}

/// Room for a request of so many bytes; null if there is none.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn input(len: usize) -> *mut u8 {
    SHARED.with_borrow_mut(|shared| {
        shared.input.clear();
        if shared.input.try_reserve_exact(len).is_err() {
            return ptr::null_mut();
        }
        shared.input.resize(len, 0);
        shared.input.as_mut_ptr()
    })
}

/// Answers the request that was written; gives the answer's length.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn call() -> usize {
    SHARED.with_borrow_mut(|shared| {
        let input = std::mem::take(&mut shared.input);
        shared.answer = shared.engine.call(&input);
        shared.answer.len()
    })
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn answer() -> *const u8 {
    SHARED.with_borrow(|shared| shared.answer.as_ptr())
}

/// Where what came besides is: numbers over time, or a file.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn payload() -> *const u8 {
    SHARED.with_borrow(|shared| shared.engine.payload().as_ptr())
}

/// How many bytes that is.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn payload_len() -> usize {
    SHARED.with_borrow(|shared| shared.engine.payload().len())
}
