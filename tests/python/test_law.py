"""A law of one's own in Python: relay by relay, for all relays at once, in one run and in many."""

import functools
import pickle
import subprocess
import sys
import traceback
from typing import Any

import numpy as np
import pytest

import uchain

CORNER = uchain.Scenario.from_name("corner")
STRAIGHT = uchain.Scenario.from_name("straight")
# Relays take off within the first minute.
SHORT = STRAIGHT.with_(duration_s=60)


def eq_12(seen: uchain.Seen, gain: np.float32 = np.float32(1)) -> np.float32:
    """Eq. 12 in float32, in the order of the built-in law, with its guards."""
    params = seen.params
    s_d = seen.front_db - seen.back_db
    if not np.isfinite(s_d) or abs(s_d) <= params.tolerance_db:
        return np.float32(0)
    v_mps = s_d / (np.float32(3) * (gain * params.k_db_per_m)) / params.decision_s
    return min(max(v_mps, -params.v_max_mps), params.v_max_mps)


@uchain.batched
def eq_12_of_all(seen: uchain.SeenArrays) -> np.ndarray:
    params = seen.params
    s_d = seen.front_db - seen.back_db
    v_mps = np.clip(s_d / (np.float32(3) * params.k_db_per_m) / params.decision_s, -params.v_max_mps, params.v_max_mps)
    return np.where(np.abs(s_d) <= params.tolerance_db, np.float32(0), v_mps)


def stay(seen: Any) -> float:
    return 0.0


class Late:
    """Has a memory for each relay: the speed of its last decision."""

    def start(self, uav: int, params: uchain.LawParams) -> "Late.Relay":
        return self.Relay(uav, params)

    class Relay:
        def __init__(self, uav: int, params: uchain.LawParams):
            self.uav, self.params, self.last = uav, params, np.float32(0)

        def __call__(self, seen: uchain.Seen) -> np.float32:
            assert seen.uav == self.uav and seen.params.k_db_per_m == self.params.k_db_per_m
            last, self.last = self.last, eq_12(seen)
            return last


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("scenario", [CORNER, STRAIGHT], ids=["corner", "straight"])
@pytest.mark.parametrize("law", [eq_12, eq_12_of_all], ids=["each", "together"])
def test_a_law_that_computes_eq_12_has_the_digest_of_the_command_line(law, scenario, seed: int, summary_of):
    run = uchain.run(scenario, seed, law=law)
    wanted = summary_of(scenario.name, seed)
    assert run.digest == wanted["digest"]
    assert run.summary.verdict == wanted["verdict"]


def test_control_other_laws_are_other_flights():
    built_in = uchain.run(CORNER, 1).digest
    others = [functools.partial(eq_12, gain=np.float32(1.001)), stay, Late(), uchain.batched(lambda seen: 0 * seen.uav)]
    digests = [uchain.run(CORNER, 1, law=law, frames=None).digest for law in others]
    assert built_in not in digests
    assert digests[1] == digests[3] and len(set(digests)) == 3


@pytest.mark.parametrize(
    "sets",
    [
        {"link.signal": "raw"},
        {"equalize.tolerance_db": 5.0},
        {"equalize.decision_s": 0.1, "packets.delay_ticks": 6, "faults.burst_rate": 0.05},
        {"equalize.k_db_per_m": 40, "equalize.v_max_mps": 0.15, "faults.dead": [{"uav": 1, "start_s": 50}]},
    ],
)
def test_whatever_the_scenario_says_eq_12_is_eq_12(sets: dict[str, Any]):
    scenario = CORNER.with_(**sets)
    built_in = uchain.run(scenario, 5, frames=None)
    for law in (eq_12, eq_12_of_all):
        assert uchain.run(scenario, 5, law=law, frames=None).digest == built_in.digest


def test_a_relay_sees_float32_and_no_place():
    all_seen: list[uchain.Seen] = []

    def law(seen: uchain.Seen) -> np.float32:
        all_seen.append(seen)
        return eq_12(seen)

    uchain.run(SHORT, 1, law=law, frames=None)
    seen = all_seen[-1]
    numbers = [name for name in dir(seen) if name.endswith(("_db", "_mps", "_m", "silent_s"))]
    assert len(numbers) == 11 and not {"x_m", "y_m"} & set(dir(seen))
    assert all(type(getattr(seen, name)) is np.float32 for name in numbers)
    params = [name for name in dir(seen.params) if not name.startswith("_")]
    assert all(type(getattr(seen.params, name)) is np.float32 for name in params)
    assert seen.uav in (1, 2, 3) and seen.place in (1, 2, 3)
    assert seen.time_s == pytest.approx(seen.tick * 0.05) and seen.tick % 4 == 0
    with pytest.raises(AttributeError):
        seen.back_db = 3
    with pytest.raises(AttributeError):
        seen.more = 3
    again = pickle.loads(pickle.dumps(seen))
    assert all(getattr(again, name) == getattr(seen, name) for name in [*numbers, "uav", "place", "tick", "time_s"])
    ticks = [seen.tick for seen in all_seen]
    assert ticks == sorted(ticks)


