"""One run: the same as the command line's, looked into, kept, refused, stopped."""

import json
import multiprocessing
import pathlib
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
import tomllib
from typing import Any

import numpy as np
import pytest
from conftest import optional

import uchain


def scenario(name: str, **values: Any) -> uchain.Scenario:
    return uchain.Scenario.from_name(name).with_(**values)


@pytest.fixture(scope="module")
def corner() -> uchain.Run:
    return uchain.run("corner", seed=1)


@pytest.fixture(scope="module")
def apartment() -> uchain.Run:
    return uchain.run("apartment", seed=1)


def without_clock(summary: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in summary.items() if name != "wall_s"}


@pytest.mark.parametrize("name", ["corner", "apartment"])
def test_a_run_from_python_comes_to_the_summary_of_the_command_line(name: str, summary_of):
    run = uchain.run(name, seed=3)
    told = summary_of(name, 3)
    assert without_clock(run.summary.to_dict()) == without_clock(told)
    assert list(run.summary) == list(told)
    assert run.digest == told["digest"] and run.outcome == told["outcome"] and run.verdict == told["verdict"]
    assert without_clock(run.summary.to_dict()) != without_clock(summary_of(name, 4)), "the control: another seed"


@pytest.mark.parametrize("name", ["corner", "apartment"])
def test_a_recording_from_python_has_the_bytes_of_the_command_line(
    name: str, cli: pathlib.Path, tmp_path: pathlib.Path
):
    path = tmp_path / "mine.mcap"
    what = scenario(name, duration_s=30)
    run = uchain.run(what, seed=2, record=path)
    command = [cli, "run", name, "--set", "duration_s=30", "--seed", "2", "--quiet", "--out", tmp_path / "out"]
    subprocess.run(command, check=True)
    assert path.read_bytes() == (tmp_path / "out" / "run.mcap").read_bytes()
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["mine.mcap", "out"]
    assert bytes(run.plot()) == (tmp_path / "out" / "run.png").read_bytes()


def test_where_no_recording_can_be_written_nothing_is_left(tmp_path: pathlib.Path):
    what = scenario("straight", duration_s=2)
    with pytest.raises(uchain.RecordingError, match="absent.*cannot write the recording"):
        uchain.run(what, record=tmp_path / "absent" / "run.mcap")
    with pytest.raises(uchain.RecordingError, match="it is a folder"):
        uchain.run(what, record=tmp_path)
    old = tmp_path / "run.mcap"
    old.write_text("an older one")
    with pytest.raises(uchain.UchainError, match="GiB"):
        uchain.run(scenario("staircase", duration_s=86400, **{"chain.uavs": 30}), record=old)
    assert old.read_text() == "an older one"
    assert list(tmp_path.iterdir()) == [old]


def test_frames_are_arrays_with_units_in_their_names(corner: uchain.Run):
    frames, ticks, uavs = corner.frames, 2400, 4
    assert frames.rows == ticks and len(frames) == len(list(frames)) == 20
    assert frames["time_s"].dtype == np.float64
    np.testing.assert_allclose(frames["time_s"], np.arange(1, ticks + 1) / 20)
    for name, dtype in [("x_m", np.float32), ("airborne", np.bool_), ("wall_contacts", np.uint32)]:
        assert frames[name].shape == (ticks, uavs) and frames[name].dtype == dtype
    # It moved as fast as it says.
    way_m = np.hypot(np.diff(frames["x_m"][:, 0]), np.diff(frames["y_m"][:, 0]))
    speed_mps = np.hypot(frames["forward_mps"][1:, 0], frames["lateral_mps"][1:, 0])
    np.testing.assert_allclose(way_m * 20, speed_mps, atol=2e-3)
    # Sensors on the ground read nothing, in the air they do.
    assert np.isnan(frames["tof_nw_m"][~frames["airborne"]]).all()
    assert not np.isnan(frames["tof_nw_m"][100:, 0]).all()
    assert np.count_nonzero(frames["airborne"][-1]) == corner.summary.uavs
    assert "airborne" in frames and "z_m" not in frames and frames.get("z_m") is None
    with pytest.raises(KeyError, match="there are time_s"):
        frames["z_m"]


