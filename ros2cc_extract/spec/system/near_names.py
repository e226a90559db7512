"""Names that are nearly the same: another namespace, a slash, a ``~``, one letter."""

from __future__ import annotations

NAMESPACE = 'the namespace'
_SHORTEST = 4


def how_near(one: str, other: str) -> str | None:
    """What the difference of two names is, where that looks like a slip; else ``None``."""
    if one == other:
        return None
    if '~' in one or '~' in other:
        return "a '~' that is not at the start" if _last(one) == _last(other) else None
    if one.replace('/', '') == other.replace('/', ''):
        return 'a slash'
    if _last(one) == _last(other):
        above = _namespace(one), _namespace(other)
        if any(a.startswith(b) for a, b in (above, above[::-1])):
            return NAMESPACE
        return 'one letter' if _is_slip(one, other, *map(_part, above)) else None
    if one.lower() == other.lower():
        return 'upper and lower case'
    return 'one letter' if _is_slip(one, other, _last(one), _last(other)) else None


def _is_slip(one: str, other: str, part: str, other_part: str) -> bool:
    """Whether two names differ by one letter in a part that is long enough."""
    is_long = min(len(part), len(other_part)) >= _SHORTEST
    return is_long and not _differ_by_number(one, other) and _is_one_slip(one, other)


def _part(namespace: str) -> str:
    """The longest part of a namespace, as that is where a slip may stand."""
    return max(namespace.split('/'), key=len)


def _last(name: str) -> str:
    return name.rpartition('/')[2]


def _namespace(name: str) -> str:
    return f'{name.rpartition("/")[0]}/'


def _differ_by_number(one: str, other: str) -> bool:
    """``camera1`` and ``camera2`` are meant to be two."""
    strip = str.maketrans('', '', '0123456789')
    return one.translate(strip) == other.translate(strip)


def _is_one_slip(one: str, other: str) -> bool:
    """Whether one letter is left out, put in or replaced, or two are swapped."""
    if len(one) > len(other):
        one, other = other, one
    if len(other) - len(one) > 1:
        return False
    at = next((n for n, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), len(one))
    if len(one) < len(other):
        return one[at:] == other[at + 1 :]
    is_swapped = one[at : at + 2] == other[at : at + 2][::-1] and one[at + 2 :] == other[at + 2 :]
    return one[at + 1 :] == other[at + 1 :] or is_swapped
