"""YAML that would become more than it looks like is refused before anything of it is built."""

from __future__ import annotations

import pytest
import yaml

from ros2cc_extract.spec.yaml.bounds import (
    ITSELF,
    LOADER,
    MOST_DEPTH,
    TOO_DEEP,
    TOO_LARGE,
    UnboundedYamlError,
    check,
    composed,
    composed_alone,
)

DOUBLED = '- &a0 [x, y]\n' + ''.join(f'- &a{n + 1} [*a{n}, *a{n}]\n' for n in range(60))
MERGED = '- &a0 {x: y}\n' + ''.join(f'- &a{n + 1} {{k: *a{n}, l: *a{n}}}\n' for n in range(60))


@pytest.mark.parametrize(
    ('text', 'problem'),
    [
        ('[' * 50_000, TOO_DEEP),
        ('{a: ' * (MOST_DEPTH + 1), TOO_DEEP),
        (DOUBLED, TOO_LARGE),
        (MERGED, TOO_LARGE),
        ('&a [*a]', ITSELF),
        ('&a {x: {y: [1, *a]}}', ITSELF),
    ],
    ids=['brackets', 'braces', 'lists', 'mappings', 'itself', 'itself, deeper'],
)
def test_what_is_not_composed(text: str, problem: str) -> None:
    with pytest.raises((UnboundedYamlError, yaml.YAMLError)) as refused:
        check(text)
    # libyaml of newer PyYAML ends by itself at 1,000 levels.
    if isinstance(refused.value, UnboundedYamlError):
        assert refused.value.problem == problem
    else:
        assert problem == TOO_DEEP


def test_anchors_as_people_use_them() -> None:
    text = 'base: &b {x: 1, y: [2, 3]}\none: {<<: *b, z: *b}\n---\nother: [*b]\n'
    with pytest.raises(yaml.YAMLError, match='undefined alias'):
        list(composed(text))
    text = text.replace('*b]', 'b]')
    assert len(list(composed(text))) == 2
    with pytest.raises(yaml.YAMLError, match='single document'):
        composed_alone(text)
    first = text.partition('---')[0]
    root = composed_alone(first)
    assert root is not None
    loaded = LOADER(first).get_single_data()
    assert loaded['one'] == {'x': 1, 'y': [2, 3], 'z': loaded['base']}


def test_an_anchor_that_is_given_again_is_the_new_one() -> None:
    text = '- &a [x]\n' + '- &b [*a, *a]\n- &a [*b]\n' * 15
    check(text)
    with pytest.raises(UnboundedYamlError):
        check(text + '- &b [*a, *a]\n- &a [*b]\n' * 15)
