"""One scenario, one seed, one digest: from the command line, from Python, from Rust's reviewed tables, on another CPU."""

import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

import pytest

import uchain

ROOT = pathlib.Path(__file__).parents[2]
SEEDS = (1, 2, 3)
FLIGHTS = [(name, seed) for name in uchain.scenarios() for seed in SEEDS]

# All flights from Python, in a process of its own.
PROGRAM = """
import json, sys, uchain
flights = json.load(sys.stdin)
print(json.dumps([uchain.run(name, seed, frames=None).digest for name, seed in flights]))
"""
# The system's C library chooses its functions as on a CPU without FMA and AVX2 (glibc on x86-64).
PLAIN_CPU = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2"}
SYSTEMS_EXP = "import ctypes, ctypes.util; m = ctypes.CDLL('libm.so.6'); m.exp.restype = ctypes.c_double; m.exp.argtypes = [ctypes.c_double]; print([m.exp(i * 0.37).hex() for i in range(2000)])"


def python(program: str, given: str = "", **env: str) -> str:
    command = [sys.executable, "-c", program]
    done = subprocess.run(
        command, input=given, env=os.environ | env, capture_output=True, text=True, check=True, timeout=600
    )
    return done.stdout


@pytest.fixture(scope="module")
def from_python() -> dict[tuple[str, int], str]:
    return dict(zip(FLIGHTS, json.loads(python(PROGRAM, json.dumps(FLIGHTS))), strict=True))


def test_every_scenario_has_the_digest_of_the_command_line(from_python, summary_of):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        digests = list(pool.map(lambda flight: summary_of(*flight)["digest"], FLIGHTS))
    assert from_python == dict(zip(FLIGHTS, digests, strict=True))
    # Control: others differ, but for a mission in which nothing is random.
    assert len(set(digests)) > len(FLIGHTS) - len(SEEDS)


def test_every_scenario_has_the_digest_of_the_tables_that_rust_is_held_to(from_python):
    reviewed = {}
    for table in ROOT.glob("tests/*/snapshots/main__*.snap"):
        for line in table.read_text().splitlines():
            words = line.split()
            if len(words) > 2 and words[1].isdigit() and len(words[-1]) == 16:
                reviewed[words[0], int(words[1])] = words[-1]
    both = {flight for flight in FLIGHTS if flight in reviewed}
    assert len(both) >= 21
    assert {flight: from_python[flight] for flight in both} == {flight: reviewed[flight] for flight in both}


def test_every_scenario_has_the_same_digest_on_a_cpu_without_fma(from_python):
    plain = json.loads(python(PROGRAM, json.dumps(FLIGHTS), **PLAIN_CPU))
    assert from_python == dict(zip(FLIGHTS, plain, strict=True))


def test_control_the_system_computes_otherwise_on_a_cpu_without_fma():
    if "fma" not in pathlib.Path("/proc/cpuinfo").read_text().split():
        pytest.skip("this CPU has no FMA to hide")
    assert python(SYSTEMS_EXP) != python(SYSTEMS_EXP, **PLAIN_CPU)
