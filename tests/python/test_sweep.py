"""Sweeps: the rows of the command line, whoever flies them, in whatever pieces; and what is refused, in words."""

import concurrent.futures
import functools
import io
import multiprocessing
import pathlib
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from conftest import optional

import uchain

Cli = Callable[..., pathlib.Path]
FAULTS = {"duration_s": 10, "faults.dead": [{"uav": 0, "start_s": 5}]}


@pytest.fixture(scope="module")
def flown(cli: pathlib.Path, tmp_path_factory: pytest.TempPathFactory) -> Cli:
    """Flies a sweep by the command line; gives its folder."""

    def fly(scenario: str, *args: str) -> pathlib.Path:
        folder = tmp_path_factory.mktemp("sweep") / "out"
        subprocess.run([cli, "sweep", scenario, *args, "--out", folder, "--quiet"], check=True)
        return folder

    return fly


def scenario(name: str = "straight", **values: Any) -> uchain.Scenario:
    return uchain.Scenario.from_name(name).with_(**({"duration_s": 3} | values))


def parquet(table: uchain.Table, folder: pathlib.Path) -> bytes:
    path = folder / f"{time.monotonic_ns()}.parquet"
    table.to_parquet(path)
    return path.read_bytes()


quiet = functools.partial(uchain.sweep, progress=False)

# --- the same rows


def test_a_table_of_a_chain_has_the_bytes_of_the_command_line_and_another_seed_has_others(
    flown: Cli, tmp_path: pathlib.Path
):
    folder = flown("straight", "--set", "duration_s=3", "--vary", "radio.sigma_db=0,2.5,6", "--replicates", "4",
                   "--seed", "7")
    vary = {"radio.sigma_db": [0, 2.5, 6]}
    table = quiet(scenario(), vary, replicates=4, seed=7)
    wanted = (folder / "runs.parquet").read_bytes()
    assert parquet(table, tmp_path) == wanted
    assert uchain.open_sweep(folder) == table
    other = quiet(scenario(), vary, replicates=4, seed=8)
    assert parquet(other, tmp_path) != wanted and other != table


def test_a_table_of_an_exploration_has_the_bytes_of_the_command_line(flown: Cli, tmp_path: pathlib.Path):
    args = ["--vary", "explore.strategy=cssg,srg", "--vary", "explore.robots=1,2", "--replicates", "2", "--seed", "0"]
    folder = flown("apartment", "--set", "duration_s=20", *args)
    rooms = uchain.Scenario.from_name("apartment").with_(duration_s=20)
    table = quiet(rooms, {"explore.strategy": ["cssg", "srg"], "explore.robots": np.array([1, 2])}, replicates=2)
    assert parquet(table, tmp_path) == (folder / "runs.parquet").read_bytes()
    assert uchain.open_sweep(folder) == table


def test_runs_that_fail_are_rows_with_the_reasons_of_the_command_line(flown: Cli, tmp_path: pathlib.Path):
    args = ["--vary", "chain.spacing_m=0.05,0.25", "--vary", "faults.dead.0.start_s=5,100", "--replicates", "1"]
    folder = flown("corner", "--set", "duration_s=10", "--set", "faults.dead=[{ uav = 0, start_s = 5 }]", *args)
    vary: dict[str, list[Any]] = {"chain.spacing_m": [0.05, 0.25], "faults.dead.0.start_s": [5, 100]}
    out = tmp_path / "out"
    table = quiet(uchain.Scenario.from_name("corner").with_(**FAULTS), vary, replicates=1, seed=1, out=out,
                  record="failed")
    wanted = uchain.open_sweep(folder)
    # The texts of what is written over it differ (`start_s = 5.0`), the rows do not.
    assert table.failed == 3 and table.digest == wanted.digest
    assert list(table["failed"]) == list(wanted["failed"])
    assert table["failed"][0].startswith("not flown: --vary chain.spacing_m=0.05: ")
    assert table["failed"][2] == "head-failed" and table["failed"][3] is None
    assert [path.name for path in (out / "recordings").iterdir()] == ["run-00000002.mcap"]


DESIGN = "radio.sigma_db,chain.uavs,equalize.law\n1.5,2,\n,3,bang-bang\n0.1,,lipschitz\n"
COLUMNS: dict[str, list[Any]] = {
    "radio.sigma_db": [1.5, None, 0.1],
    "chain.uavs": [2, 3, None],
    "equalize.law": [None, "bang-bang", "lipschitz"],
}


