"""Names of callbacks and groups in sentences, the same in every rule."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, CallbackGroup, Executor


def listing(names: Iterable[str], limit: int = 6) -> str:
    """Join names in their order; many are cut with their number."""
    distinct = list(dict.fromkeys(names))
    if len(distinct) <= limit:
        return ', '.join(distinct)
    return f'{", ".join(distinct[:limit])} and {len(distinct) - limit} more'


def shown(doers: Iterable[Callback | Activity]) -> str:
    """List callbacks by the names of their functions, and threads."""
    return listing(map(called, doers))


def called(doer: Callback | Activity) -> str:
    """A callback by its function; a thread by its name, and its function where that differs."""
    if isinstance(doer, Callback) or doer.kind is ActivityKind.MAIN:
        return doer.display_name
    kind, function = _THREADS.get(doer.kind, 'thread'), doer.display_name
    if function.rpartition('.')[2] == doer.name:
        return f'{kind} {function}'
    return f'{kind} {doer.name} ({function})'


_THREADS = {ActivityKind.TIMER: 'timer thread', ActivityKind.POOL: 'pool thread'}


def plural(number: int, noun: str) -> str:
    """Write ``1 thread``, ``2 threads``."""
    return f'{number} {noun}{"" if number == 1 else "s"}'


def made_at(*owners: Callback | CallbackGroup | Activity) -> Iterator[Remark]:
    """Where callbacks and groups were created, and threads started, whose place is known."""
    for owner in owners:
        if isinstance(owner, Activity):
            if owner.source is not None and owner.kind is not ActivityKind.MAIN:
                yield Remark(owner.source, f'{called(owner)} is started here')
        elif owner.source is not None:
            words = _made_words(owner)
            yield Remark(owner.source, f'{words} is created here')


def served_at(executor: Executor, place: Place) -> Iterator[Remark]:
    """Where the executor is spun, if in another file: a class may run under several programs."""
    source = executor.source
    if source is not None and source.file != place.file:
        yield Remark(source, f'the {executor.kind or "executor"} of this run is here')


def _made_words(owner: Callback | CallbackGroup) -> str:
    if isinstance(owner, CallbackGroup):
        return owner.display_name
    kind = owner.entity.value.replace('_', ' ') if owner.entity else owner.type.value
    name = f' {owner.key!r}' if isinstance(owner.key, str) else ''
    owned = '' if owner.display_name == kind else f' of {owner.display_name}'
    return f'{kind}{name or owned}'