def test_links_stand_at_the_uav_at_their_front_end(corner: uchain.Run):
    links = corner.links
    assert links.rows == np.count_nonzero(corner.frames["decision"])
    in_chain = ~np.isnan(links["true_db"])
    assert in_chain.sum(axis=1)[-1] == len(corner.summary.links)
    assert [link.uav for link in corner.summary.links] == list(np.flatnonzero(in_chain[-1]))
    assert np.nanmax(links["true_db"]) == np.float32(corner.summary.worst_link_db)
    np.testing.assert_array_equal(np.nanmax(links["true_db"][1:], axis=1), links["worst_link_db"][1:])
    last = links["time_s"] > 110
    for link in corner.summary.links:
        median = np.median(links["true_db"][last][:, link.uav])
        assert median == pytest.approx(link.true_db, abs=0.05)
    assert not np.array_equal(links["raw_db"], links["filtered_db"], equal_nan=True)


def test_events_are_those_that_the_recording_says(corner: uchain.Run):
    launches = [event for event in corner.events if event.kind == "took-off"]
    assert [event.robot for event in launches] == [0, 1, 2]
    assert [event.time_s - 0.05 for event in launches] == pytest.approx(corner.summary.launches_s)
    event = launches[0]
    assert pickle.loads(pickle.dumps(event)) == event and hash(event) == hash(launches[0])
    with pytest.raises(AttributeError):
        event.kind = "other"  # type: ignore[misc]
    touched = uchain.run("corner", seed=1).events
    assert touched == corner.events


def test_events_say_what_overrode_the_head_and_when_a_launch_was_armed(corner: uchain.Run):
    overrides = [event for event in corner.events if event.kind.startswith("override-")]
    assert [(event.kind, event.robot) for event in overrides] == [("override-begins", 0), ("override-ends", 0)]
    assert all("(head-stop)" in event.text for event in overrides)
    assert "link.head_stop_db = 70" in overrides[0].text
    armed = [event.robot for event in corner.events if event.kind == "launch-armed"]
    assert armed == [1, 2], "the head is never asked"
    free = uchain.Scenario.from_name("corner").with_(**{"link.head_stop_db": 150, "link.head_back_db": 151})
    kinds = {event.kind for event in uchain.run(free, seed=1).events}
    assert "took-off" in kinds and "override-begins" not in kinds


def test_an_exploration_has_rounds_and_a_graph(apartment: uchain.Run):
    rounds, graph = apartment.rounds, apartment.graph
    assert graph is not None
    assert rounds["coverage"][-1] == pytest.approx(apartment.summary.coverage)
    assert (np.diff(rounds["coverage"]) >= 0).all() and rounds["coverage"][0] > 0
    assert rounds["nodes"][-1] == graph.nodes.rows == sum(apartment.summary.nodes)
    assert graph.edges.shape == (apartment.summary.edges, 2) and graph.edges.dtype == np.uint32
    x_m, y_m = graph.nodes["x_m"], graph.nodes["y_m"]
    ends = graph.edges.astype(int)
    lengths_m = np.hypot(*(place[ends[:, 0]] - place[ends[:, 1]] for place in (x_m, y_m)))
    np.testing.assert_allclose(graph.lengths_m, lengths_m, rtol=1e-5)
    assert np.count_nonzero(graph.nodes["frontiers"]) == apartment.summary.hubs_left
    purposes = apartment.frames.words["purpose"]
    assert purposes == ("explore", "backtrack", "home", "park", "wait")
    assert apartment.frames["purpose"].max() < len(purposes)
    assert apartment.events[-1].kind == "over" and apartment.events[-1].robot is None
    # Two ways to add up how far they flew; near a corner frames are apart from where robots stood.
    steps_m = np.hypot(*(np.diff(apartment.frames[axis], axis=0) for axis in ("x_m", "y_m"))).sum(axis=0)
    np.testing.assert_allclose(steps_m, apartment.summary.distance_m, rtol=0.02)
    with pytest.raises(AttributeError, match="has no links: it has frames, rounds"):
        apartment.links