def test_a_design_is_a_file_columns_rows_or_a_data_frame(flown: Cli, cli: pathlib.Path, tmp_path: pathlib.Path):
    laws = subprocess.run([cli, "explain", "equalize.law"], capture_output=True, text=True).stdout
    assert "bang-bang" in laws and "lipschitz" in laws
    file = tmp_path / "design.csv"
    file.write_text(DESIGN)
    folder = flown("straight", "--set", "duration_s=3", "--design", str(file), "--replicates", "2", "--seed", "0")
    wanted = (folder / "runs.parquet").read_bytes()
    rows = [{key: COLUMNS[key][row] for key in COLUMNS} for row in range(3)]
    designs: dict[str, Any] = {
        "path": file,
        "text of a path": str(file),
        "columns": COLUMNS,
        "rows": rows,
        "rows that lack keys": [{k: v for k, v in row.items() if v is not None or row is rows[0]} for row in rows],
        "polars": optional("polars").DataFrame(COLUMNS),
        "pyarrow": optional("pyarrow").table(COLUMNS),
    }
    for name, design in designs.items():
        assert parquet(quiet(scenario(), design=design, replicates=2), tmp_path) == wanted, name
    frame = optional("pandas").DataFrame({"radio.sigma_db": [1.5, 2.0], "chain.uavs": [2, 3]})
    table = quiet(scenario(), design=frame, replicates=1)
    assert list(table["chain.uavs"]) == [2, 3] and list(table["radio.sigma_db"]) == [1.5, 2.0]


def test_a_design_and_varied_keys_are_every_combination():
    table = quiet(scenario(), {"chain.uavs": [2, 3]}, design={"radio.sigma_db": [0, 1]}, replicates=1)
    assert list(zip(table["radio.sigma_db"], table["chain.uavs"], strict=True)) == [(0, 2), (0, 3), (1, 2), (1, 3)]


def test_values_of_python_are_values_of_toml():
    vary: dict[str, Any] = {"radio.sigma_db": "0..2/3", "chain.uavs": range(2, 4), "preset": ["cavemod"]}
    table = quiet(scenario(), vary, replicates=1)
    assert table.about["design"]["vary"] == ["radio.sigma_db=0..2/3", "chain.uavs=2,3", "preset=cavemod"]
    odd = [True, np.bool_(False), np.float32(0.5), np.int16(3), "true", "two words", [1, 2.5]]
    with pytest.raises(uchain.UchainError):
        quiet(scenario(), {"radio.sigma_db": odd})
    vary = {"link.base_flow": [True, np.bool_(False)]}
    assert quiet(scenario(), vary, replicates=1).about["design"]["vary"] == ["link.base_flow=true,false"]


def test_a_scenario_that_can_only_be_laid_out_once_it_is_varied_is_swept(tmp_path: pathlib.Path):
    path = tmp_path / "mine.toml"
    text = scenario().toml
    assert "uavs = " in text
    path.write_text(text.replace("[chain]", "[chain]\nspacing_m = 0.01"))
    with pytest.raises(uchain.ScenarioError):
        uchain.Scenario.from_file(path)
    table = quiet(path, {"chain.spacing_m": [0.25], "duration_s": [2]}, replicates=1)
    assert table.failed == 0 and table.scenario == "straight" and table.about["file"] == "mine.toml"


# --- pieces


def piece(shard: tuple[int, int]) -> uchain.Table:
    return uchain.sweep(scenario(), {"radio.sigma_db": [0, 4]}, replicates=50, shard=shard, threads=1, progress=False)


@pytest.fixture(scope="module")
def whole() -> uchain.Table:
    return piece((1, 1))


def test_any_number_of_threads_gives_the_same_table(whole: uchain.Table):
    for threads in [1, 2, 7]:
        assert quiet(scenario(), {"radio.sigma_db": [0, 4]}, replicates=50, threads=threads) == whole


def test_threads_of_python_fly_side_by_side(whole: uchain.Table):
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        parts = list(pool.map(piece, [(i, 4) for i in (3, 1, 4, 2)]))
    assert [len(part) for part in parts] == [25] * 4 and not parts[0].is_complete
    assert uchain.concat(parts) == whole


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_processes_fly_shards_that_are_the_whole(method: str, whole: uchain.Table, tmp_path: pathlib.Path):
    context = multiprocessing.get_context(method)
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        parts = list(pool.map(piece, [(i, 3) for i in (1, 2, 3)]))
    joined = uchain.concat(parts)
    assert joined == whole and parquet(joined, tmp_path) == parquet(whole, tmp_path)


