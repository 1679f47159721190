"""Every program in examples/*.py runs, and prints what its first lines say."""

import os
import pathlib
import re
import subprocess
import sys
from typing import Any

import pytest
from conftest import optional

ROOT = pathlib.Path(__file__).parents[2]
PROGRAMS = sorted((ROOT / "examples").glob("*.py"))
# Real logs and maps, which are shared and no part of the project.
DATA = ROOT.parent / "shared" / "data"
ARGUMENTS = {"filter_a_log.py": [DATA / "rssi" / "ble_flat_calib2021"]}


def test_there_are_programs():
    assert PROGRAMS and set(ARGUMENTS) <= {program.name for program in PROGRAMS}


@pytest.mark.parametrize("program", PROGRAMS, ids=[program.name for program in PROGRAMS])
def test_a_program_prints_what_its_first_lines_say(program: pathlib.Path, tmp_path: pathlib.Path):
    arguments = ARGUMENTS.get(program.name, [])
    if missing := [path for path in arguments if not path.exists()]:
        assert os.environ.get("CI") != "true", f"missing: {missing}"
        pytest.skip(f"no shared data: {missing}")
    done = subprocess.run(
        [sys.executable, program, *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    # An indented block of the docstring, each line of which stands in what is printed.
    words = program.read_text().split('"""')[1].splitlines()
    promised = [line.strip() for line in words if line.startswith("    ") and not line.strip().startswith("python ")]
    assert promised, "the first lines say nothing of what is printed"
    for line in promised:
        assert line in done.stdout, f"promised:\n{line}\nprinted:\n{done.stdout}"


def told(cells: list[Any]) -> list[list[str]]:
    """What the cells of a notebook print and return, as text; a picture's size in bytes aside."""
    said = []
    for cell in cells:
        if cell.cell_type == "code":
            texts = [out.get("text") or out.get("data", {}).get("text/plain", out.get("ename")) for out in cell.outputs]
            said.append([re.sub(r"\d+ bytes", "bytes", text) for text in texts])
    return said


def test_the_notebook_runs_and_says_what_it_said(tmp_path: pathlib.Path):
    nbformat, nbclient = optional("nbformat"), optional("nbclient")
    notebook = nbformat.read(ROOT / "examples" / "first_flight.ipynb", as_version=4)
    said = told(notebook.cells)
    pictures = [out for cell in notebook.cells for out in cell.get("outputs", ()) if "image/png" in out.get("data", {})]
    assert len(pictures) >= 3
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = []
    nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    assert told(notebook.cells) == said
    assert any("4cb3614f4c4f29fd" in text for cell in said for text in cell)