def test_places_are_in_the_maps_frame_whose_origin_is_known(apartment: uchain.Run):
    spawns_m = np.array(tomllib.loads(apartment.scenario.toml)["explore"]["spawns_m"])[:3]
    at_m = np.stack([apartment.frames["x_m"][0], apartment.frames["y_m"][0]], axis=1)
    offset_m = np.array(apartment.scenario.map_offset_m)
    assert np.abs(offset_m).max() > 1, "the control"
    np.testing.assert_allclose(at_m + offset_m, spawns_m, atol=0.1)


def test_the_graph_is_one_of_networkx(apartment: uchain.Run):
    networkx = optional("networkx")
    assert apartment.graph is not None
    graph = apartment.graph.to_networkx()
    assert (graph.number_of_nodes(), graph.number_of_edges()) == (apartment.graph.nodes.rows, apartment.summary.edges)
    assert networkx.is_connected(graph)
    assert set(graph.nodes[0]) == set(apartment.graph.nodes)


def test_without_networkx_it_is_said_how_to_get_it(apartment: uchain.Run, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "networkx", None)
    assert apartment.graph is not None
    with pytest.raises(ImportError, match="pip install networkx"):
        apartment.graph.to_networkx()


def test_frames_that_nobody_wants_are_not_kept(corner: uchain.Run):
    none = uchain.run("corner", seed=1, frames=None)
    assert none.tables == {} and none.digest == corner.digest and none.events == corner.events
    with pytest.raises(AttributeError, match="not kept"):
        none.frames
    few = uchain.run("corner", seed=1, frames="decisions")
    chosen = corner.frames["decision"]
    assert few.frames.rows == np.count_nonzero(chosen) < corner.frames.rows
    np.testing.assert_array_equal(few.frames["x_m"], corner.frames["x_m"][chosen])
    assert corner.frames.rows == 2400, "the control"


def test_frames_that_would_not_fit_are_refused_before_the_flight():
    # 1,728,000 ticks of 30 UAVs.
    what = scenario("staircase", duration_s=86400, **{"chain.uavs": 30})
    begun = time.monotonic()
    with pytest.raises(uchain.UchainError, match=r'2\.\d GiB .*frames="decisions".*frames=None'):
        uchain.run(what)
    assert time.monotonic() - begun < 5


def test_a_summary_is_a_mapping_and_has_attributes(corner: uchain.Run):
    summary = corner.summary
    assert summary["sim_s"] == summary.sim_s == 120 and "sim_s" in summary and len(summary) == len(list(summary))
    assert summary.links[0].true_db == summary["links"][0]["true_db"]
    assert "links" in dir(summary) and dict(summary) == {name: summary[name] for name in summary.keys()}
    assert json.loads(json.dumps(summary.to_dict())) == summary.to_dict()
    with pytest.raises(AttributeError, match="no 'sim' in this summary"):
        summary.sim
    with pytest.raises(KeyError):
        summary["sim"]
    copy = pickle.loads(pickle.dumps(summary))
    assert copy == summary and type(copy.links[0]) is uchain.Summary and summary != {}


def test_data_frames_take_frames_as_they_are(corner: uchain.Run, apartment: uchain.Run):
    polars = optional("polars")
    table = polars.DataFrame(corner.frames.tidy())
    assert table.shape == (2400 * 4, 21) and table.columns[:2] == ["time_s", "robot"]
    third = table.filter(polars.col("robot") == 2)
    np.testing.assert_array_equal(third["x_m"].to_numpy(), corner.frames["x_m"][:, 2])
    np.testing.assert_array_equal(third["time_s"].to_numpy(), corner.frames["time_s"])
    purposes = polars.DataFrame(apartment.frames.tidy())["purpose"].unique()
    assert set(purposes) <= set(apartment.frames.words["purpose"])
    assert polars.DataFrame(apartment.rounds.tidy()).shape == (apartment.rounds.rows, len(apartment.rounds))
    links = corner.links.tidy()
    assert len(links) == corner.links.rows * 4 and len(pickle.loads(pickle.dumps(links))) == len(links)
    assert optional("pyarrow").table(links).num_rows == len(links)
    assert optional("pandas").DataFrame.from_arrow(links).shape == (len(links), len(corner.links) + 1)
    frames = corner.frames.tidy()  # noqa: F841, the query reads it by its name
    counted = optional("duckdb").sql("SELECT count(*) FROM frames WHERE robot = 1 AND airborne").fetchall()
    assert counted == [(np.count_nonzero(corner.frames["airborne"][:, 1]),)]


