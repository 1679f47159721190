"""The laws that fly on the drone, called one by one: for logs of real flights, and for experiments on paper."""

from ._uchain import laws as _laws

Centering = _laws.Centering
Command = _laws.Command
Estimates = _laws.Estimates
Explanation = _laws.Explanation
Explorer = _laws.Explorer
Heard = _laws.Heard
Message = _laws.Message
Move = _laws.Move
Node = _laws.Node
Observation = _laws.Observation
Packet = _laws.Packet
ScalarKalman = _laws.ScalarKalman
Target = _laws.Target
center = _laws.center
equalize = _laws.equalize

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
