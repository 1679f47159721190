use criterion::{BenchmarkId, Criterion, Throughput};
use uchain_sim::{
    config::builtin,
    mission::chain::{Course, Frame, McapRecorder, Scenario},
    record::{RecordError, Recorder},
    run::run,
};

struct All(Vec<Frame>);

impl Recorder<Frame> for All {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.0.push(frame.clone());
        Ok(())
    }
}

/// Five UAVs, all in the air most of the time; into a file as `uchain run` does.
pub(crate) fn all(criterion: &mut Criterion) {
    let source = builtin("corner").expect("a compiled-in scenario");
    let sets = ["chain.uavs=5", "takeoff.s_min_db=50", "duration_s=120"].map(str::to_owned);
    let scenario = Scenario::parse(&source, &sets).expect("a valid scenario");
    let course = Course::lay_out(scenario, &source).expect("a valid course");
    let mut frames = All(Vec::new());
    run(&course, 1, &mut frames).expect("nobody stops it");

    let mut group = criterion.benchmark_group("recording [simulated second]");
    group.throughput(Throughput::Elements(120));
    group.bench_function(BenchmarkId::new("ours", 5), |b| {
        b.iter(|| {
            let file = tempfile::tempfile().expect("a place for files");
            let mut recorder =
                McapRecorder::start(std::io::BufWriter::new(file), &course, 1).expect("room on the disk");
            for frame in &frames.0 {
                recorder.frame(frame).expect("room on the disk");
            }
            recorder.finish().expect("room on the disk")
        });
    });
    group.finish();
}
