"""A swarm simulator in which radio is the sensor that matters."""

from ._uchain import ScenarioError, Scenario, UchainError, __version__, scenarios

__all__ = ["Scenario", "ScenarioError", "UchainError", "__version__", "scenarios"]
