use uchain_sim::{
    mission::chain::{Frame, History},
    record::{RecordError, Recorder},
    run::run,
};

use crate::course;

#[test]
fn the_same_seed_gives_the_same_summary_whoever_watches_and_on_whatever_thread() {
    let course = course("corner", &["duration_s=60"]);
    let alone = run(&course, 5, &mut ()).unwrap();
    let watched = run(&course, 5, &mut History::default()).unwrap();
    assert_eq!(alone, watched);
    std::thread::scope(|scope| {
        let runs = [(); 3].map(|()| scope.spawn(|| run(&course, 5, &mut ()).unwrap()));
        for other in runs {
            assert_eq!(other.join().unwrap(), alone);
        }
    });
}

#[test]
fn another_seed_or_one_parameter_a_hair_off_gives_another_digest() {
    let digest = |sets: &[&str], seed| run(&course("corner", sets), seed, &mut ()).unwrap().digest;
    let reference = digest(&["duration_s=30"], 5);
    assert_eq!(reference, digest(&["duration_s=30"], 5));
    assert_ne!(reference, digest(&["duration_s=30"], 6));
    assert_ne!(reference, digest(&["duration_s=30", "radio.sigma_db=3.0000002"], 5));
}

/// Stops the run at its hundredth frame.
struct Stop(u32);

impl Recorder<Frame> for Stop {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.0 += 1;
        if self.0 == 100 { Err(RecordError::Interrupted { time_s: frame.time_s() }) } else { Ok(()) }
    }
}

#[test]
fn a_recorder_can_end_a_run_and_the_error_says_when() {
    let error = run(&course("corner", &[]), 1, &mut Stop(0)).unwrap_err();
    assert_eq!(error.to_string(), "interrupted at 5.0 s of simulated time");
}
