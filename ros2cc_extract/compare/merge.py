"""
Compares two specifications of one program, and merges them: usually static and live.

``Unknown`` gives way to what is known; two known facts that differ are a difference with both
places. A live run that did not see an entity proves nothing: what the other side marks as made
under a condition, later or in a callback may be missing without being wrong.
"""

from __future__ import annotations

from collections.abc import Callable as Function
from collections.abc import Container, Iterator, Sequence
from dataclasses import replace
from enum import Enum
from typing import TypeVar

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import (
    Callback,
    EntityKind,
    Executor,
    Origin,
    Spec,
    When,
    collect_unresolved,
)

DEFAULT_COUNT = 'default_cpu_count'
NOT_KNOWN = 'not known'
"""What stands for a name that one side could not find out."""
_FLOAT_ERROR_NS = 1e-3
Fact = TypeVar('Fact')


class Kind(Enum):
    """What sort of difference."""

    ONLY_LEFT = 'only left'
    ONLY_RIGHT = 'only right'
    DIFFERS = 'differs'
    NOT_KNOWN = 'not known on one side'


@dataclass(frozen=True, kw_only=True)
class Difference:
    """
    One difference between two specifications.

    :param subject: the unit, callback, group or executor it is about.
    :param marked: one side said that this may happen; such a difference is no fault.
    """

    kind: Kind
    unit: str
    subject: str
    fact: str
    left: str = ''
    right: str = ''
    left_place: Place | None = None
    right_place: Place | None = None
    marked: bool = False


Pair = tuple[Callback, Callback]


@dataclass(frozen=True)
class Matching:
    """
    Which callbacks of two units are the same one.

    :param more: those on the right, by identity, that the left has without knowing how many.
    """

    pairs: tuple[Pair, ...]
    only_left: tuple[Callback, ...]
    only_right: tuple[Callback, ...]
    more: frozenset[int] = frozenset()


def diff(left: Sequence[Spec], right: Sequence[Spec]) -> tuple[Difference, ...]:
    """List all differences, unit by unit, in the order of ``left``."""
    pairs, only_left, only_right = match_units(left, right)
    found = [difference for pair in pairs for difference in diff_units(*pair)]
    found += [_missing_unit(unit, Kind.ONLY_LEFT) for unit in only_left]
    found += [_missing_unit(unit, Kind.ONLY_RIGHT) for unit in only_right]
    return tuple(found)


def diff_units(left: Spec, right: Spec) -> Iterator[Difference]:
    """List the differences of two units that serve the same nodes, maybe under another name."""
    if _new_names(left, right):
        yield Difference(
            kind=Kind.DIFFERS,
            unit=left.name,
            subject=left.name,
            fact='node',
            left=', '.join(left.nodes),
            right=', '.join(right.nodes),
            marked=True,
        )
    yield from _diff_executors(left, right)
    matching = match_callbacks(left, right)
    for mine, theirs in matching.pairs:
        yield from _diff_facts(left.name, mine, theirs)
    yield from _diff_groups(left, right, matching.pairs)
    for callback in matching.only_left:
        yield _missing(left.name, callback, Kind.ONLY_LEFT)
    for callback in matching.only_right:
        missing = _missing(left.name, callback, Kind.ONLY_RIGHT)
        yield replace(missing, marked=missing.marked or id(callback) in matching.more)


def merge_units(static: Spec, live: Spec) -> Spec:
    """
    Join two units: what ``static`` does not know is taken from ``live``.

    Callbacks that only the live run holds are added with their groups; names stay unique.
    """
    matching = match_callbacks(static, live)
    known = {id(mine): _filled(mine, theirs) for mine, theirs in matching.pairs}
    callbacks = [known.get(id(callback), callback) for callback in static.callbacks]
    groups = {group.name: group for group in static.groups}
    new_groups = _group_names(static, live, matching.pairs)
    for callback in matching.only_right:
        group = live.group_of(callback)
        name = new_groups.setdefault(group.name, _free(group.name, groups))
        groups.setdefault(name, replace(group, name=name))
        taken = {*groups, *(known_callback.name for known_callback in callbacks)}
        callbacks.append(replace(callback, name=_free(callback.name, taken), group=name))
    merged = replace(
        static,
        origin=Origin.MERGED,
        rclpy=live.rclpy or static.rclpy,
        callbacks=tuple(callbacks),
        groups=tuple(groups.values()),
        executor=_filled_executor(static.executor, live.executor),
    )
    return replace(merged, unresolved=collect_unresolved(merged))


