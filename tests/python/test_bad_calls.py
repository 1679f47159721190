"""Whatever is handed to the module, it answers with a value or with an exception that says something: 10,000 bad calls."""

import inspect
import os
import pathlib
import tempfile
import types
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import uchain
import uchain.laws

SHORT = uchain.Scenario.from_name("straight").with_(duration_s=2)
ROOMS = uchain.Scenario.from_name("lab").with_(duration_s=2)


class Angry:
    """Raises whatever is asked of it."""

    def __getattr__(self, name: str) -> Any:
        if name in ("tolist", "__fspath__", "__arrow_c_stream__", "keys", "start", "dtype", "columns"):
            raise RuntimeError(f"asked for {name}")
        raise AttributeError(name)

    def __len__(self) -> int:
        raise RuntimeError("asked for a length")

    def __iter__(self) -> Any:
        raise RuntimeError("asked for items")

    def __float__(self) -> float:
        raise RuntimeError("asked for a number")

    def __index__(self) -> int:
        raise RuntimeError("asked for an index")

    def __call__(self, *_: Any, **__: Any) -> Any:
        raise RuntimeError("called")


class Liar:
    """Says it is what it is not."""

    def __fspath__(self) -> Any:
        return 3

    def tolist(self) -> Any:
        return self

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return "no capsule"

    def __len__(self) -> int:
        return 1 << 62

    def __getitem__(self, key: Any) -> Any:
        return self


def endless() -> list[Any]:
    within: list[Any] = []
    within.append(within)
    return within


ODD_NUMBERS = [0, 1, 2, 3, -1, 7, 255, 65_535, 65_536, 1 << 31, -(1 << 31), 1 << 63, 1 << 64, -(1 << 70)]
ODD_FLOATS = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-40, 1e9, 1e39, 1e308, float("nan"), float("inf"), -float("inf")]
# Nothing here is a path to elsewhere, or the name of a scenario, which would be flown whole.
TEXT = st.text(st.characters(codec="utf-8", exclude_characters="/\\"), max_size=12)
WORDS = st.sampled_from(
    ["", "radio.sigma_db", "duration_s", "chain.uavs", "ticks", "decisions", "none", "all", "relay", "head", "\0"]
)
ARRAYS = st.builds(
    lambda dtype, shape: np.zeros(shape, dtype),
    st.sampled_from(["f4", "f8", "i4", "i8", "u1", "?", "c8", "O", "U3", "M8[s]", ">f4"]),
    st.sampled_from([(), (0,), (1,), (2,), (3,), (18,), (2, 2), (1, 3, 2)]),
)
LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.sampled_from(ODD_NUMBERS),
    st.sampled_from(ODD_FLOATS),
    st.sampled_from([np.float32("nan"), np.float64(2.0), np.int64(3), np.uint8(1), np.bool_(True)]),
    TEXT,
    WORDS,
    st.sampled_from([b"", b"x", 1j, Angry(), Liar(), endless(), object(), int, len, range(3), range(0, 1 << 40)]),
    st.builds(pathlib.Path, st.sampled_from(["absent.toml", "absent.mcap", "absent", ".", "x.png"])),
    st.sampled_from([lambda *_: None, lambda *_: float("nan"), lambda *_: 0.1, lambda: 1]),
    st.builds(lambda: (i for i in [1, 2])),
    ARRAYS,
    st.sampled_from([SHORT, ROOMS]),
)
VALUES = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=3)
    | st.tuples(inner, inner)
    | st.dictionaries(TEXT | WORDS, inner, max_size=3),
    max_leaves=5,
)


def parts_of(run: uchain.Run) -> list[Any]:
    """A run and all that it is made of."""
    parts = [run, run.summary, run.frames, run.frames.tidy(), run.graph, run.plot(), *run.events[:1]]
    return [part for part in parts if part is not None]


