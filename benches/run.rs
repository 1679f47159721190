use criterion::Criterion;
use uchain_sim::{
    config::{Course, Scenario, builtin},
    run::run,
};

pub(crate) fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("run");
    group.sample_size(10);
    for name in ["straight", "corner", "bend"] {
        let source = builtin(name).expect("a compiled-in scenario");
        let scenario = Scenario::parse(&source, &[]).expect("a valid scenario");
        let course = Course::lay(scenario, &source).expect("a valid course");
        group.bench_function(name, |b| b.iter(|| run(&course, 1, &mut ()).expect("nobody stops it")));
    }
    group.finish();
}
