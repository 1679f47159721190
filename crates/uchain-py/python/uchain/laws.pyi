"""The laws that fly on the drone, one by one."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Centering",
    "Command",
    "Estimates",
    "Explanation",
    "Explorer",
    "Heard",
    "Message",
    "Move",
    "Node",
    "Observation",
    "Packet",
    "ScalarKalman",
    "Target",
    "center",
    "equalize",
]

_Follow = Literal["centre", "left", "right"]

@final
class ScalarKalman:
    def __new__(cls, loss_db: float, **params: float) -> ScalarKalman: ...
    def predict(self, separating_mps: float, period_s: float) -> None: ...
    def update(self, loss_db: float) -> None: ...
    @property
    def loss_db(self) -> float: ...
    @property
    def variance_db2(self) -> float: ...
    @property
    def params(self) -> dict[str, float]: ...
    @classmethod
    def filter(
        cls,
        time_s: NDArray[np.float64],
        loss_db: NDArray[np.float32],
        separating_mps: NDArray[np.float32] | None = None,
        **params: float,
    ) -> dict[str, NDArray[np.float32]]: ...

def equalize(back_loss_db: float, front_loss_db: float, **params: float | str | bool) -> float: ...
@final
class Centering:
    @property
    def lateral_mps(self) -> float: ...
    @property
    def yaw_rate_radps(self) -> float: ...
    @property
    def speed_share(self) -> float: ...

def center(
    nw_m: float,
    ne_m: float,
    sw_m: float,
    se_m: float,
    *,
    tof_range_m: float = 2.0,
    backward: bool = False,
    follow: _Follow = "centre",
    **params: float | str,
) -> Centering: ...
@final
class Heard:
    def __new__(
        cls,
        sender: int,
        loss_db: float,
        *,
        place: int,
        ground_speed_mps: float = 0.0,
        flown_s: float = 0.0,
        follow: _Follow = "centre",
        imbalance_db: float = 0.0,
        is_base: bool = False,
        battery: float | None = None,
    ) -> Heard: ...
    @staticmethod
    def base(loss_db: float) -> Heard: ...
    @property
    def sender(self) -> int: ...
    @property
    def loss_db(self) -> float: ...
    @property
    def place(self) -> int: ...

@final
class Observation:
    def __new__(
        cls,
        *,
        place: int | None = None,
        heard: Sequence[Heard] | None = None,
        tof_m: tuple[float, float, float, float] | None = None,
        ground_speed_mps: float | None = None,
        battery: float | None = None,
        pilot_mps: float | None = None,
        follow: _Follow = "centre",
    ) -> Observation: ...

@final
class Command:
    @property
    def forward_mps(self) -> float: ...
    @property
    def lateral_mps(self) -> float: ...
    @property
    def yaw_rate_radps(self) -> float: ...
    @property
    def airborne(self) -> bool: ...

@final
class Packet:
    @property
    def place(self) -> int: ...
    @property
    def ground_speed_mps(self) -> float: ...
    @property
    def flown_s(self) -> float: ...
    @property
    def follow(self) -> _Follow: ...
    @property
    def imbalance_db(self) -> float: ...
    @property
    def battery(self) -> float | None: ...

@final
class Estimates:
    @property
    def back_db(self) -> float | None: ...
    @property
    def back_raw_db(self) -> float | None: ...
    @property
    def back_silent_s(self) -> float | None: ...
    @property
    def front_db(self) -> float | None: ...
    @property
    def front_raw_db(self) -> float | None: ...
    @property
    def front_silent_s(self) -> float | None: ...
    @property
    def allowed_mps(self) -> float | None: ...

@final
class Explanation:
    @property
    def role(self) -> Literal["head", "relay"]: ...
    @property
    def place(self) -> int | None: ...
    @property
    def stage(self) -> Literal["waiting", "rising", "flying", "other"]: ...
    @property
    def imbalance_db(self) -> float | None: ...
    @property
    def wish_mps(self) -> float: ...
    @property
    def overridden(self) -> str | None: ...
    @property
    def follow(self) -> _Follow: ...
    @property
    def walls(self) -> Literal["both", "left", "right"] | None: ...
    @property
    def speed_share(self) -> float: ...

@final
class Node:
    def __new__(
        cls,
        role: Literal["relay", "head"] = "relay",
        *,
        kalman: Mapping[str, Any] | None = None,
        equalize: Mapping[str, Any] | None = None,
        center: Mapping[str, Any] | None = None,
        takeoff: Mapping[str, Any] | None = None,
        link: Mapping[str, Any] | None = None,
        tof_range_m: float = 2.0,
    ) -> Node: ...
    def decide(self, seen: Observation) -> Command: ...
    def say(self, seen: Observation) -> Packet: ...
    @property
    def estimates(self) -> Estimates: ...
    def explain(self, seen: Observation) -> Explanation | None: ...

@final
class Message:
    @property
    def kind(self) -> Literal["pose", "node", "spent", "target"]: ...
    @property
    def at_m(self) -> tuple[float, float] | None: ...

@final
class Target:
    @property
    def purpose(self) -> Literal["explore", "backtrack", "home", "park", "wait"]: ...
    @property
    def x_m(self) -> float: ...
    @property
    def y_m(self) -> float: ...
    @property
    def level(self) -> int: ...

@final
class Move:
    @property
    def x_m(self) -> float: ...
    @property
    def y_m(self) -> float: ...
    @property
    def heading_rad(self) -> float: ...
    @property
    def level(self) -> int: ...
    @property
    def z_m(self) -> float: ...
    @property
    def scan(self) -> bool: ...
    @property
    def hold(self) -> bool: ...

@final
class Explorer:
    def __new__(cls, robot: int = 0, robots: int = 1, *, seed: int = 0, **params: Any) -> Explorer: ...
    def perceive(
        self,
        x_m: float,
        y_m: float,
        heading_rad: float = 0.0,
        *,
        scan_m: NDArray[np.float32] | None = None,
        arrived: bool = True,
    ) -> list[Message]: ...
    def announce(self) -> tuple[Target, list[Message]]: ...
    def hear(self, messages: Sequence[Message]) -> None: ...
    def resolve(self) -> Move: ...
    @property
    def nodes_m(self) -> NDArray[np.float32]: ...
    @property
    def hubs(self) -> int: ...
