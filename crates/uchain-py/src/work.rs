//! Long work without the interpreter's lock: other threads of Python go on, and Ctrl-C ends it.

use std::{
    sync::{
        atomic::{AtomicBool, Ordering},
        mpsc::{RecvTimeoutError, sync_channel},
    },
    thread,
    time::Duration,
};

use pyo3::prelude::*;

use crate::errors;

/// How often Python is asked whether somebody pressed Ctrl-C.
const ASK: Duration = Duration::from_millis(50);

/// Does something on a thread of its own, without the interpreter's lock. `stop` is set when somebody presses Ctrl-C; the
/// work is expected to look at it often, and its result is then dropped for the exception. `meanwhile` is called now and
/// then with the lock, on the thread of the caller: for progress.
///
/// # Errors
/// `KeyboardInterrupt`, or what a signal handler or `meanwhile` raises; `UchainError` if the work panics.
pub(crate) fn off_the_lock<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send,
    meanwhile: impl FnMut(Python<'_>) -> PyResult<()> + Send,
) -> PyResult<T> {
    off_the_lock_until(py, work, meanwhile, |_| ())
}

/// Like [`off_the_lock`], of work that may be in Python for long: once an exception is under way, `interrupted` ends that.
///
/// # Errors
/// Those of [`off_the_lock`].
pub(crate) fn off_the_lock_until<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send,
    mut meanwhile: impl FnMut(Python<'_>) -> PyResult<()> + Send,
    interrupted: impl Fn(Python<'_>) + Send + Sync,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    py.detach(|| {
        thread::scope(|scope| {
            let (done, is_done) = sync_channel(1);
            let stop = &stop;
            scope.spawn(move || {
                let result = errors::caught(|| work(stop));
                // Nobody waits any more once an exception is under way.
                let _ = done.send(result);
            });
            loop {
                match is_done.recv_timeout(ASK) {
                    Ok(result) => {
                        Python::attach(|py| py.check_signals().and_then(|()| meanwhile(py)))?;
                        return result;
                    }
                    Err(RecvTimeoutError::Timeout) => {
                        let asked = Python::attach(|py| py.check_signals().and_then(|()| meanwhile(py)));
                        if let Err(raised) = asked {
                            stop.store(true, Ordering::Relaxed);
                            Python::attach(&interrupted);
                            return Err(raised);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(errors::UchainError::new_err("the work ended without a result"));
                    }
                }
            }
        })
    })
}
