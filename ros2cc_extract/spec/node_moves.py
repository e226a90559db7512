"""Where a callback moves its node: nested spins that name the executor which is to spin."""

from __future__ import annotations

from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Callback

ADDED = '.add_node'
"""How the name of such a change ends, after the kind of an executor that only has this node."""

ANY_EXECUTOR = 'executor'


def named_executor(spin: Blocking, callback: Callback) -> str | None:
    """
    Kind of the executor to which ``spin`` moves the node; ``None`` for the global one.

    It is ``ANY_EXECUTOR`` for one that has other nodes, or threads of its own.
    """
    at = spin.source, spin.chain
    names = (str(act.name) for act in callback.changes if (act.source, act.chain) == at)
    return next((name.removesuffix(ADDED) for name in names if name.endswith(ADDED)), None)