def test_each_relay_has_a_memory_of_its_own_and_each_run_begins_anew():
    law = Late()
    first = uchain.run(STRAIGHT, 1, law=law, frames=None)
    assert uchain.run(STRAIGHT, 1, law=law, frames=None).digest == first.digest
    assert first.digest != uchain.run(STRAIGHT, 1, frames=None).digest


def raises_at(tick: int, error: BaseException):
    def law(seen: uchain.Seen) -> np.float32:
        if seen.tick >= tick:
            raise error
        return eq_12(seen)

    return law


def test_a_law_that_raises_ends_the_run_with_its_traceback_at_that_tick():
    with pytest.raises(uchain.LawError, match=r"raised ValueError: too far, at tick 1000 \(50\.00 s\) for UAV \d") as told:
        uchain.run(SHORT, 1, law=raises_at(1000, ValueError("too far")))
    assert isinstance(told.value, uchain.UchainError)
    assert isinstance(told.value.__cause__, ValueError)
    frames = traceback.extract_tb(told.value.__cause__.__traceback__)
    assert frames[-1].name == "law" and frames[-1].filename == __file__

    @uchain.batched
    def of_all(seen: uchain.SeenArrays) -> np.ndarray:
        if seen.tick[0] >= 1000:
            raise ValueError("too far")
        return eq_12_of_all(seen)

    with pytest.raises(uchain.LawError, match=r"raised ValueError: too far, at tick 1000 \(50\.00 s\) for UAV"):
        uchain.run(SHORT, 1, law=of_all)


def test_a_law_that_never_ends_is_ended_by_ctrl_c(tmp_path):
    program = """
import os, signal, threading, time
import uchain

def law(seen):
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    global start
    start = time.monotonic()
    while True:
        pass

try:
    uchain.run("straight", law=LAW)
except KeyboardInterrupt:
    print("ended after", time.monotonic() - start)
"""
    for law in ("law", "uchain.batched(law)"):
        command = [sys.executable, "-c", program.replace("LAW", law)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        assert done.stdout.startswith("ended after"), done.stderr
        assert float(done.stdout.split()[-1]) < 5


def test_nothing_is_asked_after_a_law_has_raised():
    asked = 0

    def law(seen: uchain.Seen) -> float:
        nonlocal asked
        asked += 1
        raise RuntimeError("once")

    with pytest.raises(uchain.LawError, match="once"):
        uchain.run(SHORT, law=law)
    assert asked == 1


class Odd:
    def __repr__(self) -> str:
        raise RuntimeError("no words")

    def __float__(self) -> float:
        raise RuntimeError("no number")


NO_SPEED = [
    None,
    float("nan"),
    float("inf"),
    -np.inf,
    np.float32("nan"),
    1e39,
    10**400,
    "0.1",
    b"0.1",
    1j,
    np.complex64(1),
    True,
    np.bool_(True),
    [0.1],
    (),
    {},
    np.zeros(2),
    np.zeros(1),
    np.zeros((1, 1), np.float32),
    np.array("0.1"),
    np.array(None),
    np.datetime64("2021-01-01"),
    Odd(),
    Odd,
    eq_12,
]


@pytest.mark.parametrize("answer", NO_SPEED, ids=[str(i) for i in range(len(NO_SPEED))])
def test_what_is_no_speed_ends_the_run_and_names_tick_and_relay(answer: Any):
    with pytest.raises(uchain.LawError, match=r"returned .*expected one finite number.*at tick \d+ \(.* s\) for UAV \d"):
        uchain.run(SHORT, law=lambda seen: answer)


@pytest.mark.parametrize("answer", [0, 0.0, np.float32(0), np.float64(0), np.int8(0), np.array(0.0), np.array(0, np.uint8)])
def test_every_real_number_is_a_speed(answer: Any):
    assert uchain.run(SHORT, law=lambda seen: answer, frames=None).digest == uchain.run(SHORT, law=stay, frames=None).digest


NO_SPEEDS = [
    None,
    0.0,
    [],
    np.zeros(0),
    np.zeros(7),
    np.zeros((1, 1)),
    np.zeros(1, complex),
    np.zeros(1, bool),
    np.array(["0.1"]),
    np.array([None]),
    "0.1",
    np.array([np.nan]),
    np.array([np.inf], np.float32),
    np.array([1e39]),
]


@pytest.mark.parametrize("answer", NO_SPEEDS, ids=[str(i) for i in range(len(NO_SPEEDS))])
def test_what_is_no_array_of_speeds_ends_the_run(answer: Any):
    with pytest.raises(uchain.LawError, match=r"returned .*expected .*at tick \d+ \(.* s\) for UAV \d"):
        uchain.run(SHORT, law=uchain.batched(lambda seen: answer))


def test_a_speed_beyond_the_largest_is_bounded():
    fast = uchain.run(SHORT, law=lambda seen: 1e9, frames=None)
    assert fast.digest == uchain.run(SHORT, law=lambda seen: seen.params.v_max_mps, frames=None).digest


@pytest.mark.parametrize("law", [3, "eq_12", None.__class__, object(), uchain.UchainError()], ids=str)
def test_what_is_no_law_is_refused(law: Any):
    with pytest.raises((TypeError, uchain.LawError), match="law"):
        uchain.run(SHORT, law=law)
    with pytest.raises(TypeError, match="law"):
        uchain.batched(3)


def test_an_exploration_has_no_relays_to_level():
    with pytest.raises(ValueError, match="which has no relays: expected the scenario of a chain"):
        uchain.run("lab", law=eq_12)


def test_start_that_raises_or_gives_no_law_ends_the_run():
    class Bad:
        def start(self, uav: int, params: uchain.LawParams) -> Any:
            raise KeyError("start")

    with pytest.raises(uchain.LawError, match="raised KeyError: 'start'"):
        uchain.run(SHORT, law=Bad())
    Bad.start = lambda self, uav, params: 3
    with pytest.raises(uchain.LawError, match="TypeError: 'int' object is not callable"):
        uchain.run(SHORT, law=Bad())


@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit])
def test_what_is_no_error_of_the_law_goes_on_as_it_is(error):
    with pytest.raises(error):
        uchain.run(SHORT, law=raises_at(900, error()))


