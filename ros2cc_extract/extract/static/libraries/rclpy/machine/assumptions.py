"""What is assumed of values that whoever starts a node may set."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.values import assumed_defaults
from ros2cc_extract.extract.static.python.values.values import Mystery

AT_RUN_TIME = 'name of the node at run time'
"""Why the name of a node is open: whoever starts it may give it another one."""


def assumption(fact: str, value: Mystery) -> str:
    """The rule by which ``fact`` is assumed to be the default of ``value``."""
    if value.unknown.reason == AT_RUN_TIME:
        return f'{fact} follows from the name of the node in the source'
    return assumed_defaults.assumption(fact, value)
