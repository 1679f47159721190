use std::{
    io::{Read as _, Write},
    net::{TcpListener, TcpStream},
    sync::{Arc, mpsc},
    thread,
};

use prost::Message as _;
use uchain_sim::{
    map::{CsvConfig, MapConfig},
    mission::{
        Recorded, Scene,
        chain::{Chain, Course, Frame, McapRecorder},
        explore::{Exploration, Site},
    },
    record::{
        Messages, RecordError, Recorder, Said,
        mcap::{End, McapWriter, MessageRecorder, Recordable},
    },
    replay::Recording,
    run::run,
};

use crate::{course, reset::ring, ring::Ring};

/// A short run.
fn corner() -> Arc<Course> {
    course("corner", &["duration_s=20"])
}

/// The file of a run, and what was said in it.
fn both<M: Recorded<Scene: Scene<Mission = M>>>(scene: &Arc<M::Scene>) -> (Vec<u8>, Messages) {
    let file = MessageRecorder::<McapWriter<Vec<u8>>, M::Topics>::start(Vec::new(), scene, 1).unwrap();
    let list = MessageRecorder::<_, M::Topics>::start_in(Messages::default(), scene, 1).unwrap();
    let mut both = (file, list);
    run(scene, 1, &mut both).unwrap();
    (both.0.finish().unwrap(), both.1.into_sink())
}

/// The file that a list of messages comes to.
fn repeated(messages: &Messages) -> Vec<u8> {
    let mut writer = McapWriter::begin(Vec::new()).unwrap();
    messages.repeat(&mut writer).unwrap();
    writer.finish().unwrap()
}

#[test]
fn messages_kept_in_memory_come_to_the_bytes_of_the_file_whatever_the_mission() {
    let (file, messages) = both::<Chain>(&corner());
    assert!(repeated(&messages) == file);
    let (_, other) = both::<Chain>(&course("corner", &["duration_s=20", "radio.sigma_db=2.5"]));
    assert!(repeated(&other) != file, "the control: another run");

    let source = uchain_sim::config::builtin("apartment").unwrap();
    let (file, messages) = both::<Exploration>(&Site::read(&source, &["duration_s=20".to_owned()]).unwrap());
    assert!(repeated(&messages) == file);
    let (file, messages) = both::<Ring>(&ring());
    assert!(repeated(&messages) == file);
}

#[test]
fn messages_kept_in_memory_are_read_without_a_file_format() {
    struct All(Vec<Frame>);
    impl Recorder<Frame> for All {
        fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
            self.0.push(frame.clone());
            Ok(())
        }
    }

    let (_, messages) = both::<Chain>(&corner());
    let mut flown = All(Vec::new());
    run(&corner(), 1, &mut flown).unwrap();
    let read = |(time_ns, bytes): (u64, &[u8])| {
        let mut frame = Frame::default();
        frame.take(&<Frame as Recordable>::Message::decode(bytes).unwrap()).unwrap();
        assert_eq!(time_ns, frame.tick * 50_000_000);
        frame
    };
    let frames: Vec<Frame> = messages.on("/frame").map(read).collect();
    assert_eq!(frames.len(), 400);
    assert!(frames == flown.0);
    assert_eq!(messages.on("/frames").count(), 0, "the control: no such topic");

    let topics: Vec<&str> = messages.topics().collect();
    assert!(topics.starts_with(&["/frame", "/metrics", "/tf", "/poses"]), "{topics:?}");
    let [Said::Metadata { name, entries }, Said::Attachment { name: file, data, .. }, ..] = messages.said()
    else {
        panic!("a recording begins with what it is of, and the walls")
    };
    assert_eq!((name.as_str(), entries["seed"].as_str(), file.as_str()), ("uchain", "1", "walls.csv"));
    assert!(data.starts_with(b"loop,x_m,y_m\n"));
}

