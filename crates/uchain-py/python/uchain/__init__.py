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
    Progress,
    RecordingError,
    Report,
    Run,
    Scenario,
    ScenarioError,
    Summary,
    SweepError,
    Table,
    Tidy,
    UchainError,
    __version__,
    concat,
    main,
    open_sweep,
    run,
    scenarios,
    sweep,
)

__all__ = [
    "Columns",
    "Event",
    "Graph",
    "Picture",
    "Progress",
    "RecordingError",
    "Report",
    "Run",
    "Scenario",
    "ScenarioError",
    "Summary",
    "SweepError",
    "Table",
    "Tidy",
    "UchainError",
    "__version__",
    "concat",
    "main",
    "open_sweep",
    "run",
    "scenarios",
    "sweep",
]