def test_a_picture_shows_itself_and_is_saved(corner: uchain.Run, tmp_path: pathlib.Path):
    path = tmp_path / "corner.png"
    picture = corner.plot(path)
    assert path.read_bytes() == bytes(picture) == picture._repr_png_()
    assert picture.size_px[0] > 500 and bytes(picture).startswith(b"\x89PNG")
    assert pickle.loads(pickle.dumps(picture)) == picture
    with pytest.raises(OSError, match="cannot write the picture"):
        picture.save(tmp_path / "absent" / "x.png")
    with pytest.raises(ValueError, match="PNG"):
        uchain.Picture(b"GIF89a")
    html = corner._repr_html_()
    assert "data:image/png;base64," in html and "completed" in html and "<td>sim_s</td><td>120.0</td>" in html


def digest_of(run: uchain.Run) -> tuple[str, float, bytes]:
    return run.digest, float(run.frames["x_m"].sum()), bytes(run.plot())


@pytest.mark.parametrize("name", ["corner", "apartment"])
def test_a_run_arrives_in_a_spawned_process_as_it_was(name: str):
    run = uchain.run(scenario(name, duration_s=10), seed=5)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply(digest_of, (run,)) == digest_of(run)
    copy = pickle.loads(pickle.dumps(run))
    assert copy.summary == run.summary and copy.scenario == run.scenario and copy.events == run.events
    assert copy.ok == run.ok and list(copy.tables) == list(run.tables)
    assert (copy.graph is None) == (run.graph is None)


def test_threads_fly_side_by_side_and_come_to_the_same():
    what = scenario("corner", duration_s=20)
    alone = uchain.run(what, seed=1).digest
    found: list[str] = []
    threads = [threading.Thread(target=lambda: found.append(uchain.run(what, seed=1).digest)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [alone] * 4


def test_ctrl_c_ends_a_run_within_a_second(tmp_path: pathlib.Path):
    program = textwrap.dedent("""
        import sys, uchain
        long = uchain.Scenario.from_name("corner").with_(duration_s=86400)
        print("flying", flush=True)
        try:
            uchain.run(long, frames=None, record=sys.argv[1])
        except KeyboardInterrupt:
            print("stopped", flush=True)
    """)
    path = tmp_path / "run.mcap"
    with subprocess.Popen([sys.executable, "-c", program, path], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None and child.stdout.readline() == "flying\n"
        time.sleep(0.5)
        assert child.poll() is None
        begun = time.monotonic()
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "stopped\n"
        assert time.monotonic() - begun < 5
        assert child.wait(5) == 0
    assert list(tmp_path.iterdir()) == [], "what was not finished is gone"


@pytest.mark.parametrize("seed", [-1, 1 << 64, 1.5, True, "1", None])
def test_a_seed_that_is_none_is_refused_in_words(seed: Any):
    with pytest.raises(ValueError, match="seed = .*: expected a whole number from 0 to 18446744073709551615"):
        uchain.run("straight", seed)


def test_arguments_of_other_kinds_are_refused_in_words():
    with pytest.raises(TypeError, match="expected a scenario"):
        uchain.run(3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='frames = 1: expected "ticks", "decisions" or None'):
        uchain.run("straight", frames=1)  # type: ignore[arg-type]
    with pytest.raises(uchain.ScenarioError, match="did you mean 'corner'"):
        uchain.run("cornr")
    assert uchain.run(scenario("straight", duration_s=1), np.int64(3)).seed == 3
