"""Recordings read back: the same as the run, checked, refused where they are damaged."""

import json
import pathlib
import pickle
import subprocess
from typing import Any

import numpy as np
import pytest

import uchain


@pytest.fixture(scope="module", params=["corner", "apartment"])
def both(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[uchain.Run, pathlib.Path]:
    """A run and its recording."""
    path = tmp_path_factory.mktemp("recorded") / "run.mcap"
    what = uchain.Scenario.from_name(request.param).with_(duration_s=30)
    return uchain.run(what, seed=4, record=path), path


def without_clock(summary: uchain.Summary) -> dict[str, Any]:
    return {name: value for name, value in summary.to_dict().items() if name != "wall_s"}


def test_what_is_read_back_is_what_was_flown(both: tuple[uchain.Run, pathlib.Path]):
    run, path = both
    read = uchain.read_recording(path)
    assert isinstance(read, uchain.Run) and read.whole and read.version == uchain.__version__
    assert read.summary.to_dict() == without_clock(run.summary) and "wall_s" not in read.summary
    assert (read.digest, read.seed, read.ok, read.events) == (run.digest, run.seed, run.ok, run.events)
    assert read.ticks == run.frames.rows and read.path == str(path)
    assert list(read.tables) == list(run.tables)
    for name, table in run.tables.items():
        assert list(table) == list(read.tables[name])
        for column, values in table.items():
            np.testing.assert_array_equal(values, read.tables[name][column], err_msg=f"{name}.{column}")
    assert read.plot() == run.plot()
    assert (read.graph is None) == (run.graph is None)
    if run.graph is not None and read.graph is not None:
        np.testing.assert_array_equal(run.graph.edges, read.graph.edges)
    assert read.scenario.name == run.scenario.name
    assert uchain.run(read.scenario, seed=read.seed, frames=None).digest == run.digest


def test_it_is_what_the_command_line_reads(both: tuple[uchain.Run, pathlib.Path], cli: pathlib.Path):
    _, path = both
    told = json.loads(subprocess.run([cli, "inspect", path, "--json"], check=True, capture_output=True).stdout)
    read = uchain.read_recording(path, frames=None)
    assert {name: told[name] for name in read.summary} == read.summary.to_dict()
    assert (told["ticks"], told["whole"]) == (read.ticks, read.whole)


def test_it_is_flown_again_and_the_first_bit_that_differs_is_named(both: tuple[uchain.Run, pathlib.Path]):
    _, path = both
    verified = uchain.read_recording(path, frames=None).verify()
    assert verified and verified.same and verified.difference is None and verified.reasons == []
    assert verified.ticks == verified.of_ticks and verified.whole
    assert repr(pickle.loads(pickle.dumps(verified))) == repr(verified)
    # The same bytes with another seed in them: the entry brings its own checksum, so that is a damaged file.
    other = path.with_name("other.mcap")
    other.write_bytes(path.read_bytes())
    read = uchain.read_recording(other, frames=None)
    run = uchain.run(read.scenario.with_(duration_s=20), seed=5, record=other)
    assert run.digest != read.digest
    assert uchain.read_recording(other, frames=None).verify()
    other.unlink()
    with pytest.raises(uchain.RecordingError, match="other.mcap"):
        read.verify()


def test_a_file_that_was_cut_short_is_read_up_to_there(both: tuple[uchain.Run, pathlib.Path], tmp_path: pathlib.Path):
    run, path = both
    cut = tmp_path / "cut.mcap"
    whole = path.read_bytes()
    cut.write_bytes(whole[: len(whole) * 2 // 3])
    read = uchain.read_recording(cut)
    assert not read.whole and 0 < read.frames.rows < run.frames.rows and read.outcome == "interrupted"
    np.testing.assert_array_equal(read.frames["x_m"], run.frames["x_m"][: read.frames.rows])
    verified = read.verify()
    assert verified and not verified.whole and verified.ticks < verified.of_ticks


@pytest.mark.parametrize("at", [0.1, 0.3, 0.5, 0.7])
def test_a_damaged_file_is_refused_with_the_reason(
    at: float, both: tuple[uchain.Run, pathlib.Path], tmp_path: pathlib.Path
):
    _, path = both
    damaged = tmp_path / "damaged.mcap"
    content = bytearray(path.read_bytes())
    content[int(len(content) * at)] ^= 1
    damaged.write_bytes(content)
    with pytest.raises(uchain.RecordingError, match=r"damaged\.mcap: .*(damaged|checksum|not a recording)"):
        uchain.read_recording(damaged)


def test_what_is_no_recording_is_refused(tmp_path: pathlib.Path):
    for name, content in [("empty", b""), ("text", b"x" * 5000), ("zeros", bytes(5000))]:
        path = tmp_path / name
        path.write_bytes(content)
        with pytest.raises(uchain.RecordingError, match=name):
            uchain.read_recording(path)
    with pytest.raises(uchain.RecordingError, match="absent"):
        uchain.read_recording(tmp_path / "absent.mcap")
    with pytest.raises(uchain.RecordingError):
        uchain.read_recording(tmp_path)


def test_it_is_pickled_as_its_path(both: tuple[uchain.Run, pathlib.Path], monkeypatch: pytest.MonkeyPatch):
    run, path = both
    monkeypatch.chdir(path.parent)
    read = uchain.read_recording(path.name, frames="decisions")
    monkeypatch.chdir("/")
    copy = pickle.loads(pickle.dumps(read))
    assert type(copy) is uchain.Recording and copy.digest == run.digest
    assert copy.frames.rows == read.frames.rows < run.frames.rows
