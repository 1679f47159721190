//! The `uchain` command; see [`uchain_cli::main_with`].

fn main() -> std::process::ExitCode {
    uchain_cli::main_with(std::env::args_os())
}