#[test]
fn walls_as_a_recording_holds_them_are_a_map() {
    let (_, messages) = both::<Chain>(&corner());
    let walls = messages.said().iter().find_map(|said| match said {
        Said::Attachment { name, data, .. } if name == "walls.csv" => Some(data),
        _ => None,
    });
    let here = tempfile::tempdir().unwrap();
    std::fs::write(here.path().join("walls.csv"), walls.unwrap()).unwrap();
    let config = MapConfig::Csv(CsvConfig { file: "walls.csv".into() });
    let (again, flown) = (config.lay(here.path(), [0.0; 2]).unwrap().0, &corner().map);
    assert_eq!(again.walls().len(), flown.walls().len());
    for (again_wall, wall) in again.walls().iter().zip(flown.walls()) {
        // The recording's frame is that of the map, which is the file's own here.
        let [x_m, y_m] = again.offset_m().map(|m| m as f32);
        assert!(
            (again_wall.a.x + x_m - wall.a.x).abs() < 1e-4 && (again_wall.a.y + y_m - wall.a.y).abs() < 1e-4
        );
    }
}

/// A peer that is connected to.
fn peer<T: Send + 'static>(
    serve: impl FnOnce(TcpStream) -> T + Send + 'static,
) -> (TcpStream, thread::JoinHandle<T>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let stream = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
    (stream, thread::spawn(move || serve(listener.accept().unwrap().0)))
}

/// Shows a peer that reads along how far the run has come.
struct Ticks(mpsc::Sender<u64>);

impl Recorder<Frame> for Ticks {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        // Whoever has gone away has seen enough.
        let _ = self.0.send(frame.tick);
        Ok(())
    }
}

#[test]
fn a_socket_gets_the_very_bytes_of_the_file() {
    let (file, _) = both::<Chain>(&corner());
    let (stream, listener) = peer(|mut stream| {
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        bytes
    });
    let mut recorder = McapRecorder::start(stream, &corner(), 1).unwrap();
    run(&corner(), 1, &mut recorder).unwrap();
    drop(recorder.finish().unwrap());
    assert!(listener.join().unwrap() == file);
}

#[test]
fn a_peer_reads_a_run_while_it_is_flown() {
    let long = || course("corner", &["duration_s=120"]);
    let (stream, listener) = peer(|stream| {
        let mut recording = Recording::<_, Course>::read(stream, "peer").unwrap();
        let scene = recording.scene().unwrap();
        let (shown, ticks) = mpsc::channel();
        let summary = recording.summary(&scene, &mut Ticks(shown)).unwrap();
        (summary, ticks.iter().count(), recording.frames.end())
    });
    // The peer can only have come to its first frames after it was sent them; it waits for the rest.
    let mut recorder = McapRecorder::start(stream, &long(), 1).unwrap();
    let summary = run(&long(), 1, &mut recorder).unwrap();
    drop(recorder.finish().unwrap());
    assert_eq!(listener.join().unwrap(), (summary, 2400, Some(End::Whole)));
}

#[test]
fn a_peer_that_goes_away_ends_the_run_in_words() {
    let (has_begun, begun) = std::sync::mpsc::channel();
    let (stream, listener) = peer(move |mut stream| {
        let mut begin = [0; 8];
        stream.read_exact(&mut begin).unwrap();
        begun.recv().unwrap();
        begin
    });
    let mut recorder = McapRecorder::start(stream, &course("corner", &[]), 1).unwrap();
    // Before the first tick it is there still.
    has_begun.send(()).unwrap();
    assert_eq!(&listener.join().unwrap(), b"\x89MCAP0\r\n", "it was there");
    let error = run(&course("corner", &[]), 1, &mut recorder).unwrap_err();
    assert!(matches!(error, RecordError::Io(_)), "{error:?}");
    let words = error.to_string();
    assert!(words.starts_with("cannot write the recording: ") && words.contains("(os error "), "{words}");
    // What was held back is of no use to anybody: it is let go of without a panic.
    drop(recorder);
}

/// Takes so many bytes, and no more.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match self.0.min(bytes.len()) {
            0 if !bytes.is_empty() => Err(std::io::Error::other("the disk is full")),
            taken => {
                self.0 -= taken;
                Ok(taken)
            }
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_sink_that_takes_no_more_ends_the_run_wherever_that_is() {
    let (file, _) = both::<Chain>(&corner());
    let record = |room: usize| -> Result<(), RecordError> {
        let mut recorder = McapRecorder::start(Full(room), &corner(), 1)?;
        run(&corner(), 1, &mut recorder)?;
        recorder.finish().map(drop)
    };
    for room in [0, 7, 100, file.len() / 2, file.len() - 1] {
        let error = record(room).unwrap_err().to_string();
        assert_eq!(error, "cannot write the recording: the disk is full", "{room} bytes");
    }
    record(file.len()).expect("the control: room for all of it");
}