def match_units(
    left: Sequence[Spec], right: Sequence[Spec]
) -> tuple[list[tuple[Spec, Spec]], list[Spec], list[Spec]]:
    """
    Pair units by the nodes they share, most shared first; names decide between equals.

    A node may be started under another name than its source gives it: what is left over is
    paired by its functions.
    """
    rest_left, rest_right = list(left), list(right)
    ranked = sorted(
        ((_likeness(a, b), -i, -j) for i, a in enumerate(left) for j, b in enumerate(right)),
        reverse=True,
    )
    pairs = []
    for likeness, minus_i, minus_j in ranked:
        a, b = left[-minus_i], right[-minus_j]
        if any(likeness) and a in rest_left and b in rest_right:
            pairs.append((a, b))
            rest_left.remove(a)
            rest_right.remove(b)
    pairs.sort(key=lambda pair: left.index(pair[0]))
    return pairs, rest_left, rest_right


def _likeness(left: Spec, right: Spec) -> tuple[int, int, int, int]:
    """Of two programs that call their nodes alike, that with the same lines is the one."""
    shared = len(_node_names(left) & _node_names(right))
    renamed = len(_new_names(left, right))
    is_called_alike = int(left.name == right.name)
    may_be_one = shared or renamed or is_called_alike
    lines = len(_lines(left) & _lines(right)) if may_be_one else 0
    return shared, renamed, lines, is_called_alike


def _new_names(left: Spec, right: Spec) -> dict[str, str]:
    """
    Name of a node on the right to its name on the left, if only the name is another.

    Several may be one on the left if that does not know how many it makes.
    """
    mine, theirs = _node_names(left), _node_names(right)
    if mine & theirs:
        return {}
    names: dict[str, str] = {}
    for name in theirs:
        there = _functions(right, name)
        fitting = [each for each in mine if _are_alike(_functions(left, each), there)]
        if len(fitting) != 1:
            return {}
        names[name] = fitting[0]
    for name in mine:
        times = list(names.values()).count(name)
        if times == 0 or (times > 1 and not _is_made_again(left, name)):
            return {}
    return names


def _are_alike(here: set[str], there: set[str]) -> bool:
    return bool(here and there) and (here <= there or there <= here)


def _is_made_again(unit: Spec, node: str) -> bool:
    callbacks = [callback for callback in unit.callbacks if callback.node == node]
    return all(isinstance(callback.count, Unknown) for callback in callbacks)


def _functions(unit: Spec, node: str) -> set[str]:
    """Return class and function of user code; the module depends on how it is started."""
    callbacks = (c for c in unit.callbacks if not c.builtin and c.node in (node, None))
    return {'.'.join(c.function.split('.')[-2:]) for c in callbacks if c.function}


def _lines(unit: Spec) -> set[tuple[str, int]]:
    """Return the lines of the user where a unit makes entities; files by name, without folders."""
    places = {c.source for c in unit.callbacks if not c.builtin} | {unit.executor.source}
    return {(place.file.rpartition('/')[2], place.line) for place in places if place}


def _node_names(unit: Spec) -> set[str]:
    named = {callback.node for callback in unit.callbacks if isinstance(callback.node, str)}
    return named | set(unit.nodes)