def test_tables_that_are_not_parts_of_one_are_refused(whole: uchain.Table):
    with pytest.raises(uchain.SweepError, match="run 0 is in two of the tables"):
        uchain.concat([whole, piece((1, 2))])
    with pytest.raises(uchain.SweepError, match="another sweep than table 0: seed = 0 there, 1 asked for"):
        uchain.concat([whole, quiet(scenario(), {"radio.sigma_db": [0, 4]}, replicates=50, seed=1)])
    with pytest.raises(uchain.SweepError, match="expected at least one"):
        uchain.concat([])
    with pytest.raises(TypeError, match="expected a list of uchain.Table"):
        uchain.concat([3])  # type: ignore[list-item]
    part = uchain.concat([piece((2, 3)), piece((3, 3))])
    with pytest.raises(uchain.SweepError, match=r"34 of 100 runs are missing, the first is run 0: .*uchain\.concat"):
        part.report()


# --- folders


def test_a_folder_is_that_of_the_command_line_and_is_gone_on_with(
    cli: pathlib.Path, flown: Cli, tmp_path: pathlib.Path
):
    args = ["--set", "duration_s=3", "--replicates", "5", "--seed", "0"]
    folder, out = flown("straight", *args), tmp_path / "out"
    table = quiet(scenario(), replicates=5, out=out)
    for name in ["sweep.json", "runs.parquet"]:
        assert (out / name).read_bytes() == (folder / name).read_bytes(), name
    with pytest.raises(uchain.SweepError, match="holds a sweep already: resume=True goes on with it"):
        quiet(scenario(), replicates=5, out=out)
    with pytest.raises(uchain.SweepError, match="holds another sweep: replicates = 5 there, 6 asked for"):
        quiet(scenario(), replicates=6, out=out, resume=True)
    assert quiet(scenario(), replicates=5, out=out, resume=True) == table
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.tex").touch()
    with pytest.raises(uchain.SweepError, match=r"holds something else \(thesis.tex\); name another folder"):
        quiet(scenario(), replicates=5, out=tmp_path / "full")
    # Shards that were flown from Python, merged by the command line.
    parts = [tmp_path / f"part{i}" for i in (1, 2)]
    shards = [quiet(scenario(), replicates=5, out=part, shard=(i, 2)) for i, part in enumerate(parts, 1)]
    assert uchain.concat(shards) == table and uchain.open_sweep(parts[0]) == shards[0]
    subprocess.run([cli, "merge", *parts, "--out", tmp_path / "merged", "--quiet"], check=True)
    assert uchain.open_sweep(tmp_path / "merged") == table


def test_a_damaged_folder_is_named(tmp_path: pathlib.Path):
    out = tmp_path / "out"
    quiet(scenario(), replicates=2, out=out)
    table = bytearray((out / "runs.parquet").read_bytes())
    table[100] ^= 1
    (out / "runs.parquet").write_bytes(table)
    with pytest.raises(uchain.SweepError, match="is damaged: its checksum is not that in sweep.json; remove it"):
        uchain.open_sweep(out)
    with pytest.raises(uchain.SweepError, match="holds no sweep"):
        uchain.open_sweep(tmp_path)
    blocked = tmp_path / "file"
    blocked.touch()
    with pytest.raises(OSError, match="file"):
        quiet(scenario(), replicates=2, out=blocked / "out")


LONG = """
import sys, uchain
straight = uchain.Scenario.from_name("straight")
print("flies", flush=True)
uchain.sweep(straight, {"radio.sigma_db": [0, 4]}, replicates=REPLICATES, progress=sys.argv[2:] == ["people"],
             out=sys.argv[1] or None)
print("done")
"""


