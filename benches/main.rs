//! Benchmarks, a file a room: `cargo bench`, or `cargo bench -- laws` for some of them.

mod laws;
mod run;
mod w1;

fn main() {
    let mut criterion = criterion::Criterion::default().configure_from_args();
    laws::all(&mut criterion);
    w1::all(&mut criterion);
    run::all(&mut criterion);
    criterion.final_summary();
}
