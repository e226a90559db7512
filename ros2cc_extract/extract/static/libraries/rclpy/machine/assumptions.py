"""What is assumed of values that can be set when a node is started."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values import assumed_defaults
from ros2cc_extract.extract.static.python.values.values import Mystery

AT_RUN_TIME = 'name of the node at run time'
"""Why the name of a node is open: the command that starts it may set another one."""


def assumption(fact: str, value: Mystery) -> str:
    """The rule by which ``fact`` is assumed to be the default of ``value``."""
    if value.unknown.reason == AT_RUN_TIME:
        return f'{fact} follows from the name of the node in the source'
    return assumed_defaults.assumption(fact, value)