def interrupted(out: str, replicates: int = 20_000, after_s: float = 1.5) -> tuple[float, subprocess.CompletedProcess]:
    """How long a sweep goes on after Ctrl-C (s), and what it left."""
    program = LONG.replace("REPLICATES", str(replicates))
    child = subprocess.Popen([sys.executable, "-c", program, out], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert child.stdout is not None and child.stdout.readline() == b"flies\n"
    time.sleep(after_s)
    start = time.monotonic()
    child.send_signal(signal.SIGINT)
    said, errors = child.communicate(timeout=30)
    return time.monotonic() - start, subprocess.CompletedProcess([], child.returncode, said, errors)


def test_ctrl_c_ends_a_sweep_within_a_second(tmp_path: pathlib.Path):
    took_s, done = interrupted("")
    assert done.returncode != 0 and b"KeyboardInterrupt" in done.stderr and b"done" not in done.stdout
    assert took_s < 5


def test_a_sweep_that_was_interrupted_goes_on_and_has_the_same_bytes(tmp_path: pathlib.Path):
    out = tmp_path / "out"
    took_s, done = interrupted(str(out), replicates=700, after_s=0.7)
    assert b"KeyboardInterrupt" in done.stderr and took_s < 5
    there = len(list((out / "chunks").iterdir()))
    assert there > 0 and not (out / "runs.parquet").exists()
    partly = uchain.open_sweep(out)
    assert 0 < len(partly) < 1400 and not partly.is_complete
    straight = uchain.Scenario.from_name("straight")
    vary = {"radio.sigma_db": [0, 4]}
    told: list[uchain.Progress] = []
    table = uchain.sweep(straight, vary, replicates=700, out=out, resume=True, progress=told.append)
    assert told[-1].done == told[-1].total == 1400
    other = quiet(straight, vary, replicates=700)
    assert table == other and (out / "runs.parquet").read_bytes() == parquet(other, tmp_path)


def test_a_chunk_that_is_damaged_is_flown_again_with_a_warning(tmp_path: pathlib.Path):
    out = tmp_path / "out"
    table = quiet(scenario(), replicates=4, out=out, shard=(1, 2))
    chunk = next((out / "chunks").iterdir())
    chunk.write_bytes(chunk.read_bytes()[:-3])
    with pytest.warns(UserWarning, match=f"{chunk.name} is damaged: .*flown again"):
        assert quiet(scenario(), replicates=4, out=out, shard=(1, 2), resume=True) == table


# --- progress


def test_a_function_is_told_how_far_it_has_come():
    told: list[uchain.Progress] = []
    table = uchain.sweep(scenario(duration_s=30), replicates=100, threads=1, progress=told.append)
    last = told[-1]
    assert (last.done, last.total, last.failed) == (100, 100, table.failed)
    assert last.left_s == 0 and last.elapsed_s > 0
    assert [p.done for p in told] == sorted(p.done for p in told) and len(told) < 100
    assert pickle.loads(pickle.dumps(last)) == last and str(last).startswith("100 of 100 runs")
    with pytest.raises(AttributeError):
        last.done = 3  # type: ignore[misc]


def test_what_a_function_raises_ends_the_sweep():
    def raising(progress: uchain.Progress) -> None:
        raise RuntimeError(f"after {progress.done}")

    start = time.monotonic()
    with pytest.raises(RuntimeError, match="after"):
        uchain.sweep("straight", replicates=20_000, progress=raising)
    assert time.monotonic() - start < 5


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_people_are_told_on_the_standard_error_output(monkeypatch: pytest.MonkeyPatch):
    said: dict[str, str] = {}
    for name, stderr in [("terminal", Terminal()), ("file", io.StringIO())]:
        monkeypatch.setattr(sys, "stderr", stderr)
        uchain.sweep("straight", replicates=400, threads=1)
        said[name] = stderr.getvalue()
    assert said["file"].startswith("400 runs, ") and said["file"].count("\n") == 1
    assert "\r" not in said["file"]
    lines = said["terminal"].split("\r")
    assert " of 400 runs" in lines[1] and " left" in lines[1] and lines[-1].startswith("400 runs, ")
    quiet_stderr = io.StringIO()
    monkeypatch.setattr(sys, "stderr", quiet_stderr)
    quiet(scenario(), replicates=2)
    assert quiet_stderr.getvalue() == ""
    monkeypatch.setattr(sys, "stderr", None)
    uchain.sweep(scenario(), replicates=2)


# --- what is refused

REFUSED: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"replicates": 0}, ValueError, "replicates = 0: expected a whole number from 1 to"),
    ({"replicates": -1}, ValueError, "replicates = -1: expected a whole number"),
    ({"replicates": 2.5}, ValueError, "replicates = 2.5"),
    ({"replicates": True}, ValueError, "replicates = True"),
    ({"replicates": 10_000_001}, uchain.SweepError, "10000001 runs .*expected at most 10000000"),
    ({"replicates": 1 << 63}, uchain.SweepError, "expected at most 10000000"),
    ({"seed": -1}, ValueError, "seed = -1: expected a whole number from 0 to 18446744073709551615"),
    ({"threads": 0}, ValueError, "threads = 0: expected a whole number from 1 to 1024"),
    ({"threads": 1025}, ValueError, "threads = 1025: expected a whole number from 1 to 1024"),
    ({"shard": (0, 2)}, ValueError, r"shard = \(0, 2\): expected \(number, of\)"),
    ({"shard": (3, 2)}, ValueError, r"shard = \(3, 2\)"),
    ({"shard": "1/2"}, ValueError, r"such as \(2, 4\)"),
    ({"progress": 3}, TypeError, "progress = 3: expected True, False, or a function"),
    ({"record": "some"}, ValueError, "record = 'some': expected \"none\", \"failed\" or \"all\""),
    ({"record": "all"}, ValueError, "record needs a folder: expected out=, too"),
    ({"resume": True}, ValueError, "resume=True needs a folder"),
    ({"vary": [1]}, TypeError, "expected a dict of keys and their values"),
    ({"vary": {"radio.sigma_db": 3}}, TypeError, r"radio.sigma_db = 3: expected a list of values, such as \[3\]"),
    ({"vary": {"radio.sigma_db": []}}, ValueError, "radio.sigma_db has no values"),
    ({"vary": {3: [1]}}, TypeError, "3 is no key; expected a str"),
    ({"vary": {"radio.sigma_db": [None]}}, TypeError, "radio.sigma_db: a value of type NoneType"),
    ({"vary": {"radio.sigma_db": [1, -3]}}, uchain.ScenarioError, "--vary radio.sigma_db=-3: .*must lie in"),
    ({"vary": {"radio.sigma_db": [float("nan")]}}, uchain.ScenarioError, "--vary radio.sigma_db=nan: "),
    ({"vary": {"radio.sigma": [1]}}, uchain.ScenarioError, "did you mean 'sigma_db'"),
    ({"vary": {"radio.sigma_db": "0..5"}}, uchain.SweepError, "expected low..high/count"),
    ({"vary": {"radio.sigma_db": range(1 << 60)}}, ValueError, "longer than 16777216 bytes"),
    ({"design": 3}, TypeError, "expected the path of a CSV file, a dict of columns, a list of dicts, or a data frame"),
    ({"design": [3]}, TypeError, "expected the path of a CSV file"),
    ({"design": "absent.csv"}, FileNotFoundError, "absent.csv: cannot read the design"),
    ({"design": {"radio.sigma_db": [1], "chain.uavs": [2, 3]}}, ValueError, "chain.uavs has 2 values, .* has 1"),
    ({"design": {"radio.sigma_db": 3}}, TypeError, "expected a list of values"),
    ({"design": {"radio.sigma_db": [float("nan")]}}, uchain.SweepError, "design:2: radio.sigma_db = nan: no value"),
    ({"design": {"radio.sigma_db": [1, -2]}}, uchain.ScenarioError, "design:3: "),
    ({"design": {}}, uchain.SweepError, "design:"),
    ({"design": {"chain.uavs": [2]}, "vary": {"chain.uavs": [3]}}, uchain.SweepError, "chain.uavs is written twice"),
]


@pytest.mark.parametrize(("named", "kind", "words"), REFUSED, ids=[str(named)[:60] for named, *_ in REFUSED])
def test_what_cannot_be_swept_is_refused_in_words(named: dict[str, Any], kind: type[Exception], words: str):
    with pytest.raises(kind, match=words):
        quiet(scenario(), **named)


def test_a_column_that_is_no_design_is_refused():
    pyarrow = optional("pyarrow")
    dates = pyarrow.table({"radio.sigma_db": pyarrow.array([1], pyarrow.timestamp("s"))})
    with pytest.raises(TypeError, match="radio.sigma_db is a column of Timestamp.*expected numbers, words"):
        quiet(scenario(), design=dates)


def test_a_mission_that_is_not_there_is_named():
    with pytest.raises(uchain.ScenarioError, match="did you mean 'straight'"):
        quiet("straigt")
    with pytest.raises(TypeError, match="expected a scenario"):
        quiet(3)  # type: ignore[arg-type]
