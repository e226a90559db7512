"""A check in several parts, put together: what one whole check says."""

from __future__ import annotations

import json
import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.e2e.conftest import Outcome, Run, runner
from tests.support.trees import write_tree

PARTS = 3
ACCEPTED = '        self.client.call(None)  # ros2cc: ignore[CC101] asked on purpose'
USELESS = '        self.said = None  # ros2cc: ignore[CC101] nothing is wrong here'


@pytest.fixture(scope='module')
def of_all(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Twelve nodes; comments accept a finding of one of them, and nothing in another."""
    tree = tmp_path_factory.mktemp('shards') / 'tree'
    write_tree(tree)
    accepting, useless = (tree / 'one' / f'arm_{n}.py' for n in (1, 2))
    for path, line, comment in (
        (accepting, '        self.client.call(None)', ACCEPTED),
        (useless, '        self.said = None', USELESS),
    ):
        text = path.read_text()
        assert line in text
        path.write_text(text.replace(line, comment))
    return tree


@pytest.fixture(scope='module')
def parts(of_all: Path) -> list[Outcome]:
    """What each part of the check says."""
    run = runner(of_all, of_all.parent / 'cache')
    told = ('--output-format', 'json', '--no-cache')
    return [
        run('one', 'two', '--shard', f'{number}/{PARTS}', *told) for number in range(1, PARTS + 1)
    ]


@pytest.fixture
def tree(of_all: Path, tmp_path: Path) -> Path:
    """The nodes, for one test alone."""
    return shutil.copytree(of_all, tmp_path / 'tree')


def written(outcomes: Sequence[Outcome], folder: Path) -> list[Path]:
    paths = [folder / f'{number}.json' for number, _ in enumerate(outcomes, 1)]
    for path, outcome in zip(paths, outcomes, strict=True):
        path.write_text(outcome.out)
    return paths


@pytest.mark.parametrize('form', ['text', 'json', 'sarif', 'html'])
def test_parts_are_one_check(
    run: Run, tree: Path, parts: list[Outcome], tmp_path: Path, form: str
) -> None:
    paths = written(parts, tmp_path)
    told = ('--output-format', form, '--no-cache')
    whole = run('one', 'two', *told, cwd=tree)
    assert whole.status == 1
    assert run('one', 'two', *told, '--from-shards', *paths, cwd=tree) == whole


def test_each_unit_is_in_one_part(parts: list[Outcome]) -> None:
    units = [unit['node']['name'] for o in parts for unit in json.loads(o.out)['units']]
    assert sorted(units) == sorted([f'arm_{n}' for n in range(6)] * 2)
    assert len({len(json.loads(o.out)['units']) for o in parts} - {0, 12}) > 0


def test_a_part_does_not_judge_what_another_may_need(
    run: Run, tree: Path, parts: list[Outcome]
) -> None:
    """Which comment accepts nothing is known of all units only."""
    for outcome in parts:
        assert 'CC502' not in {f['code'] for f in json.loads(outcome.out)['findings']}
    whole = json.loads(run('one', 'two', '--output-format', 'json', cwd=tree).out)
    assert [f['path'] for f in whole['findings'] if f['code'] == 'CC502'] == ['one/arm_2.py']


def test_nothing_is_verified_when_parts_are_put_together(
    run: Run, tree: Path, parts: list[Outcome], tmp_path: Path
) -> None:
    """A verdict of a part is believed, also one that no search would find."""
    paths = written(parts, tmp_path)
    for path in paths:
        data = json.loads(path.read_text())
        for unit in data['shard']['units'].values():
            unit['shown']['results'][0] |= {'verdict': 'undecided', 'reason': 'said by a part'}
        path.write_text(json.dumps(data))
    form = ('--output-format', 'json', '--no-cache')
    told = json.loads(run('one', 'two', *form, '--from-shards', *paths, cwd=tree).out)
    reasons = [verification['queries'][0]['reason'] for verification in told['verdicts']]
    assert reasons == ['said by a part'] * 12


@pytest.mark.parametrize(
    ('arguments', 'told'),
    [
        (['--shard', '0/3'], "'0/3' is no shard; write 1/4"),
        (['--shard', '4/3'], "'4/3' is no shard; write 1/4"),
        (['--shard', '3'], "'3' is no shard; write 1/4"),
        (['--shard', '1/2'], 'a shard is no check of its own; add --output-format json, and '),
        (['--shard', '1/2', '--write-baseline', 'b'], 'a shard does not find all there is to '),
        (['--shard', '1/2', '--from-shards', 'x'], 'not allowed with argument --shard'),
        (['--from-shards', 'none.json'], 'none.json: cannot be read: No such file or directory'),
    ],
)
def test_what_cannot_be_asked_is_one_line(
    run: Run, tree: Path, arguments: list[str], told: str
) -> None:
    outcome = run('one', *arguments, cwd=tree)
    assert (outcome.status, outcome.out) == (2, '')
    assert told in outcome.err.splitlines()[-1]


def test_results_that_do_not_fit_are_refused(
    run: Run, tree: Path, parts: list[Outcome], tmp_path: Path
) -> None:
    first, second, third = paths = written(parts, tmp_path)

    def refused(*given: Path) -> str:
        outcome = run('one', 'two', '--from-shards', *given, cwd=tree)
        assert (outcome.status, outcome.out) == (2, '')
        (line,) = outcome.err.splitlines()
        return line.removeprefix('ros2cc-extract: error: ')

    assert refused(first, third) == ('there is no result of shard 2/3; name the files of all')
    text = second.read_text()
    second.write_text(text.replace('"of": 3', '"of": 4'))
    assert refused(*paths) == 'some are of 3 and 4 shards; name the results of one check'
    second.write_text(text.replace(json.loads(text)['shard']['tool'], 'f' * 64))
    assert 'it was written by another version of ros2cc-extract or of Python' in refused(*paths)
    second.write_text('{}')
    assert 'it is no result of a shard' in refused(*paths)
    second.write_text('{')
    assert 'no JSON: ' in refused(*paths)
    second.write_text(text.replace('"shown"', '"known"'))
    assert 'it is damaged' in refused(*paths)
    second.write_text(text)
    (tree / 'one' / 'arm_3.py').write_text((tree / 'one' / 'arm_3.py').read_text() + '\n\n')
    (tree / 'one' / 'arm_4.py').write_text(
        (tree / 'one' / 'arm_4.py').read_text().replace('0.5', '0.7')
    )
    assert refused(*paths) == (
        'unit arm_4 is in none of the results as it is asked for now; give the same sources '
        'and options to all shards'
    )
