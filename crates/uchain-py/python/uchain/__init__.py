"""A swarm simulator in which radio is the sensor that matters.

>>> import uchain
>>> uchain.Scenario.from_name("corner")
<uchain.Scenario corner: chain, 4 UAVs, 120 s>
"""

from ._uchain import (
    Columns,
    Event,
    Graph,
    Picture,
    RecordingError,
    Run,
    Scenario,
    ScenarioError,
    Summary,
    Tidy,
    UchainError,
    __version__,
    main,
    run,
    scenarios,
)

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
