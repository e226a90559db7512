"""
Lets one callback at a time go on, from one point of control to the next.

Points are the begin of a callback, and the instructions that the plan names: waits, locks, and
accesses of shared data. A thread at one is held until it is chosen. A thread on its way that
stands still, because it really waits, is no longer waited for; so no thread is held forever, and
what only the schedule keeps back is never taken for a hang.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

from ..steering.director import is_of_program
from .activities import Activity, Asked, Held, function_of, label_of
from .askers import asks_again, is_nested, is_of_pool
from .policies import BEGIN, Policy
from .stillness import Rest, Way

# An entity asked for this long ago is no longer ready: a timer was cancelled, a group closed.
_STALE_S = 0.4
# One that may begin and does not waits for a thread, or its group was closed meanwhile.
_TAKES_UP_S = 0.15
# Nothing is ready any more; what a callback has published has arrived by then.
_EXHAUSTED_S = 0.5


class Control:
    """
    All threads of the process, as far as they come to points of control.

    :param begun: called with each callback of the program that begins.
    :param known: labels of callbacks that may be ready soon.
    :param refuses: one that may not begin yet is refused, and asked for again; else it waits, if
        that holds up no other, and may begin at once if it is not sure to be asked for again.
    :param is_open: all threads go on as without control.
    :param choices: the chosen threads, and where each stood.
    :param choosable: the candidates of each choice.
    :param rounds: after how many choices no thread was on its way any more.
    :param begins: how many callbacks have begun since control was taken.
    :param moved_at: when one has begun or ended last.
    """

    def __init__(
        self,
        begun: Callable[[Any], None] = lambda entity: None,
        known: Iterable[str] = (),
        *,
        refuses: bool = True,
    ) -> None:
        self._report_begun = begun
        self._changed = threading.Condition(threading.Lock())
        self._policy: Policy | None = None
        self.is_closed = False
        self.running: dict[int, Activity] = {}
        self._stacks: dict[int, list[Activity]] = {}
        self._known = set(known)
        self._refuses = refuses
        self.moved_at = time.monotonic()
        self._restart(0.0)

    def _restart(self, gather_s: float) -> None:
        self.choices: list[tuple[str, str]] = []
        self.choosable: list[list[tuple[str, str]]] = []
        self.rounds: list[int] = [0]
        self.begins = 0
        self._runs: dict[str, int] = {}
        self._asked: dict[int, Asked] = {}
        self._granted: tuple[Asked, float] | None = None
        self._held: dict[int, Held] = {}
        self._on_way: Activity | None = None
        self._way, self._rest = Way(), Rest()
        self._last = ''
        self._gather_s = gather_s
        self._once = False
        self.idle_since = time.monotonic()
        self._gathers_since: float | None = None
        self._has_gathered = False

    @property
    def is_open(self) -> bool:
        """Whether all threads go on as they come."""
        return self._policy is None and not self.is_closed

    def take(self, policy: Policy, gather_s: float, *, once: bool = False) -> None:
        """
        Take control: from now on the policy decides.

        :param once: each callback begins but once, and none is chosen before all others are held
            or stand still; so the same choices lead to the same choice again.
        """
        with self._changed:
            self._restart(gather_s)
            self._once = once
            self._policy, self.is_closed = policy, False

    def watch(self) -> None:
        """Take no control, and count anew what begins."""
        with self._changed:
            self._restart(0.0)
            self.is_closed = False

    def hold_all(self) -> None:
        """Let no callback of the program begin, until control is taken or given up."""
        self.is_closed = True

    def let_go(self) -> None:
        """Let all threads go on."""
        with self._changed:
            self._policy, self.is_closed = None, False
            for held in self._held.values():
                held.granted = True
            self._asked.clear()
            self._granted, self._on_way = None, None
            self._changed.notify_all()

    def may_begin(self, entity: Any) -> bool:
        if self.is_open or not is_of_program(entity):
            return True
        if self._policy is None:
            return False
        if not self._refuses and not asks_again():
            return not is_of_pool() or self._wait_to_begin(entity)
        with self._changed:
            return self._asks(entity)

    def _wait_to_begin(self, entity: Any) -> bool:
        with self._changed:
            while self._policy is not None and not self._asks(entity):
                self._changed.wait(0.05)
        return True

    def _asks(self, entity: Any) -> bool:
        """Note that an entity is asked for, and say whether it may begin; the lock is held."""
        if self._granted is None or self._granted[0].entity is not entity:
            if self._once and self._runs.get(label_of(entity)):
                return False
            now = time.monotonic()
            if id(entity) not in self._asked:
                self._asked[id(entity)] = Asked(label_of(entity), entity, now)
            self._asked[id(entity)].last = now
            self._decide()
        return self._granted is not None and self._granted[0].entity is entity

    def begun(self, entity: Any) -> None:
        if not is_of_program(entity):
            return
        with self._changed:
            label = label_of(entity)
            self._runs[label] = self._runs.get(label, 0) + 1
            activity = Activity(f'{label}#{self._runs[label]}', threading.get_ident())
            self._known.add(label)
            self.begins += 1
            self.moved_at = time.monotonic()
            self.running[id(entity)] = activity
            stack = self._stacks.setdefault(threading.get_ident(), [])
            if not is_nested():
                stack.clear()  # a coroutine has given the thread back
            stack.append(activity)
            self._asked.pop(id(entity), None)
            if self._granted is not None and self._granted[0].entity is entity:
                self._granted = None
                self._send(activity)
        self._report_begun(entity)

    def refused(self, entity: Any) -> None:
        with self._changed:
            self._asked.pop(id(entity), None)
            if self._granted is not None and self._granted[0].entity is entity:
                self._granted = None
                self._decide()

    def ended(self, entity: Any) -> None:
        with self._changed:
            activity = self.running.pop(id(entity), None)
            if activity is None:
                return
            self.moved_at = time.monotonic()
            stack = self._stacks.get(threading.get_ident(), [])
            if activity in stack:
                stack.remove(activity)
            if self._on_way is activity:
                # What was below it on the stack goes on with its turn.
                self._on_way = None
                if stack and self._policy is not None:
                    self._send(stack[-1])
                else:
                    self._decide()

    def pause(self, at: str, code: Any) -> None:
        """Hold this thread in a function, where it stands, until it is chosen."""
        if self.is_open or self._policy is None:
            return
        thread = threading.get_ident()
        with self._changed:
            stack = self._stacks.get(thread)
            activity = stack[-1] if stack else Activity(function_of(code), thread)
            held = self._held[thread] = Held(activity, at)
            if self._on_way is not None and self._on_way.thread == thread:
                self._on_way = None
            self._decide()
            while self._policy is not None and not held.granted:
                self._changed.wait(0.2)
            self._held.pop(thread, None)

    def look_at_the_clock(self) -> None:
        """Notice which threads stand still, and decide; call it some hundred times a second."""
        with self._changed:
            if self._policy is None:
                return
            now = time.monotonic()
            if self._granted is not None and now - self._granted[1] > _TAKES_UP_S:
                self._asked.pop(id(self._granted[0].entity), None)
                self._granted = None
            if self._on_way is not None and self._way.stands(self._on_way.thread, now):
                self._on_way = None
            if not self._once or self._rest.is_the_same(self._at_work()):
                self._decide(is_settled=True)

    @property
    def is_over(self) -> bool:
        """Whether the policy has nothing left to decide."""
        policy = self._policy
        return policy is not None and policy.is_over

    @property
    def is_exhausted(self) -> bool:
        """Whether there were no candidates for a while, after the first choice."""
        return bool(self.choices) and time.monotonic() - self.idle_since > _EXHAUSTED_S

    @property
    def is_quiet(self) -> bool:
        """Whether no thread of the program is at work."""
        return not self.running

    def _send(self, activity: Activity) -> None:
        self._on_way, self._way = activity, Way()

    def _at_work(self) -> set[int]:
        """Threads that run a callback and are not held."""
        held = {each.activity.thread for each in self._held.values()}
        return {each.thread for each in self.running.values()} - held

    def _decide(self, *, is_settled: bool = False) -> None:
        """Choose the thread that goes on, unless one is on its way; the lock is held."""
        if self._policy is None or self._on_way is not None or self._granted is not None:
            return
        if self._once and not is_settled:
            return
        now = time.monotonic()
        for number, asked in list(self._asked.items()):
            if now - asked.last > _STALE_S:
                del self._asked[number]
        waiting = [each for each in self._held.values() if not each.granted]
        if not waiting and not self.running and not self._gathered(now):
            return
        asked_for = [self._numbered(each) for each in self._asked.values() if _is_open(each)]
        candidates: list[Held | Asked] = [*waiting, *asked_for]
        candidates.sort(key=lambda each: (each.key, each.at))
        if not candidates:
            return
        self.idle_since = now
        chosen = self._policy.choose(candidates, self._last)
        if chosen is None:
            return
        if not self.running and not waiting and len(self.choices) != self.rounds[-1]:
            self.rounds.append(len(self.choices))
        self.choices.append((chosen.key, chosen.at))
        self.choosable.append([(each.key, each.at) for each in candidates])
        self._last = chosen.key
        if isinstance(chosen, Held):
            chosen.granted = True
            self._send(chosen.activity)
            self._changed.notify_all()
        elif isinstance(chosen, Asked):
            self._granted = chosen, now
            self._changed.notify_all()

    def _gathered(self, now: float) -> bool:
        """Whether all that may be ready soon have been waited for; once when one is first."""
        if not self._asked:
            self._gathers_since, self._has_gathered = None, False
        elif not self._has_gathered:
            self._gathers_since = self._gathers_since or now
            ready = {each.label for each in self._asked.values()}
            late = now - self._gathers_since >= self._gather_s
            self._has_gathered = late or (bool(self._known) and ready >= self._known)
        return self._has_gathered

    def _numbered(self, asked: Asked) -> Asked:
        asked.key = f'{asked.label}#{self._runs.get(asked.label, 0) + 1}'
        asked.at = BEGIN
        return asked


def _is_open(asked: Asked) -> bool:
    try:
        return bool(asked.entity.callback_group.can_execute(asked.entity))
    except Exception:
        return True  # the group itself decides
