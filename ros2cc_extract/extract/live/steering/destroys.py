"""
Hold the destruction of an entity until it is in use: a spin reads it, or a call waits for it.

A thread may stand still at each of these places by itself; only how long it does is forced. In
``executors.py`` (rclpy 3.3 to 9.1, `_wait_for_ready_callbacks`) a spin reads `handle`, a property,
of each entity; between it and the next instruction another thread may destroy that entity.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import functools
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from .director import Director
from .report import Report

# What is destroyed, where: `Node.destroy_client`, and the class that has a `handle`.
_DESTROYED = ('subscription', 'timer', 'client', 'service', 'publisher')
HELD_S = 1.5
# Meanwhile others use what was destroyed, and has no successor yet.
AFTERWARDS_S = 0.5
_MOST_TRIES = 16
_POLL_S = 0.005
BY_SPIN, BY_CALL = 'spin', 'call'


class Destroys:
    """
    :param director: knows the points: only what is destroyed there is held.
    """

    def __init__(self, director: Director, report: Report) -> None:
        self._director = director
        self._report = report
        self._changed = threading.Condition(threading.Lock())
        self._entity: Any = None
        self._tries = 0
        self._reads = 0
        self._is_met = False

    def wrap(self) -> None:
        """Wrap the class of nodes, and where a spin reads also what it reads."""
        modules = sys.modules
        node = modules['rclpy.node'].Node
        for kind in _DESTROYED:
            self._wrap_destroy(node, f'destroy_{kind}')
        if self._director.plan.destroys == BY_SPIN:
            for kind in _DESTROYED[:-1]:
                module = modules.get(f'rclpy.{kind}')
                self._wrap_handle(getattr(module, kind.capitalize(), None))

    def _wrap_destroy(self, node: Any, name: str) -> None:
        original = getattr(node, name, None)
        if original is None:
            return

        @functools.wraps(original)
        def destroy(this: Any, entity: Any, *args: Any, **named: Any) -> Any:
            if not self._is_meant():
                return original(this, entity, *args, **named)
            self._hold(entity)
            try:
                return original(this, entity, *args, **named)
            finally:
                self._let_go(entity)

        setattr(node, name, destroy)

    def _is_meant(self) -> bool:
        if self._tries >= _MOST_TRIES or not self._director.plan.destroys:
            return False
        found = self._director.point_of(sys._getframe(2))
        return found is not None and found[0] == 0

    def _hold(self, entity: Any) -> None:
        self._tries += 1
        if self._director.plan.destroys == BY_SPIN:
            with self._changed:
                # Which of its reads another thread can spoil depends on the release.
                self._entity, self._is_met = entity, False
                self._reads = 1 + self._tries % 2
                self._changed.wait_for(lambda: self._is_met, HELD_S)
            return
        until = time.monotonic() + HELD_S
        pending = getattr(entity, '_pending_requests', None)
        while pending is not None and not pending and time.monotonic() < until:
            time.sleep(_POLL_S)

    def _let_go(self, entity: Any) -> None:
        with self._changed:
            self._entity = None
            self._changed.notify_all()
        self._report.write('destroyed', name=type(entity).__name__, thread=threading.get_ident())
        if self._director.plan.destroys == BY_CALL:
            time.sleep(AFTERWARDS_S)

    def _wrap_handle(self, kind: Any) -> None:
        held = vars(kind).get('handle') if kind is not None else None
        if not isinstance(held, property) or held.fget is None:
            return
        read: Callable[[Any], Any] = held.fget

        def handle(this: Any) -> Any:
            if this is self._entity:
                self._meet(sys._getframe(1).f_globals.get('__name__'))
            return read(this)

        kind.handle = property(handle, held.fset, held.fdel, held.__doc__)

    def _meet(self, reader: object) -> None:
        """A spin is about to read what another thread is about to destroy: that one is first."""
        if reader != 'rclpy.executors':
            return
        with self._changed:
            self._reads -= 1
            if self._reads == 0 and not self._is_met:
                self._is_met = True
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._entity is None, HELD_S)
