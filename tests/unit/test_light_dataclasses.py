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


@dataclass(frozen=True)
class Base:
    names: list[str] = dataclasses.field(default_factory=list, hash=False)
    doubled: int = dataclasses.field(init=False, default=0)
    given: int = 0

    def __post_init__(self) -> None:
        self.__dict__['doubled'] = 2 * self.given


@dataclass(frozen=True)
class Derived(Base):
    more: int = 0


def test_what_is_written_late_is_what_the_standard_library_writes() -> None:
    assert Derived(given=4, more=1).doubled == 8
    assert Derived(['a'], 1) == Derived(['a'], 1) != Derived(['b'], 1)
    assert Base().names is not Base().names
    with pytest.raises(TypeError, match=r'^Derived\.__init__\(\) got an unexpected keyword'):
        Derived(doubled=3)  # type: ignore[call-arg]


def test_values_that_were_not_made_by_calling_the_class_are_equal_and_hashed() -> None:
    @dataclass(frozen=True)
    class Stored:
        x: int

    class_is_uncalled = [object.__new__(Stored) for _ in range(2)]
    for value in class_is_uncalled:
        value.__dict__['x'] = 1
    first, second = class_is_uncalled
    assert hash(first) == hash(second)
    assert first == second


def test_each_function_is_written_at_the_first_call_and_once() -> None:
    @dataclass
    class Late:
        x: int

    before = vars(Late)['__init__']
    assert Late(1).x == 1
    written = vars(Late)['__init__']
    assert written is not before
    assert Late(2) == Late(2)
    assert vars(Late)['__init__'] is written
