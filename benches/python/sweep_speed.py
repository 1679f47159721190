"""How fast a sweep is through Python, beside the command line: the same 400 runs, in turn.

python benches/python/sweep_speed.py path/to/uchain [rounds]

Prints the medians (s), and what Python takes more than the command line, which writes files besides (%).
"""

import statistics
import subprocess
import sys
import tempfile
import time

import uchain

VARY = {"radio.sigma_db": [0, 4]}
REPLICATES = 200


def by_python() -> str:
    return uchain.sweep("straight", VARY, replicates=REPLICATES, progress=False).digest


def by_command(cli: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        args = ["sweep", "straight", "--vary", "radio.sigma_db=0,4", "--replicates", str(REPLICATES), "--seed", "0"]
        done = subprocess.run([cli, *args, "--out", f"{folder}/out", "--json"], check=True, capture_output=True, text=True)
        return done.stdout.split('"digest": "')[1][:16]


def main() -> None:
    cli, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 9
    times: dict[str, list[float]] = {"python": [], "command": []}
    assert by_python() == by_command(cli), "they fly different runs"
    for _ in range(rounds):
        for name, fly in [("python", by_python), ("command", lambda: by_command(cli))]:
            start = time.perf_counter()
            fly()
            times[name].append(time.perf_counter() - start)
    python, command = (statistics.median(times[name]) for name in ("python", "command"))
    print(f"python {python:.3f} s, command {command:.3f} s: {100 * (python / command - 1):+.1f} %")


if __name__ == "__main__":
    main()
