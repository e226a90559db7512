"""
What callbacks do to the data of code of which it is not known when it runs.

Functions that code which is not scanned may call, handlers of signals, and threads of the run
before.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.base.wording import called
from ros2cc_extract.findings.races.flag_locks import as_shared, shared_by
from ros2cc_extract.findings.races.races import RaceKind, races_across
from ros2cc_extract.findings.waits.concurrent_threads import (
    is_of_a_loop,
    leaves_behind,
    sharing,
)
from ros2cc_extract.findings.waits.workers import is_one_thread
from ros2cc_extract.spec.effects import BY_CALLBACK
from ros2cc_extract.spec.model import Activity, ActivityKind, Spec

_HARMLESS = (RaceKind.WHOLE_UPDATE, RaceKind.LAST_WRITE_WINS)


def races_with_others(unit: Spec) -> Iterator[str]:
    """
    Say which of them may break something, if the code that has them calls them on another thread.

    That code may as well call them on the thread that runs the callbacks, so it is no finding.
    """
    context = Context(unit)
    threads = (one for one in unit.activities if one.kind is not ActivityKind.PROCESS)
    known = (one for one in threads if one.unresolved is None)
    doers: tuple[Doer, ...] = (*shared_by(context), *known)
    for handed in unit.handed:
        others = [
            doer for doer in doers if not _is_same(handed, doer) and not _take_turns(handed, doer)
        ]
        if is_one_thread(unit.executor) and _is_in_callback(handed):
            others = [doer for doer in others if isinstance(doer, Activity)]
        for race in races_across((handed, doer) for doer in others):
            if race.kind not in _HARMLESS:
                met = {use.doer.name: use.doer for use in (race.first, *race.others)}
                names = [called(each) for each in met.values() if each.name != handed.name]
                yield (f'{_words(handed)} beside {", ".join(names)}, and both use {race.names[0]}')


def _is_same(handed: Activity, doer: Doer) -> bool:
    """Whether it is what is known of it beside: that a web server runs it on a thread."""
    is_code = isinstance(doer, Activity) and doer.function == handed.function
    return is_code and doer.source == handed.source


def races_with_threads_left(unit: Spec) -> Iterator[str]:
    """
    Say where a callback may meet the thread that its run before has started.

    What it does before the start is in order with the thread of this run, not with that one.
    """
    context = Context(unit)
    threads = as_shared(sharing(context), context)
    for callback in shared_by(context):
        left = [each for each in threads if leaves_behind(callback, each)]
        for race in races_across((callback, each) for each in left):
            if race.kind not in _HARMLESS:
                thread = next(u.doer for u in (race.first, *race.others) if u.doer is not callback)
                yield (
                    f'{called(thread)} may still run when {called(callback)} starts it once more, '
                    f'and both use {race.names[0]}'
                )


def _is_in_callback(handed: Activity) -> bool:
    return handed.unresolved is not None and handed.unresolved.reason.endswith(BY_CALLBACK)


def _take_turns(handed: Activity, doer: Doer) -> bool:
    """Coroutines of one loop have its thread between them."""
    if handed.kind is not ActivityKind.POOL or not isinstance(doer, Activity):
        return False
    return doer.kind is ActivityKind.POOL or is_of_a_loop(doer)


def _words(handed: Activity) -> str:
    reason = handed.unresolved.reason if handed.unresolved is not None else 'it is handed on'
    return f'{handed.display_name} may run ({reason})'
