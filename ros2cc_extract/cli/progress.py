"""Progress on a terminal, nothing in a log."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from ros2cc_extract.checker.api import Progress

ScanProgress = Callable[[int, int], None]
SearchProgress = Callable[['Progress'], None]


@contextmanager
def scan_progress(stderr: TextIO) -> Iterator[ScanProgress | None]:
    """Show how many files were read, when ``stderr`` is a terminal."""
    if not stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(file=stderr), transient=True) as bar:
        task = bar.add_task('reading', total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


@contextmanager
def search_progress(stderr: TextIO, title: str) -> Iterator[SearchProgress | None]:
    """Show how many states were explored, when ``stderr`` is a terminal."""
    if not stderr.isatty():
        yield None
        return
    from rich.console import Console

    with Console(file=stderr).status(f'verifying {title}') as status:
        yield lambda progress: status.update(
            f'verifying {title}: {progress.states:,} states, {progress.seconds:.0f} s'
        )
