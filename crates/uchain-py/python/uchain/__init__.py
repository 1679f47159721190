"""A swarm simulator in which radio is the sensor that matters.

>>> import uchain
>>> uchain.Scenario.from_name("corner")
<uchain.Scenario corner: chain, 4 UAVs, 120 s>
"""

from ._uchain import Scenario, ScenarioError, UchainError, __version__, main, scenarios

__all__ = [
    "Scenario",
    "ScenarioError",
    "UchainError",
    "__version__",
    "main",
    "scenarios",
]
