"""
An extraction as the short text that the scanner cases compare whole.

A unit is one block; ``tests/scanner_cases/README.md`` explains the lines. Only what differs
from the plain case is written, so that a case shows its point.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import OUTSIDE, TIME, Access, Act, Blocking, Needs, Waker
from ros2cc_extract.spec.model import Activity, Callback, CallbackGroup, Executor, Spec, When


def rendered(extraction: Extraction) -> str:
    """The whole extraction; ``nothing`` when there is neither a unit nor a diagnostic."""
    lines = [line for unit in extraction.units for line in _unit(unit)]
    lines += [f'{d.severity.value} {d.slug} @{d.place.line}' for d in extraction.diagnostics]
    return '\n'.join(lines) or 'nothing'


def _unit(unit: Spec) -> Iterator[str]:
    entry = f', {unit.entry.partition(":")[2]}' if unit.entry else ''
    yield f'unit {unit.name}: {_executor(unit.executor)}{entry}'
    if unit.nodes != (unit.name,):
        yield f'  nodes {", ".join(unit.nodes)}'
    yield from (f'  {_group(group)}' for group in unit.groups)
    for callback in unit.callbacks:
        yield f'  {_callback(callback, unit)}'
        yield from (f'    {line}' for line in _effects(callback))
    for activity in unit.activities:
        yield f'  {_activity(activity)}'
        yield from (f'    {line}' for line in _effects(activity))
    for fact in unit.unresolved:
        yield f'  ? {fact.subject} {fact.fact}'


def _executor(executor: Executor) -> str:
    if isinstance(executor.kind, Unknown):
        return 'no executor' if executor.spun is None else 'unknown executor'
    threads = str(len(executor.threads))
    if executor.threads_source == 'default_cpu_count':
        threads = 'default'
    words = [f'{executor.kind} x{threads}', executor.spun or 'not spun']
    if executor.name != 'executor':
        words[0] = f'{executor.name}={words[0]}'
    if executor.in_thread:
        words.append('in thread')
    if executor.alternative:
        words.append(_alternative(executor))
    if executor.import_caught:
        words.append('import caught')
    return ' '.join(words) + (' UNRESOLVED' if executor.unresolved else '')


def _group(group: CallbackGroup) -> str:
    words = ['group', group.name, group.type.value]
    words += ['default'] if group.default else []
    words += ['groupless'] if group.groupless else []
    words += [f'library={group.library}'] if group.library else []
    words += [f'class={group.cls}'] if group.cls else []
    words += [_count(group.count)] if group.count != 1 else []
    words += ['UNRESOLVED'] if group.unresolved else []
    return ' '.join(words)


def _callback(callback: Callback, unit: Spec) -> str:
    kind = callback.entity.value if callback.entity else callback.type.value
    words = [kind, callback.name, 'in', callback.group]
    function = (callback.function or '').partition('.')[2]
    if function and function.rpartition('.')[2] != callback.name:
        words.append(f'({function})')
    words += _key(callback)
    if len(unit.nodes) > 1 or isinstance(callback.node, Unknown):
        words.append(f'node={_known(callback.node)}')
    words += _flags(callback)
    return ' '.join(words)


def _key(callback: Callback) -> list[str]:
    words = []
    if callback.key is not None:
        words.append(f'key={_known(callback.key)}')
    if callback.period_s is not None:
        period = callback.period_s
        words.append(f'every {"?" if isinstance(period, Unknown) else f"{period:g}"}')
    return words


def _flags(callback: Callback) -> list[str]:
    words = [
        name
        for name in ('builtin', 'conditional', 'coroutine', 'one_shot', 'destroyed')
        if getattr(callback, name)
    ]
    if callback.alternative:
        words.append(_alternative(callback))
    if callback.count != 1:
        words.append(_count(callback.count))
    if callback.when is not When.START:
        words.append(f'when={callback.when.value}')
    if callback.library:
        words.append(f'library={callback.library}')
    if callback.assumed:
        words.append('ASSUMED')
    if callback.unresolved:
        words.append('UNRESOLVED')
    return words


def _alternative(made: Callback | Executor) -> str:
    return f'alternative@{Place.parse(made.alternative or "").line}.{made.branch}'


def _count(count: int | Unknown) -> str:
    return f'count={_known(count)}'


def _known(value: object) -> str:
    return '?' if isinstance(value, Unknown) else str(value)


def _activity(activity: Activity) -> str:
    words = ['activity', activity.kind.value, activity.name]
    function = (activity.function or '').partition('.')[2]
    words += [f'({function})'] if function and function != activity.name else []
    words += [f'started by {_waker(start)}' for start in activity.starts]
    words += [
        name
        for name in ('conditional', 'daemon', 'loops', 'ends_first')
        if getattr(activity, name)
    ]
    words += [_count(activity.count)] if activity.count != 1 else []
    words += ['UNRESOLVED'] if activity.unresolved else []
    return ' '.join(words)


def _effects(callback: Callback | Activity) -> Iterator[str]:
    for block in callback.blocking:
        yield _blocking(block)
        yield from (f'  {line}' for line in _ends(block))
    for access in callback.reads:
        yield f'reads {_access(access)}'
    for access in callback.writes:
        yield f'writes {_access(access)}'
    for word, acts in (
        ('locks', callback.locks),
        ('publishes', callback.publishes),
        ('changes', callback.changes),
    ):
        yield from (f'{word} {_act(act)}' for act in acts)


def _blocking(block: Blocking) -> str:
    words = ['blocks', block.call]
    if block.on is not None:
        words.append(f'on {_known(block.on)}')
    if block.resource not in (None, block.on):
        words.append(f'through {block.resource}')
    words += [block.needs.value] if block.needs is not Needs.ONCE else []
    words += ['forgets'] if block.forgets else []
    words += [f'initial={block.initial}'] if block.initial else []
    words += ['conditional'] if block.conditional else []
    if block.seconds is not None:
        words.append(f'{_known(block.seconds)} s')
    if block.times != 1:
        words.append(f'{block.times} times')
    if block.held:
        words.append(f'holding {", ".join(block.held)}')
    if block.assumed:
        words.append('assumed')
    if block.only_if:
        words.append(f'only if {block.only_if.partition(",")[0]}')
    return ' '.join(words) + _trail(block.source, block.chain)


def _ends(block: Blocking) -> Iterator[str]:
    """Who ends it; left out where that is time, or what it is said to be on."""
    for waker in block.wakers:
        if waker.source is not None or waker.by not in (TIME, OUTSIDE, block.on):
            yield f'ended by {_waker(waker)}'
    if block.escapes is not None:
        yield 'ended by ?'


def _waker(waker: Waker) -> str:
    words = [waker.by]
    words += [f'after {waker.after}'] if waker.after else []
    words += ['conditional'] if waker.conditional else []
    words += [f'holding {", ".join(waker.held)}'] if waker.held else []
    return ' '.join(words) + _trail(waker.source, ())


def _access(access: Access) -> str:
    update = (' update' if access.update else '') + (' in_place' if access.in_place else '')
    update += ' keeps_size' if access.keeps_size else ''
    update += f' iterates {access.iterates}' if access.iterates else ''
    update += f' item {access.item}' if access.item else ''
    update += (' rests' if access.rests else '') + (' clears' if access.clears else '')
    update += ' constant' if access.constant else ''
    update += ' compared' if access.compared else ''
    update += ' admits' if access.admits else ''
    update += ' later' if access.later else ''
    locks = f' under {", ".join(access.locks)}' if access.locks else ''
    return f'{access.name}{update}{locks}{_trail(access.source, access.chain)}'


def _act(act: Act) -> str:
    held = f' holding {", ".join(act.held)}' if act.held else ''
    held += ' tries' if act.tries else ''
    held += f' after {act.after}' if act.after else ''
    held += ' conditional' if act.conditional else ''
    return f'{_known(act.name)}{held}{_trail(act.source, act.chain)}'


def _trail(source: Place | None, chain: tuple[Place, ...]) -> str:
    places = [*chain, *([source] if source else [])]
    return f' @{">".join(str(place.line) for place in places)}' if places else ''