def instances() -> list[Any]:
    """One of each thing that has methods."""
    found = [
        SHORT,
        *parts_of(uchain.run(SHORT)),
        *parts_of(uchain.run(ROOMS)),
        uchain.plan("straight", to_m=2, step_m=1),
        uchain.optimum("straight", 2, 1),
        uchain.explain("sigma_db")[0],
        uchain.laws.ScalarKalman(50.0),
        uchain.laws.Node(),
        uchain.laws.Explorer(),
        uchain.laws.Heard.base(50.0),
        uchain.laws.Observation(),
        uchain.ChainEnv(SHORT, worlds=2),
        uchain.ChainEnv(SHORT).reset(),
        uchain.ChainEnv(SHORT).truth(),
        uchain.ChainEnv(SHORT).params,
        uchain.batched(lambda seen: seen.back_db),
        uchain.Progress(1, 0, 2, 0.5),
        uchain.sweep(SHORT, replicates=1, progress=False),
        uchain.sweep(SHORT, replicates=1, progress=False).report(),
    ]
    return found


def callables() -> dict[str, Callable[..., Any]]:
    """Every public thing that can be called, by its name."""
    found: dict[str, Callable[..., Any]] = {}
    for module in (uchain, uchain.laws):
        for name in module.__all__:
            thing = getattr(module, name)
            if isinstance(thing, str | types.ModuleType) or not callable(thing):
                continue
            if inspect.isclass(thing) and issubclass(thing, BaseException):
                continue
            found[f"{module.__name__}.{name}"] = thing
    for thing in instances():
        for name in dir(type(thing)):
            special = ("__getitem__", "__contains__", "__eq__", "__arrow_c_stream__", "__setstate__", "_unpickled")
            if name.startswith("_") and name not in special:
                continue
            # Some have what others have not.
            method = getattr(thing, name, None)
            if callable(method):
                found[f"{type(thing).__name__}().{name}"] = method
    return found


CALLABLES = callables()


def keywords(function: Callable[..., Any]) -> list[str]:
    try:
        return [name for name in inspect.signature(function).parameters if name not in ("values", "params")]
    except (TypeError, ValueError):
        return []


CALLS = st.sampled_from(sorted(CALLABLES)).flatmap(
    lambda name: st.tuples(
        st.just(name),
        st.lists(VALUES, max_size=4),
        st.dictionaries(
            st.sampled_from([*keywords(CALLABLES[name]), "radio.sigma_db", "k_db_per_m", "nonsense"]), VALUES, max_size=3
        ),
    )
)


@pytest.fixture(scope="module", autouse=True)
def elsewhere():
    """Whatever is written is written where nobody looks."""
    before = pathlib.Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        yield
        os.chdir(before)


@settings(
    max_examples=10_000,
    deadline=None,
    database=None,
    derandomize=os.environ.get("CI") == "true",
    suppress_health_check=list(HealthCheck),
)
@given(CALLS)
def test_a_bad_call_ends_in_an_exception_that_says_something(call: tuple[str, list[Any], dict[str, Any]]):
    name, values, named = call
    # Good calls, of a minute.
    if name.endswith("sweep") and repr(named.get("replicates")) in ("65535", "65536"):
        return
    try:
        CALLABLES[name](*values, **named)
    # A panic of Rust is no Exception, and ends the test.
    except Exception as error:
        words = str(error)
        assert len(words) >= 3, f"{name}: {type(error).__name__} says nothing"
        assert "a fault in uchain" not in words and "panicked" not in words, f"{name}: {words}"


def test_control_a_panic_would_be_noticed():
    class Panic(BaseException):
        pass

    def faulty(*_: Any, **__: Any) -> None:
        raise Panic("rust")

    CALLABLES["control"] = faulty
    try:
        with pytest.raises(Panic):
            test_a_bad_call_ends_in_an_exception_that_says_something.hypothesis.inner_test(("control", [], {}))
    finally:
        del CALLABLES["control"]