def test_a_law_is_recorded_under_its_name_and_flown_again_by_whoever_has_it(tmp_path):
    path = tmp_path / "run.mcap"
    flown = uchain.run(SHORT, 1, law=Late(), record=path)
    read = uchain.read_recording(path)
    assert read.digest == flown.digest and read.outcome == flown.outcome
    with pytest.raises(uchain.RecordingError, match='chain.brain = "python:Late": unknown choice'):
        read.verify()
    with pytest.raises(ValueError, match='"python:Late": expected law='):
        uchain.run(read.scenario, 1)
    assert uchain.run(read.scenario, 1, law=Late()).digest == flown.digest
    built_in = read.scenario.with_(**{"chain.brain": "node"})
    assert uchain.run(built_in, 1).digest == uchain.run(SHORT, 1).digest != flown.digest


def test_a_decorated_law_is_still_a_law_and_is_pickled():
    assert eq_12_of_all.law.__name__ == "eq_12_of_all"
    again = pickle.loads(pickle.dumps(uchain.batched(stay)))
    assert again.law is stay and again(None) == 0.0


def test_a_law_may_fly_runs_itself():
    def law(seen: uchain.Seen) -> np.float32:
        if seen.tick == 1000:
            uchain.run(SHORT.with_(duration_s=50), 3, law=stay, frames=None)
        return eq_12(seen)

    assert uchain.run(SHORT, 1, law=law).digest == uchain.run(SHORT, 1).digest


def sweep(law: Any, **arguments: Any) -> uchain.Table:
    vary = {"radio.sigma_db": [0, 2], "equalize.k_db_per_m": [15, 25]}
    return uchain.sweep(SHORT, vary, replicates=3, progress=False, law=law, **arguments)


def test_rows_of_a_sweep_by_eq_12_are_those_of_the_built_in_law():
    built_in = sweep(None)
    assert len(built_in) == 12
    for law in (eq_12, eq_12_of_all):
        assert sweep(law) == built_in
        assert sweep(law, threads=1) == built_in
    assert sweep(stay) != built_in


def test_shards_of_a_sweep_by_a_law_are_the_whole():
    for law in (eq_12, eq_12_of_all, Late()):
        parts = [sweep(law, shard=(number, 3)) for number in (3, 1, 2)]
        assert uchain.concat(parts) == sweep(law, threads=2)


def test_many_more_runs_than_fly_side_by_side_are_in_their_order():
    short = STRAIGHT.with_(duration_s=12)
    runs = {"replicates": 700, "progress": False}
    one_by_one = uchain.sweep(short, law=eq_12, **runs)
    together = uchain.sweep(short, law=eq_12_of_all, **runs)
    assert together == one_by_one == uchain.sweep(short, **runs)
    assert together["run"].tolist() == list(range(700))


