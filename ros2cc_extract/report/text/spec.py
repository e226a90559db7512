"""Summary of a unit: its executor, and under each group the callbacks that share it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rich.console import Console
from rich.padding import Padding

from ros2cc_extract.report.text.style import table
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    Executor,
    GroupType,
    Spec,
    When,
)


def print_spec(spec: Spec, console: Console) -> None:
    """Print the summary of one unit."""
    console.print(f'unit {spec.name}: {describe_executor(spec.executor)}', style='bold')
    if spec.entry:
        console.print(f'  entry {spec.entry}, nodes {", ".join(spec.nodes)}')
    for group in spec.groups:
        members = [callback for callback in spec.callbacks if callback.group == group.name]
        if members:
            console.print(f'  {describe_group(group)}')
            _print_members(members, console)


def describe_executor(executor: Executor) -> str:
    """Say kind, thread count and where they come from, on one line."""
    number = len(executor.threads)
    threads = f'{number} thread{"s" if number != 1 else ""}'
    if isinstance(executor.kind, Unknown):
        return f'no executor found ({executor.kind}), {threads} assumed'
    source = _threads_source(executor)
    spun = f', {executor.spun}' if executor.spun else ''
    thread = ', in a thread of its own' if executor.in_thread else ''
    return f'{executor.kind or "executor"}, {threads}{source}{spun}{thread}'


def describe_group(group: CallbackGroup) -> str:
    """Say name and type, and what is special about a group, on one line."""
    if group.groupless:
        return 'in no group, not held back by any:'
    kind = 'mutually exclusive' if group.type is GroupType.EXCLUSIVE else 'reentrant'
    remarks = [
        *([f'default group of {group.node}'] if group.default else []),
        *([f'not resolved: {group.unresolved.reason}'] if group.unresolved else []),
        *([f'made by {group.library}'] if group.library else []),
        *([short(group.source)] if group.source else []),
    ]
    return ', '.join([f'group {group.name}: {kind}', *remarks])


def short(place: Place) -> str:
    """Write a place by the last part of its path; findings give the whole path."""
    name = place.file.rpartition('/')[2]
    return f'{name}:{place.line}' if place.line else name


def _threads_source(executor: Executor) -> str:
    if executor.threads_source == 'default_cpu_count':
        return ' assumed (default: the number of CPUs at run time)'
    if not executor.threads_source:
        return ''
    return f' ({short(Place.parse(executor.threads_source))})'


def _print_members(members: Iterable[Callback], console: Console) -> None:
    rows = table('', '', '', '', '')
    rows.show_header = False
    for callback in members:
        rows.add_row(
            callback.entity.value.replace('_', ' ') if callback.entity else callback.type.value,
            callback.name,
            _subject(callback),
            short(callback.source) if callback.source else '-',
            ', '.join(_remarks(callback)),
        )
    console.print(Padding(rows, (0, 0, 0, 4)))


def _subject(callback: Callback) -> str:
    value = callback.period_s if callback.period_s is not None else callback.key
    if value is None:
        return '-'
    if isinstance(value, Unknown):
        return 'every ? s' if callback.key is None else '?'
    return f'every {value:g} s' if isinstance(value, float) else value


def _remarks(callback: Callback) -> Iterator[str]:
    flags: Iterable[tuple[bool, str]] = (
        (callback.when is not When.START, f'created {_WHEN[callback.when]}'),
        (callback.conditional, 'conditional'),
        (callback.alternative is not None, f'alternative {callback.alternative}'),
        (isinstance(callback.count, Unknown), 'unknown number of times'),
        (callback.coroutine, 'coroutine'),
        (callback.one_shot, 'one-shot'),
        (callback.destroyed, 'destroyed later'),
        (callback.library is not None, f'made by {callback.library}'),
        (callback.builtin, 'built-in'),
        (callback.unresolved is not None, 'not resolved'),
    )
    yield from (text for holds, text in flags if holds)
    yield from dict.fromkeys(f'blocks: {block.call}' for block in callback.blocking)


_WHEN = {
    When.START: 'at start',
    When.LATER: 'later',
    When.CALLBACK: 'in a callback',
    When.CONFIGURE: 'on configure',
}
