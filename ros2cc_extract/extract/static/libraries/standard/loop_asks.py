"""
What needs a loop of asyncio in its own thread.

Source: CPython 3.12, ``asyncio/events.py`` (``get_running_loop``, ``get_event_loop``).
"""

from __future__ import annotations

import builtins

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import LoopAsk
from ros2cc_extract.extract.static.python.values.values import Call, Handler, Value
from ros2cc_extract.source_locations import Place

ASKED = -1
"""Among the identities of ``World.asked``: whether a loop runs."""


def needing(how: str, handler: Handler, *, is_any: bool = False) -> Handler:
    """
    What raises ``RuntimeError`` where no loop runs in its thread.

    :param is_any: the loop of the main thread is enough, even if nothing runs it.
    """

    def asking(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        _note_ask(machine, how, call.place, is_any=is_any)
        return handler(machine, receiver, call)

    return asking


def _note_ask(machine: ConcurrentMachine, how: str, place: Place, *, is_any: bool) -> None:
    """Note that a callback needs a loop; which thread runs it is found after the run."""
    world = machine.world
    is_other = world.by_loop or ASKED in world.asked or not world.in_callback
    if is_other or world.current is None or any(map(_may_catch, world.caught)):
        return
    if not any(ask.place == place and ask.doer is world.current for ask in world.loop_asks):
        world.loop_asks.append(LoopAsk(how, world.current, place, is_any))


def _may_catch(names: frozenset[str]) -> bool:
    """Whether a handler of these names may catch a ``RuntimeError``."""
    kinds = (getattr(builtins, name, RuntimeError) for name in names)
    return any(isinstance(kind, type) and issubclass(RuntimeError, kind) for kind in kinds)
