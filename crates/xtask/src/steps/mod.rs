//! The steps of the gate, cheap ones first.

mod cargo;
mod digest;
mod examples;
mod features;
mod ffi;
mod firmware;
mod fuzz;
mod libm;
mod locks;
mod no_panic;
mod no_std;
pub(crate) mod python;
mod rooms;

use anyhow::Result;

use crate::house::{House, Proof};

/// One check.
pub(crate) struct Step {
    /// What it is called on the command line.
    pub(crate) name: &'static str,
    /// What it checks, in half a line.
    pub(crate) about: &'static str,
    /// The check itself.
    pub(crate) run: fn(&House) -> Result<Outcome>,
}

/// How a check ended that did not fail.
pub(crate) enum Outcome {
    /// What it claims holds.
    Passed,
    /// It could not be made here; why.
    Skipped(String),
}

/// Links `uchain-core` and nothing else.
const NO_STD: Proof = Proof("no_std");
/// Links the laws that fly, if none of them can panic.
const NO_PANIC: Proof = Proof("no_panic");
/// Links the simulation without its heavy rooms.
const LIBM_ONLY: Proof = Proof("libm_only");

/// All steps, in order.
pub(crate) const STEPS: &[Step] = &[
    Step { name: "fmt", about: "rustfmt changes nothing", run: cargo::fmt },
    Step { name: "locks", about: "the proofs link what the project links", run: locks::agree },
    Step { name: "rooms", about: "no room imports one that imports it", run: rooms::have_no_circle },
    Step {
        name: "features",
        about: "no released program holds the slow ways that tests compare with",
        run: features::leave_oracles_out,
    },
    Step { name: "clippy", about: "no warning anywhere", run: cargo::clippy },
    Step {
        name: "lean",
        about: "core and simulation without their optional parts, no warning",
        run: cargo::lean,
    },
    Step { name: "doc", about: "the documentation builds without a warning", run: cargo::doc },
    Step { name: "test", about: "unit and integration tests", run: cargo::test },
    Step { name: "doctest", about: "examples in the documentation", run: cargo::doctest },
    Step {
        name: "examples",
        about: "every program in examples/ runs and prints what it says",
        run: examples::print_what_they_say,
    },
    Step {
        name: "python",
        about: "Python's mcap and pyarrow find in recordings and sweeps what uchain finds",
        run: python::are_read,
    },
    Step {
        name: "wheel",
        about: "Python's module: installed, typed as it says, its tests, README's ten lines in a bare Python",
        run: python::is_what_it_says,
    },
    Step {
        name: "web",
        about: "the page, in a browser: opened from disk, flown, its digests those of the command line",
        run: python::flies_in_a_browser,
    },
    Step {
        name: "no-std",
        about: "uchain-core links without std, system mathematics or, exploration apart, a heap",
        run: no_std::links,
    },
    Step {
        name: "no-panic",
        about: "no law that flies can panic, whatever it is given",
        run: no_panic::links,
    },
    Step { name: "fuzz", about: "what fuzzing has found, without a fuzzer", run: fuzz::replay },
    Step {
        name: "ffi",
        about: "C gets the same bits on this machine and on the emulated chip, and the Crazyflie app flies",
        run: ffi::answers_as_rust_does,
    },
    Step {
        name: "libm",
        about: "programs import no mathematics from the system if they ask so, and keep theirs if not",
        run: libm::imports_nothing,
    },
    Step {
        name: "stranger",
        about: "a package elsewhere, with path dependencies only, builds and runs the examples of every seam",
        run: examples::build_elsewhere,
    },
    Step {
        name: "firmware",
        about: "what flies on the drone, on the emulated chip of a drone: the same bits, within its budgets",
        run: firmware::flies_on_the_chip,
    },
    Step {
        name: "digest",
        about: "one seed, one digest: debug, release, tests, a CPU without FMA",
        run: digest::agrees,
    },
];
