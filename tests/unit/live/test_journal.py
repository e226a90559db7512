"""The steps kept until they are taken: the same in Python and in C."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2cc_extract.extract.live.recorder.events import BEGIN, END, SIZE, rows
from ros2cc_extract.extract.live.recorder.journal import Journal, PlainJournal, native, new_journal

Make = Callable[[int], Journal]
MAKES = [pytest.param(PlainJournal, id='plain'), pytest.param(native.Journal, id='native')]
STEPS = st.tuples(
    st.integers(-(2**63), 2**63 - 1),
    st.integers(0, 2**64 - 1),
    st.integers(0, 255),
    st.integers(0, 2**32 - 1),
)
DEEDS = st.one_of(
    st.tuples(st.just('put'), STEPS),
    st.tuples(st.just('put many'), st.integers(0, 5000)),
    st.tuples(st.just('take'), st.integers(-1, 3000)),
    st.tuples(st.just('clear'), st.none()),
)


def test_the_native_one_is_there_and_used() -> None:
    assert type(new_journal(1)) is native.Journal


@pytest.mark.parametrize('make', MAKES)
def test_step_is_noted_with_the_clock_and_the_thread(make: Make) -> None:
    journal = make(10)
    before = time.monotonic_ns()
    journal.note(BEGIN, 7)
    thread = threading.Thread(target=journal.note, args=(END, 8))
    thread.start()
    number = thread.ident
    thread.join()
    after = time.monotonic_ns()
    (begin, _), (end, _) = rows(journal.take(10))
    assert (begin[1:], end[1:]) == ((threading.get_ident(), BEGIN, 7), (number, END, 8))
    assert before <= begin[0] <= end[0] <= after


@pytest.mark.parametrize('make', MAKES)
@pytest.mark.parametrize('step', [(1, -1), (1, 2**32), (-1, 1), ('begin', 1), (1,), (1, 2, 3)])
def test_what_is_no_step_is_refused_and_leaves_nothing(make: Make, step: Any) -> None:
    journal = make(10)
    # The kinds differ, and each is an Exception, which is what a wrapper counts.
    with pytest.raises(Exception):  # noqa: B017
        journal.note(*step)
    assert (len(journal), journal.take(10)) == (0, b'')


@given(st.integers(1, 3000), st.lists(DEEDS, max_size=30))
def test_both_keep_and_give_the_same(kept: int, effects: list[tuple[str, Any]]) -> None:
    plain, fast = PlainJournal(kept), native.Journal(kept)
    assert [_done(plain, *effect) for effect in effects] == [
        _done(fast, *effect) for effect in effects
    ]
    assert plain.take(kept) == fast.take(kept)


def _done(journal: Journal, effect: str, given: Any) -> tuple[int, bytes]:
    taken = b''
    if effect == 'put':
        journal.put(*given)
    elif effect == 'put many':
        for number in range(given):
            journal.put(number, 1, BEGIN, number)
    elif effect == 'take':
        taken = journal.take(given)
    else:
        journal.clear()
    return len(journal), taken


@pytest.mark.parametrize('make', MAKES)
def test_threads_lose_no_step_that_there_is_room_for(make: Make) -> None:
    journal, taken = make(100_000), []

    def note_many(number: int) -> None:
        for _ in range(5000):
            journal.note(BEGIN, number)

    threads = [threading.Thread(target=note_many, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        taken.append(journal.take(100))
    taken.append(journal.take(100_000))
    whole = b''.join(taken)
    assert len(whole) == 20_000 * SIZE
    noted = [fields[3] for fields, _ in rows(whole)]
    assert [noted.count(number) for number in range(4)] == [5000] * 4
