"""Progress on a terminal, nothing in a log."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.text_escaping import one_line, raw

if TYPE_CHECKING:
    from rich.progress import Progress as Drawn
    from rich.progress import TaskID

    from ros2cc_extract.checker.api import Progress

SearchProgress = Callable[['Progress'], None]
SECONDS_BETWEEN = 0.1


class Meter:
    """Takes what is done, and shows nothing."""

    def step(self, done: int, total: int) -> None:
        """So many are done, of so many."""

    def search(self, title: str) -> SearchProgress | None:
        """What shows the states of one long search, if it is watched."""
        return None


class Bar(Meter):
    """A line that is drawn again now and then; no thread does, so that others may fork."""

    def __init__(self, drawn: Drawn, task: TaskID, title: str) -> None:
        self._drawn = drawn
        self._task = task
        self._title = title
        self._last = 0.0

    def step(self, done: int, total: int) -> None:
        """Draw how many are done."""
        self._drawn.update(self._task, completed=done, total=total, description=self._title)
        self._draw(done == total)

    def search(self, title: str) -> SearchProgress | None:
        """Draw how far one search is."""

        def show(progress: Progress) -> None:
            states = f'{progress.states:,} states, {progress.seconds:.0f} s'
            self._drawn.update(
                self._task, description=f'{self._title} {one_line(title)}: {states}'
            )
            self._draw(False)

        return show

    def _draw(self, is_end: bool) -> None:
        now = monotonic()
        if is_end or now - self._last >= SECONDS_BETWEEN:
            self._last = now
            self._drawn.refresh()


@contextmanager
def bar(stderr: TextIO, title: str) -> Iterator[Meter]:
    """Show how many of how many are done, when ``stderr`` is a terminal; nothing stays of it."""
    if not stderr.isatty():
        yield Meter()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    columns = (TextColumn('{task.description}', markup=False), BarColumn(), MofNCompleteColumn())
    console = Console(file=raw(stderr))
    with Progress(*columns, console=console, transient=True, auto_refresh=False) as drawn:
        yield Bar(drawn, drawn.add_task(title, total=None), title)


@contextmanager
def search_progress(stderr: TextIO, title: str) -> Iterator[SearchProgress | None]:
    """Show how many states were explored, when ``stderr`` is a terminal."""
    if not stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.markup import escape

    words = f'verifying {escape(one_line(title))}'
    with Console(file=raw(stderr)).status(words) as status:
        yield lambda progress: status.update(
            f'{words}: {progress.states:,} states, {progress.seconds:.0f} s'
        )