def match_callbacks(left: Spec, right: Spec) -> Matching:
    """Pair callbacks by ever weaker identities; equal ones pair up in their order."""
    rest_left = [callback for callback in left.callbacks if not callback.builtin]
    rest_right = [callback for callback in right.callbacks if not callback.builtin]
    pairs: list[Pair] = []
    names = _new_names(left, right)
    called = {id(c): replace(c, node=names.get(str(c.node), c.node)) for c in rest_right}
    for identity in _IDENTITIES:
        for mine in list(rest_left):
            sought = identity(mine)
            theirs = next((c for c in rest_right if identity(called[id(c)]) == sought), None)
            if theirs is not None and sought is not None:
                pairs.append((mine, theirs))
                rest_left.remove(mine)
                rest_right.remove(theirs)
    order = {id(callback): number for number, callback in enumerate(left.callbacks)}
    pairs.sort(key=lambda pair: order[id(pair[0])])
    many = [mine for mine in left.callbacks if isinstance(mine.count, Unknown)]
    known = {identity(mine) for mine in many for identity in _KINDS_OF_MANY} - {None}
    more = (c for c in rest_right if {of(called[id(c)]) for of in _KINDS_OF_MANY} & known)
    return Matching(tuple(pairs), tuple(rest_left), tuple(rest_right), frozenset(map(id, more)))


Identity = tuple[object, ...] | None


def _full(callback: Callback) -> Identity:
    key = _key(callback)
    return None if key is None else (*_function_of(callback), key)


def _without_key(callback: Callback) -> Identity:
    return _function_of(callback) if callback.function else None


def _without_function(callback: Callback) -> Identity:
    key = _key(callback)
    return None if key is None else (callback.node, callback.entity, key)


def _function_of(callback: Callback) -> tuple[object, ...]:
    function = callback.function and callback.function.rpartition('.')[2]
    return (callback.node, callback.entity, function)


def _key(callback: Callback) -> str | None:
    for fact in (callback.key, callback.period_s):
        if isinstance(fact, float):
            return f'{fact:g} s'
        if isinstance(fact, str):
            return fact.lstrip('/')
    return None


def _by_line(callback: Callback) -> Identity:
    """What has no function may have a name that only a run knows."""
    place = callback.source
    if place is None or callback.function:
        return None
    return callback.node, callback.entity, place.file.rpartition('/')[2], place.line


_IDENTITIES: tuple[Function[[Callback], Identity], ...] = (
    _full,
    _without_key,
    _without_function,
    _by_line,
)
_KINDS_OF_MANY: tuple[Function[[Callback], Identity], ...] = (_without_key, _by_line)


def _diff_executors(left: Spec, right: Spec) -> Iterator[Difference]:
    mine, theirs = left.executor, right.executor
    for fact, a, b, marked in (
        ('kind', mine.kind, theirs.kind, False),
        ('threads', _threads(mine), _threads(theirs), _is_default(mine) or _is_default(theirs)),
    ):
        if a != b:
            yield Difference(
                kind=_kind(a, b),
                unit=left.name,
                subject=mine.name,
                fact=fact,
                left=str(a),
                right=str(b),
                left_place=mine.source,
                right_place=theirs.source,
                marked=marked or isinstance(a, Unknown) or isinstance(b, Unknown),
            )


def _threads(executor: Executor) -> int | Unknown:
    return executor.unresolved or len(executor.threads)


def _is_default(executor: Executor) -> bool:
    return executor.threads_source == DEFAULT_COUNT


def _diff_facts(unit: str, mine: Callback, theirs: Callback) -> Iterator[Difference]:
    # A live run does not show whose answer a done-callback has.
    is_unreported = mine.entity is EntityKind.DONE_CALLBACK and theirs.key is None
    key = mine.key if is_unreported else theirs.key
    for fact, a, b in (
        (mine.entity.key_name if mine.entity else None, mine.key, key),
        ('period_s', mine.period_s, theirs.period_s),
        ('coroutine', mine.coroutine, theirs.coroutine),
    ):
        if _plain(a) != _plain(b):
            yield Difference(
                kind=_kind(a, b),
                unit=unit,
                subject=mine.name,
                fact=fact or 'key',
                left=str(a),
                right=str(b),
                left_place=mine.source,
                right_place=theirs.source,
                marked=isinstance(a, Unknown) or isinstance(b, Unknown),
            )


def _plain(fact: object) -> object:
    if isinstance(fact, float):
        # rclpy cuts a period to whole nanoseconds (node.py of 7.1.6, create_timer).
        return int(fact * 1e9 + _FLOAT_ERROR_NS)
    return fact.lstrip('/') if isinstance(fact, str) else fact


