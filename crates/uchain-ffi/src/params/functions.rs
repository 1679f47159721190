//! What C calls to get Params, and to look whether they are right.

use core::{ffi::c_char, ptr};

use uchain_core::chain::NodeParams;

use super::Params;
use crate::{Status, pointer};

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_params_default(params: *mut Params) -> Status {
    // SAFETY: as C was asked.
    unsafe { fill(params, &NodeParams::default()) }
}

/// Writes the values of the authors' simulator, with which the figures of Laclau 2021 were computed: preset
/// "frontiers2021" of the simulator.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_params_frontiers2021(params: *mut Params) -> Status {
    // SAFETY: as C was asked.
    unsafe { fill(params, &NodeParams::frontiers2021()) }
}

/// Writes the values of the authors' flight firmware, which flew in the experiment of Laclau 2021: preset "cavemod" of the
/// simulator. It decides ten times a second.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_params_cavemod(params: *mut Params) -> Status {
    // SAFETY: as C was asked.
    unsafe { fill(params, &NodeParams::cavemod()) }
}

/// # Safety
/// The pointer is NULL, or points to room for `uchain_params`.
unsafe fn fill(params: *mut Params, with: &NodeParams) -> Status {
    if params.is_null() || !params.is_aligned() {
        return Status::BadPointer;
    }
    // SAFETY: there is room, and what was there before is not read.
    unsafe { params.write(Params::of(with)) };
    Status::Ok
}

/// Looks whether params are legal. If not, `key` (if it is not NULL) is set to the name of the first key that is wrong, as in
/// a scenario file, `equalize.k_db_per_m` say: text that is there for ever, ended by a 0. Else it is set to NULL.
///
/// Every key by itself: that thresholds are in order (`takeoff_s_min_db` below `link_head_stop_db` below `link_head_back_db`, and
/// below `link_relay_back_db`) is not looked at. If they are not, the head stops before the next relay takes off.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_params_check(params: *const Params, key: *mut *const c_char) -> Status {
    let mut name = ptr::null();
    // SAFETY: as C was asked.
    let status = match unsafe { pointer::read(params) } {
        Err(status) => status,
        Ok(params) => match params.read() {
            Ok(_) => Status::Ok,
            Err(refused) => {
                name = refused.key.as_ptr();
                refused.status
            }
        },
    };
    // SAFETY: as C was asked.
    if let Ok(key) = unsafe { pointer::write(key) } {
        *key = name;
    }
    status
}
