//! Benchmarks, a file a room: `cargo bench`, or `cargo bench -- laws` for some of them.

mod laws;
mod record;
mod run;

fn main() {
    let mut criterion = criterion::Criterion::default().configure_from_args();
    laws::all(&mut criterion);
    record::all(&mut criterion);
    run::all(&mut criterion);
    criterion.final_summary();
}
