"""What the documentation of the module says: everything has some, and its examples do what they say."""

import doctest
import inspect
import pathlib
import types
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import uchain
import uchain.laws


def described() -> Iterator[tuple[str, Any, str]]:
    """Every public thing: its name, itself, its words."""
    for module in (uchain, uchain.laws):
        yield module.__name__, module, inspect.getdoc(module) or ""
        for name in module.__all__:
            thing = getattr(module, name)
            full = f"{module.__name__}.{name}"
            if isinstance(thing, str | types.ModuleType):
                continue
            yield full, thing, inspect.getdoc(thing) or ""
            if inspect.isclass(thing) and not issubclass(thing, BaseException):
                for part, value in vars(thing).items():
                    if not part.startswith("_") and not isinstance(value, int | str):
                        yield f"{full}.{part}", value, inspect.getdoc(value) or ""


def test_every_public_thing_says_what_it_is():
    silent = [name for name, _, words in described() if len(words) < 10]
    assert not silent


EXAMPLES = [(name, words) for name, _, words in described() if ">>>" in words]


@pytest.mark.parametrize(("name", "words"), EXAMPLES, ids=[name for name, _ in EXAMPLES])
def test_examples_in_the_documentation_do_what_they_say(
    name: str, words: str, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(words, {"uchain": uchain, "np": np}, name, name, 0)
    runner = doctest.DocTestRunner(
        optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    )
    report: list[str] = []
    runner.run(example, out=report.append)
    assert runner.failures == 0, "".join(report)


def test_the_page_on_python_runs_from_top_to_bottom(tmp_path: Any, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    page = (pathlib.Path(__file__).parents[2] / "docs" / "guide" / "python.md").read_text()
    blocks = [block.split("```")[0] for block in page.split("```python\n")[1:]]
    assert len(blocks) >= 5
    names: dict[str, Any] = {"__name__": "page"}
    for number, block in enumerate(blocks):
        exec(compile(block, f"python.md, block {number + 1}", "exec"), names)


def test_control_an_example_that_says_something_else_is_noticed():
    example = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "control", "control", 0)
    runner = doctest.DocTestRunner()
    runner.run(example, out=lambda _: None)
    assert runner.failures == 1
    assert len(EXAMPLES) >= 10
