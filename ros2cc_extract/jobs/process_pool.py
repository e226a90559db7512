"""
Work on all cores: forked children that inherit everything and send small results back.

A child answers requests in its own copy of the process, so nothing but requests and answers
is ever pickled. What a child cannot finish is done by the parent, where it fails as it would
have failed without children.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Generic, TypeVar, cast

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.context import ForkProcess

Request = TypeVar('Request')
Answer = TypeVar('Answer')
Done = Callable[[int], None]
Prctl = Callable[[int, int], int]
_PR_SET_PDEATHSIG = 1
_is_child = False


def usable_cores(wanted: int | None = None) -> int:
    """
    How many processes may share the work; one where a fork is not possible or not safe.

    One in a child too: its parent has all cores at work.

    :param wanted: as the user says; by default all cores this process may use.
    """
    alone = threading.active_count() == 1
    if _is_child or not alone or sys.platform != 'linux' or not hasattr(os, 'fork'):
        return 1
    return wanted or len(os.sched_getaffinity(0))


class ProcessPool(Generic[Request, Answer]):
    """
    Children that answer requests; use as a context manager.

    :param answer: runs in a child, or here if there is none.
    :param size: number of children; none are made for one.
    """

    def __init__(self, answer: Callable[[Request], Answer], size: int) -> None:
        self._answer = answer
        self._children: list[ForkProcess] = []
        self._lines: list[Connection | None] = []
        self.size = size

    def __enter__(self) -> ProcessPool[Request, Answer]:
        if self.size > 1:
            with _no_interrupts():
                self._start_children()
        return self

    def _start_children(self) -> None:
        prctl = _prctl()
        try:
            for _ in range(self.size):
                self._start_child(prctl)
        except OSError:  # no more processes, descriptors or memory: those that are there do it
            self.size = len(self._children)
        if self.size == 1:
            self._end()
        if self.size < 2:
            self._children, self._lines, self.size = [], [], 1

    def __exit__(self, *_: object) -> None:
        try:
            self._end()
        except KeyboardInterrupt:  # a second Ctrl-C, before any more are kept out
            self._end()
            raise

    def _end(self) -> None:
        with _no_interrupts():
            for line in self._lines:
                if line is not None:
                    line.close()
            while self._children:
                child = self._children[-1]
                child.kill()
                child.join()
                child.close()
                self._children.pop()

    def ask(
        self,
        requests: Sequence[Request],
        by: Sequence[int | None] | None = None,
        done: Done = lambda number: None,
    ) -> list[tuple[Answer, int | None]]:
        """
        Answer ``requests``, each by the child named in ``by`` or by any that is free.

        :param done: called with the number of each request that is answered.
        :return: answers in the order of the requests, and which child gave them.
        """
        found: dict[int, tuple[Answer, int | None]] = {}
        for number, given in self.each(requests, by):
            found[number] = given
            done(number)
        return [found[number] for number in range(len(requests))]

    def each(
        self, requests: Sequence[Request], by: Sequence[int | None] | None = None
    ) -> Iterator[tuple[int, tuple[Answer, int | None]]]:
        """Like ``ask``, one answer after the other with the number of its request."""
        answered = set()
        for number, given in self._answers(requests, by or [None] * len(requests)):
            answered.add(number)
            yield number, given
        for number, request in enumerate(requests):
            if number not in answered:
                yield number, (self._answer(request), None)

    def _answers(
        self, requests: Sequence[Request], by: Sequence[int | None]
    ) -> Iterator[tuple[int, tuple[Answer, int]]]:
        if not self._lines:  # nothing to wait for, perhaps because there are no processes here
            return
        from multiprocessing.connection import wait

        own = [deque(n for n, who in enumerate(by) if who == i) for i in range(self.size)]
        common = deque(number for number, who in enumerate(by) if who is None)
        busy: dict[Any, tuple[int, int]] = {}
        for child in range(len(self._lines)):
            self._next(child, own, common, requests, busy)
        while busy:
            for line in wait(list(busy)):
                number, child = busy.pop(line)
                answer = self._received(child)
                if answer is not None:
                    yield number, (answer[0], child)
                self._next(child, own, common, requests, busy)

    def _next(
        self,
        child: int,
        own: list[deque[int]],
        common: deque[int],
        requests: Sequence[Request],
        busy: dict[Any, tuple[int, int]],
    ) -> None:
        """Give ``child`` its next request, if it lives and there is one."""
        line = self._lines[child]
        queue = own[child] or common
        if line is None or not queue:
            return
        number = queue.popleft()
        try:
            line.send(requests[number])
        except OSError:
            self._lines[child] = None
            return
        busy[line] = number, child

    def _received(self, child: int) -> tuple[Answer] | None:
        """The answer of ``child``; ``None`` when it could not give one."""
        line = self._lines[child]
        assert line is not None, 'only asked of children that are busy'
        try:
            answer: tuple[Answer] | None = pickle.loads(line.recv_bytes())
        except (EOFError, OSError):
            self._lines[child] = None
            return None
        return answer

    def _start_child(self, prctl: Prctl | None) -> None:
        import multiprocessing

        context = multiprocessing.get_context('fork')
        here, there = context.Pipe()
        of_parent = [line for line in (*self._lines, here) if line is not None]
        work = (there, of_parent, self._answer, (prctl, os.getpid()))
        child = context.Process(target=_serve, args=work, daemon=True)
        try:
            child.start()
        except OSError:
            here.close()
            raise
        finally:
            there.close()
        self._children.append(child)
        self._lines.append(here)


def _serve(
    line: Connection,
    of_parent: Sequence[Connection],
    answer: Callable[[Request], Answer],
    parent: tuple[Prctl | None, int],
) -> None:
    """
    Answer until the parent hangs up, or is no more; an interrupt is the parent's to handle.

    :param of_parent: the parent's ends of all lines: a line stays open while a child holds one.
    """
    global _is_child
    _is_child = True
    end_with_parent(*parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    for each in of_parent:
        each.close()
    while True:
        try:
            line.send_bytes(_packed(answer, line.recv()))
        except (EOFError, OSError):
            return


def end_with_parent(prctl: Prctl | None, parent: int) -> None:
    """Have the system end this process, which ``parent`` has just forked, when that one ends."""
    if prctl is not None:
        prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # it has ended before
            os._exit(0)


def ends_with_us() -> Callable[[], None]:
    """For ``preexec_fn`` of ``subprocess``: the program ends when this process does."""
    prctl, parent = _prctl(), os.getpid()
    return lambda: end_with_parent(prctl, parent)


def _prctl() -> Prctl | None:
    """The system call of Linux that controls a process; see ``prctl(2)``."""
    try:
        import ctypes

        return cast(Prctl, ctypes.CDLL(None).prctl)
    except (ImportError, OSError, AttributeError):
        return None


def _packed(answer: Callable[[Request], Answer], request: Request) -> bytes:
    """The pickled answer; ``None`` if there is none here for any reason."""
    try:
        return pickle.dumps((answer(request),), pickle.HIGHEST_PROTOCOL)
    except Exception:  # the parent tries again, and fails as it would have without children
        return pickle.dumps(None)


@contextmanager
def _no_interrupts() -> Iterator[None]:
    """Ctrl-C waits: no child is left half started, or behind."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
