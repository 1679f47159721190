"""Types of the package `uchain`. A part of it is described where it is defined; `help(uchain)` has the same words."""

from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Any, Literal, final, type_check_only

import numpy as np
from numpy.typing import NDArray
from typing_extensions import disjoint_base

__all__ = [
    "Columns",
    "Event",
    "Graph",
    "Picture",
    "RecordingError",
    "Run",
    "Scenario",
    "ScenarioError",
    "Summary",
    "Tidy",
    "UchainError",
    "__version__",
    "main",
    "run",
    "scenarios",
]

__version__: str

# --- exceptions

class UchainError(Exception): ...
class ScenarioError(UchainError): ...
class RecordingError(UchainError): ...

# --- scenarios

@final
class Scenario:
    @classmethod
    def from_name(cls, name: str) -> Scenario: ...
    @classmethod
    def from_file(cls, path: str | PathLike[str]) -> Scenario: ...
    @classmethod
    def from_toml(cls, text: str, folder: str | PathLike[str] | None = None) -> Scenario: ...
    def with_(self, **values: Any) -> Scenario: ...
    @property
    def name(self) -> str: ...
    @property
    def mission(self) -> str: ...
    @property
    def robots(self) -> int: ...
    @property
    def duration_s(self) -> float: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def toml(self) -> str: ...
    @property
    def overrides(self) -> dict[str, str]: ...
    @property
    def walls_m(self) -> NDArray[np.float32]: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...

def scenarios() -> dict[str, str]: ...

# --- one run

def run(
    what: str | PathLike[str] | Scenario,
    seed: int = 0,
    record: str | PathLike[str] | None = None,
    *,
    frames: Literal["ticks", "decisions"] | None = "ticks",
) -> Run: ...

@disjoint_base
class Run:
    @property
    def scenario(self) -> Scenario: ...
    @property
    def seed(self) -> int: ...
    @property
    def ok(self) -> bool: ...
    @property
    def outcome(self) -> str: ...
    @property
    def verdict(self) -> str: ...
    @property
    def digest(self) -> str: ...
    @property
    def summary(self) -> Summary: ...
    @property
    def frames(self) -> Columns: ...
    @property
    def links(self) -> Columns: ...
    @property
    def rounds(self) -> Columns: ...
    @property
    def tables(self) -> dict[str, Columns]: ...
    @property
    def events(self) -> tuple[Event, ...]: ...
    @property
    def graph(self) -> Graph | None: ...
    def plot(self, path: str | PathLike[str] | None = None) -> Picture: ...

@type_check_only
class _HasAttributes:
    def __getattr__(self, name: str) -> Any: ...

@final
class Summary(_HasAttributes, Mapping[str, Any]):
    def __new__(cls, values: dict[str, Any], /) -> Summary: ...
    def __getitem__(self, key: str, /) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> list[str]: ...  # type: ignore[override]
    def values(self) -> list[Any]: ...  # type: ignore[override]
    def items(self) -> list[tuple[str, Any]]: ...  # type: ignore[override]
    def get(self, key: object, default: Any = None, /) -> Any: ...
    def to_dict(self) -> dict[str, Any]: ...

@final
class Columns(Mapping[str, NDArray[Any]]):
    @property
    def name(self) -> str: ...
    @property
    def rows(self) -> int: ...
    @property
    def words(self) -> dict[str, tuple[str, ...]]: ...
    def __getitem__(self, key: str, /) -> NDArray[Any]: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> list[str]: ...  # type: ignore[override]
    def values(self) -> list[NDArray[Any]]: ...  # type: ignore[override]
    def items(self) -> list[tuple[str, NDArray[Any]]]: ...  # type: ignore[override]
    def get(self, key: object, default: Any = None, /) -> Any: ...
    def tidy(self) -> Tidy: ...

@final
class Tidy:
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...
    def __len__(self) -> int: ...

@final
class Event:
    def __new__(cls, time_s: float, gravity: str, kind: str, robot: int | None, text: str) -> Event: ...
    @property
    def time_s(self) -> float: ...
    @property
    def gravity(self) -> Literal["info", "warning", "error"]: ...
    @property
    def kind(self) -> str: ...
    @property
    def robot(self) -> int | None: ...
    @property
    def text(self) -> str: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...

@final
class Graph:
    @property
    def nodes(self) -> Columns: ...
    @property
    def edges(self) -> NDArray[np.uint32]: ...
    @property
    def lengths_m(self) -> NDArray[np.float32]: ...
    def to_networkx(self) -> Any: ...

@final
class Picture:
    def __new__(cls, png: bytes, /) -> Picture: ...
    @property
    def size_px(self) -> tuple[int, int]: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    def __bytes__(self) -> bytes: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...

# --- what summaries have; for `typing.cast`

@type_check_only
class ChainSummary(Summary):  # type: ignore[misc]
    scenario: str
    seed: int
    sim_s: float
    outcome: str
    verdict: str
    launches_s: list[float]
    uavs: int
    relays_used: int
    relays_needed: int | None
    bottleneck_gap_db: float | None
    links: list[Summary]
    spread_db: float | None
    worst_link_db: float | None
    converged_s: float | None
    wall_contacts: int
    uav_contacts: int
    connected_fraction: float | None
    below_limit_fraction: float | None
    head_reach_m: float
    digest: str
    wall_s: float
    version: str

@type_check_only
class ExploreSummary(Summary):  # type: ignore[misc]
    scenario: str
    seed: int
    strategy: str
    robots: int
    vehicle: str
    outcome: str
    verdict: str
    sim_s: float
    iterations: int
    moves: list[int]
    holds: list[int]
    distance_m: list[float]
    distance_3d_m: list[float]
    mfl_s: float
    coverage: float
    coverage_t50_s: float | None
    coverage_t90_s: float | None
    coverage_t100_s: float | None
    overlap: float
    balance: float | None
    nodes: list[int]
    edges: int
    hubs_left: int
    unseen_m2: float
    unseen_behind_m2: float
    unseen: list[Summary]
    shut_off_m2: float
    wall_contacts: int
    robot_contacts: int
    level_passes: int
    downwash_s: list[float]
    gaps: list[Summary]
    digest: str
    wall_s: float
    version: str

# --- command line

def main(args: list[str] | None = None) -> int: ...
