//! Pointers from C, looked at before they are followed.

use crate::Status;

/// What a pointer of C points to, for reading.
///
/// # Safety
/// If the pointer is neither NULL nor misaligned, a `T` lies there for as long as `'a`, and nobody writes to it meanwhile.
pub(crate) unsafe fn read<'a, T>(pointer: *const T) -> Result<&'a T, Status> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(Status::BadPointer);
    }
    // SAFETY: not NULL and aligned, as was just looked at; the rest is promised by the caller.
    Ok(unsafe { &*pointer })
}

/// What a pointer of C points to, for writing.
///
/// # Safety
/// If the pointer is neither NULL nor misaligned, a `T` lies there for as long as `'a`, and nobody else reads or writes it
/// meanwhile.
pub(crate) unsafe fn write<'a, T>(pointer: *mut T) -> Result<&'a mut T, Status> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(Status::BadPointer);
    }
    // SAFETY: not NULL and aligned, as was just looked at; the rest is promised by the caller.
    Ok(unsafe { &mut *pointer })
}