def test_runs_side_by_side_may_last_differently_and_decide_at_different_rates():
    vary = {"duration_s": [20, 60], "equalize.decision_s": [0.1, 0.2, 0.5]}
    runs = {"replicates": 2, "progress": False}
    assert uchain.sweep(STRAIGHT, vary, law=eq_12_of_all, **runs) == uchain.sweep(STRAIGHT, vary, **runs)


def test_a_batched_law_is_asked_for_all_runs_at_once():
    worlds: list[int] = []

    @uchain.batched
    def law(seen: uchain.SeenArrays) -> np.ndarray:
        worlds.append(len(set(seen.world.tolist())))
        assert seen.asks.all() and seen.back_db.ndim == 1
        assert seen.back_db.shape == seen.uav.shape == seen.params.k_db_per_m.shape == seen.time_s.shape
        return eq_12_of_all(seen)

    sweep(law, threads=1)
    assert max(worlds) == 12


def test_a_run_whose_law_raises_is_a_failed_row_and_the_others_go_on():
    def law(seen: uchain.Seen) -> Any:
        if seen.params.k_db_per_m == 15 and seen.tick >= 1000:
            raise ValueError("too soft")
        return eq_12(seen)

    @uchain.batched
    def nan(seen: uchain.SeenArrays) -> np.ndarray:
        return np.where((seen.params.k_db_per_m == 15) & (seen.tick >= 1000), np.nan, eq_12_of_all(seen))

    built_in = sweep(None)
    for bad, words in ((law, "raised ValueError: too soft"), (nan, "returned NaN")):
        table = sweep(bad)
        failed = table["equalize.k_db_per_m"] == 15
        assert failed.sum() == 6
        for row in range(len(table)):
            if failed[row]:
                assert table["failed"][row].startswith(f"the law {words}")
                assert "at tick 1000 (50.00 s) for UAV" in table["failed"][row]
                assert np.isnan(table["sim_s"][row])
            else:
                assert table["digest"][row] == built_in["digest"][row]


def test_a_batched_law_that_raises_ends_the_runs_that_were_asked():
    @uchain.batched
    def law(seen: uchain.SeenArrays) -> np.ndarray:
        raise ValueError("never")

    table = uchain.sweep(STRAIGHT, {"duration_s": [2, 60]}, replicates=2, progress=False, law=law)
    failed = [text is not None and "raised ValueError: never" in text for text in table["failed"]]
    # Within 2 s no relay flies, and nobody is asked.
    assert failed == [False, False, True, True]


@pytest.mark.parametrize("answer", [None, np.zeros(1000), np.zeros(1, complex), "0.1"], ids=["none", "shape", "complex", "str"])
def test_what_is_no_array_of_speeds_is_a_failed_row(answer: Any):
    table = uchain.sweep(SHORT, replicates=2, progress=False, law=uchain.batched(lambda seen: answer))
    assert all("the law returned" in text and "expected" in text for text in table["failed"])


@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit])
@pytest.mark.parametrize("way", [lambda law: law, lambda law: uchain.batched(law)], ids=["each", "together"])
def test_what_is_no_error_of_the_law_ends_a_sweep(way, error):
    def law(seen: Any) -> Any:
        raise error

    with pytest.raises(error):
        sweep(way(law))


def test_a_sweep_by_a_law_keeps_no_folder_and_flies_no_exploration(tmp_path):
    with pytest.raises(ValueError, match="law with out=.*resuming"):
        sweep(eq_12, out=tmp_path / "sweep")
    assert not (tmp_path / "sweep").exists()
    for law in (eq_12, eq_12_of_all):
        with pytest.raises(ValueError, match="which has no relays"):
            uchain.sweep(uchain.Scenario.from_name("lab").with_(duration_s=2), replicates=1, progress=False, law=law)
    with pytest.raises(TypeError, match="law = 3"):
        sweep(3)


def test_a_sweep_by_a_law_is_ended_by_ctrl_c():
    program = """
import os, signal, threading, time
import uchain

def law(seen):
    time.sleep(0.001)
    return 0.0

start = time.monotonic() + 0.5
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    uchain.sweep("straight", replicates=100_000, progress=False, law=LAW)
except KeyboardInterrupt:
    print("ended after", time.monotonic() - start)
"""
    for law in ("law", "uchain.batched(lambda seen: [law(seen)] * len(seen.uav))"):
        command = [sys.executable, "-c", program.replace("LAW", law)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        assert done.stdout.startswith("ended after"), done.stderr
        assert float(done.stdout.split()[-1]) < 5
