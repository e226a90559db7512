"""
Lists of independent jobs: one interface for all that can do them.

Jobs and answers are plain values, and an answer depends on its job alone. So nothing changes with
its giver, or with how often it is begun: what others cannot finish is done here.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from typing import Any, Protocol, TypeVar

from ros2cc_extract.deadline import Deadline
from ros2cc_extract.jobs.process_pool import ProcessPool
from ros2cc_extract.light_dataclasses import dataclass

Job = TypeVar('Job')
Answer = TypeVar('Answer')
Answers = Generator[tuple[int, Answer], None, None]


class Pool(Protocol):
    """What does jobs."""

    @property
    def is_remote(self) -> bool:
        """Whether others do them, which share no memory and no files with this process."""

    @property
    def size(self) -> int:
        """How many jobs are done at once, as far as that is known; 1 where all is done here."""

    def each(
        self,
        work: Callable[[Job], Answer],
        jobs: Sequence[Job],
        until: Deadline | None = None,
    ) -> Answers[Answer]:
        """
        Give each answer with the number of its job, as they come.

        To stop early, close it: nothing is done any more.

        :param until: others are not waited for any longer; ``work`` looks at the clock itself.
        """


@dataclass(frozen=True)
class Processes:
    """
    Forked children of this process.

    They inherit work and jobs, so that only answers are pickled.
    """

    size: int
    is_remote: bool = False

    def each(
        self,
        work: Callable[[Job], Answer],
        jobs: Sequence[Job],
        until: Deadline | None = None,
    ) -> Answers[Answer]:
        """See ``Pool``; all read the clock of this machine."""

        def answer(number: int) -> Answer:
            return work(jobs[number])

        with ProcessPool(answer, min(self.size, len(jobs))) as pool:
            for number, (given, _) in pool.each(range(len(jobs))):
                yield number, given


def in_order(
    pool: Pool,
    work: Callable[[Job], Answer],
    jobs: Sequence[Job],
    done: Callable[[int], Any] = lambda number: None,
) -> list[Answer]:
    """
    All answers in the order of their jobs.

    :param done: called with the number of answers so far.
    """
    found: dict[int, Answer] = {}
    with closing(pool.each(work, jobs)) as answers:
        for number, answer in answers:
            found[number] = answer
            done(len(found))
    return [found[number] for number in range(len(jobs))]
