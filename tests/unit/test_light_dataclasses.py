"""Light dataclasses do what those of the standard library do, but for the two things they save."""

from __future__ import annotations

import dataclasses
from functools import cached_property

import pytest

from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True)
class Point:
    x: int
    y: int = 0
    shown_not: str = dataclasses.field(default='far', repr=False, compare=False)

    @cached_property
    def sum(self) -> int:
        return self.x + self.y


@dataclass(frozen=True)
class Marked(Point):
    marks: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Named:
    name: str


@dataclass(frozen=True, order=True)
class Version:
    numbers: tuple[int, ...]


@dataclass(frozen=True)
class WithOwn:
    text: str

    def __hash__(self) -> int:
        return 7

    def __repr__(self) -> str:
        return f'<{self.text}>'


@dataclass
class Counter:
    count: int = 0


@dataclass(eq=False)
class Machine:
    state: int = 0


def test_values_are_made_compared_hashed_and_shown_as_by_the_standard_library() -> None:
    assert repr(Point(1)) == 'Point(x=1, y=0)'
    assert repr(Marked(1, 2, marks=('a',))) == "Marked(x=1, y=2, marks=('a',))"
    assert Point(1, 2, 'here') == Point(1, 2, 'there') != Point(2, 1)
    assert Point(1) != Marked(1)
    assert {Point(1, 2, 'here'), Point(1, 2, 'there')} == {Point(1, 2)}
    assert dataclasses.replace(Point(1), y=5) == Point(1, 5)
    assert Point(2, 3).sum == 5
    assert Version((1, 2)) < Version((1, 10))
    assert Named(name='n') == Named(name='n')
    with pytest.raises(TypeError):
        Named('n')  # type: ignore[misc]


def test_what_a_class_writes_itself_stays() -> None:
    assert hash(WithOwn('a')) == 7
    assert repr(WithOwn('a')) == '<a>'


def test_only_frozen_values_can_be_hashed() -> None:
    counter = Counter()
    counter.count += 1
    assert repr(counter) == 'Counter(count=1)'
    with pytest.raises(TypeError):
        hash(counter)
    machine = Machine()
    assert {machine: 1}[machine] == 1
    assert machine != Machine()


def test_a_frozen_class_has_no_functions_that_refuse_assignments() -> None:
    assert '__setattr__' not in vars(Point)
