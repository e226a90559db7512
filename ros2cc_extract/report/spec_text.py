"""Summary of a unit: executor, groups and callbacks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rich.console import Console

from ros2cc_extract.places import Unknown
from ros2cc_extract.report.style import table
from ros2cc_extract.spec.model import Callback, CallbackGroup, Executor, Spec, When


def print_spec(spec: Spec, console: Console) -> None:
    """Print the summary of one unit."""
    console.print(f'unit {spec.name}: {describe_executor(spec.executor)}', style='bold')
    if spec.entry:
        console.print(f'  entry: {spec.entry}')
    _print_groups(spec, console)
    _print_callbacks(spec, console)


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


def _threads_source(executor: Executor) -> str:
    if executor.threads_source == 'default_cpu_count':
        return ' assumed (default: the number of CPUs at run time)'
    return f' ({executor.threads_source})' if executor.threads_source else ''


def _print_groups(spec: Spec, console: Console) -> None:
    rows = table('  group', 'type', 'members')
    for group in spec.groups:
        members = [c.name for c in spec.callbacks if c.group == group.name and not c.builtin]
        rows.add_row(f'  {group.name}', _group_type(group), ', '.join(members) or '-')
    console.print(rows)


def _group_type(group: CallbackGroup) -> str:
    if group.groupless:
        return 'in no group'
    remarks = [
        *(['default'] if group.default else []),
        *(['unresolved'] if group.unresolved else []),
        *([group.library] if group.library else []),
    ]
    remark = f' ({", ".join(remarks)})' if remarks else ''
    return f'{group.type.value}{remark}'


def _print_callbacks(spec: Spec, console: Console) -> None:
    rows = table('  callback', 'type', 'group', 'on', 'created at', 'remarks')
    for callback in spec.callbacks:
        rows.add_row(
            f'  {callback.name}',
            callback.entity.value if callback.entity else callback.type.value,
            '-' if callback.groupless else callback.group,
            _subject(callback),
            str(callback.source or '-'),
            ', '.join(_remarks(callback)),
        )
    console.print(rows)


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
