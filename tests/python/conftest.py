"""What the tests of the module find: the command line that was built with it, and Python itself."""

import importlib
import json
import os
import pathlib
import subprocess
from typing import Any

import pytest

ROOT = pathlib.Path(__file__).parents[2]


@pytest.fixture(scope="session")
def cli() -> pathlib.Path:
    """The command `uchain` that was built with the module, by the same compiler in the same profile."""
    path = os.environ.get("UCHAIN_CLI")
    if path is None:
        pytest.fail("UCHAIN_CLI is expected to say where the command uchain is; `cargo xtask test python` does")
    return pathlib.Path(path)


@pytest.fixture(scope="session")
def summary_of(cli: pathlib.Path, tmp_path_factory: pytest.TempPathFactory):
    """What the command line says of a run: the object in summary.json."""

    def fly(scenario: str, seed: int, *sets: str) -> dict[str, Any]:
        command = [cli, "run", scenario, "--json", "--quiet", "--seed", str(seed), "--out"]
        command.append(tmp_path_factory.mktemp("run") / "out")
        for written in sets:
            command += ["--set", written]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        return json.loads(done.stdout)

    return fly


def optional(module: str) -> Any:
    """A package that users may have or not: the gate has all of them, elsewhere its tests are skipped without it."""
    if os.environ.get("CI") == "true":
        return importlib.import_module(module)
    return pytest.importorskip(module)
