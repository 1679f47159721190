//! The `uchain` command; see [`uchain_cli::main_with`].

// One mathematics for the whole program: its runs have the same bits on every system.
use uchain_libm as _;

fn main() -> std::process::ExitCode {
    uchain_cli::main_with(std::env::args_os())
}
