"""Values as plain data and back: the same values, or a refusal."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2cc_extract.errors import InputError
from ros2cc_extract.plain_data import Packer, PackingError


class Colour(Enum):
    RED = 'red'
    BLUE = 'blue'


@dataclass(frozen=True)
class Leaf:
    name: str
    weight: float | None = None


@dataclass(frozen=True)
class Tree:
    leaves: tuple[Leaf, ...]
    colour: Colour | None
    sizes: Mapping[str, int | str]
    roles: Mapping[tuple[str, tuple[int, ...]], bool]
    best: Leaf | str | None = None
    pair: tuple[int, Leaf] = (0, Leaf('none'))
    fallen: tuple[Leaf, ...] | None = None
    origin: object = field(default=None, compare=False)

    def __post_init__(self) -> None:
        if len(self.leaves) > 9:
            raise InputError('too many leaves')


PACKER: Packer[Tree] = Packer(Tree)
LEAVES = st.builds(Leaf, st.text(), st.none() | st.floats(allow_nan=False) | st.integers())
TREES = st.builds(
    Tree,
    st.lists(LEAVES, max_size=4).map(tuple),
    st.none() | st.sampled_from(Colour),
    st.dictionaries(st.text(), st.integers() | st.text()),
    st.dictionaries(st.tuples(st.text(), st.lists(st.integers()).map(tuple)), st.booleans()),
    st.none() | LEAVES | st.text(),
    st.tuples(st.integers(), LEAVES),
    st.none() | st.lists(LEAVES, max_size=2).map(tuple),
)
PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)


def through_json(data: Any) -> Any:
    return json.loads(json.dumps(data))


@given(TREES)
def test_a_value_is_what_it_was(tree: Tree) -> None:
    again = PACKER.unpack(through_json(PACKER.pack(tree)))
    assert again == tree
    assert repr(again) == repr(tree)


@given(TREES, st.data())
def test_data_of_another_form_are_refused_and_never_believed(
    tree: Tree, data: st.DataObject
) -> None:
    packed = through_json(PACKER.pack(tree))
    key = data.draw(st.sampled_from(sorted(packed)))
    packed[key] = data.draw(PLAIN)
    try:
        read = PACKER.unpack(packed)
    except PackingError:
        return
    assert through_json(PACKER.pack(read)).get(key, packed[key]) == packed[key]


@pytest.mark.parametrize(
    'data', [None, [], 'x', {}, {'leaves': []}, {'unknown': 1}, {'leaves': [{'name': 1}]}]
)
def test_what_says_no_tree_is_refused(data: Any) -> None:
    with pytest.raises(PackingError):
        PACKER.unpack(data)


def test_a_value_that_refuses_itself_is_refused() -> None:
    leaves = [{'name': 'one'}] * 10
    with pytest.raises(PackingError, match='too many leaves'):
        PACKER.unpack({'leaves': leaves, 'sizes': {}, 'roles': []})


def test_what_is_not_compared_stays_behind() -> None:
    tree = Tree((), None, {}, {}, origin=print)
    assert PACKER.unpack(PACKER.pack(tree)).origin is None


def test_a_function_is_no_data() -> None:
    @dataclass(frozen=True)
    class Asked:
        run: Callable[[], int] | None

    globals()['Asked'] = Asked
    packer: Packer[Any] = Packer(Asked)
    assert packer.unpack(packer.pack(Asked(None))) == Asked(None)
    with pytest.raises(TypeError, match='is not plain data'):
        packer.pack(Asked(lambda: 1))