def _diff_groups(left: Spec, right: Spec, pairs: Sequence[Pair]) -> Iterator[Difference]:
    """Compare groups by type and by which callbacks share one; their names do not matter."""
    partner: dict[str, str] = {}
    owner: dict[str, str] = {}
    for mine, theirs in pairs:
        a, b = left.group_of(mine), right.group_of(theirs)
        shown_a, shown_b = (
            f'{group.type.value}{" default" if group.default else ""}' for group in (a, b)
        )
        mapped = partner.setdefault(a.name, b.name) == b.name
        mapped &= owner.setdefault(b.name, a.name) == a.name
        if shown_a != shown_b or not mapped:
            yield Difference(
                kind=Kind.NOT_KNOWN if a.unresolved or b.unresolved else Kind.DIFFERS,
                unit=left.name,
                subject=mine.name,
                fact='group',
                left=f'{a.name} ({shown_a})',
                right=f'{b.name} ({shown_b})',
                left_place=a.source or mine.source,
                right_place=b.source or theirs.source,
                marked=bool(a.unresolved or b.unresolved),
            )


def _kind(a: object, b: object) -> Kind:
    unknown = isinstance(a, Unknown) or isinstance(b, Unknown)
    return Kind.NOT_KNOWN if unknown else Kind.DIFFERS


def _missing(unit: str, callback: Callback, kind: Kind) -> Difference:
    shown = f'{callback.type.value} {_key(callback) or ""}'.strip()
    is_left = kind is Kind.ONLY_LEFT
    return Difference(
        kind=kind,
        unit=unit,
        subject=callback.name,
        fact='callback',
        left=shown if is_left else '',
        right='' if is_left else shown,
        left_place=callback.source if is_left else None,
        right_place=None if is_left else callback.source,
        marked=_may_be_missing(callback),
    )


def _may_be_missing(callback: Callback) -> bool:
    return (
        callback.conditional
        or callback.alternative is not None
        or callback.when is not When.START
        or callback.groupless
        or callback.destroyed
        or isinstance(callback.count, Unknown)
    )


def _missing_unit(unit: Spec, kind: Kind) -> Difference:
    """Whether no known code makes or spins a class: then its absence proves nothing."""
    written = [callback for callback in unit.callbacks if not callback.builtin]
    is_left = kind is Kind.ONLY_LEFT
    nodes = ', '.join(unit.nodes)
    return Difference(
        kind=kind,
        unit=unit.name,
        subject=unit.name,
        fact='unit',
        left=nodes if is_left else '',
        right='' if is_left else nodes,
        marked=isinstance(unit.executor.kind, Unknown)
        or (bool(written) and all(map(_may_be_missing, written))),
    )


def _filled(mine: Callback, theirs: Callback) -> Callback:
    return replace(
        mine,
        node=_known(mine.node, theirs.node),
        key=_known(mine.key, theirs.key),
        period_s=_known(mine.period_s, theirs.period_s),
        duration_s=mine.duration_s or theirs.duration_s,
        function=mine.function or theirs.function,
        unresolved=None if theirs.function else mine.unresolved,
        source=mine.source or theirs.source,
        defined=mine.defined or theirs.defined,
        measured=theirs.measured,
    )


def _known(mine: Fact, theirs: Fact) -> Fact:
    return theirs if isinstance(mine, Unknown) else mine


def _filled_executor(mine: Executor, theirs: Executor) -> Executor:
    if isinstance(mine.kind, Unknown):
        return replace(theirs, name=mine.name)
    if mine.unresolved is not None or _is_default(mine):
        return replace(
            mine,
            threads=theirs.threads,
            threads_source=theirs.threads_source,
            unresolved=theirs.unresolved,
            assumed=theirs.assumed,
        )
    return mine


def _group_names(static: Spec, live: Spec, pairs: Sequence[Pair]) -> dict[str, str]:
    """Name of a live group to that of the static group with the same members."""
    return {live.group_of(theirs).name: static.group_of(mine).name for mine, theirs in pairs}


def _free(name: str, taken: Container[str]) -> str:
    number, candidate = 2, name
    while candidate in taken:
        candidate, number = f'{name}_{number}', number + 1
    return candidate
