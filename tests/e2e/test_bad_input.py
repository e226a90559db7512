"""Bad input: one line with place and mend, status 2, no traceback, nothing left behind."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.e2e.conftest import EXAMPLES, Run

NODE = EXAMPLES / 'two_groups' / 'node.py'
# Root reads every file, unless these rights are taken away (util-linux).
WITHOUT_PRIVILEGE = ('setpriv', '--bounding-set', '-dac_override,-dac_read_search')
PYTHON_2 = "class A:\n    def f(self):\n        print 'hello'\n"
MODEL = """<?xml version="1.0" encoding="utf-8"?>
<nta><declaration>int[0,3] v;</declaration>
<template><name>T</name><location id="id0"><name>a</name></location><init ref="id0"/></template>
<system>p = T(); system p;</system></nta>
"""


def assert_refused(outcome: object, *parts: str) -> None:
    status, out, err = outcome.status, outcome.out, outcome.err  # type: ignore[attr-defined]
    assert status == 2, err
    assert 'Traceback' not in out + err
    for part in parts:
        assert part in out + err


def test_missing_file(run: Run) -> None:
    outcome = run('nowhere.py')
    assert_refused(outcome, 'nowhere.py')
    assert len(outcome.err.splitlines()) == 1


def test_directory_without_python(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'empty').mkdir()
    outcome = run('empty')
    assert_refused(outcome, 'empty')
    assert len(outcome.err.splitlines()) == 1


@pytest.mark.parametrize(
    ('name', 'content', 'place'),
    [
        ('broken.py', b'import rclpy\ndef f(:\n', 'broken.py:2'),
        ('python2.py', b'import rclpy\n' + PYTHON_2.encode(), 'python2.py:4'),
        ('binary.py', bytes(range(256)) * 40 + b'rclpy', 'binary.py'),
    ],
)
def test_file_that_does_not_parse(
    run: Run, tmp_path: Path, name: str, content: bytes, place: str
) -> None:
    (tmp_path / name).write_bytes(content)
    assert_refused(run(name), place)
    assert_refused(run('spec', name), place)


@pytest.mark.parametrize(
    ('name', 'told'),
    [
        ('notes.txt', 'notes.txt: is no Python file by its name; name a node or a folder'),
        ('node.CPP', 'node.CPP: is no Python file by its name; name a node or a folder'),
        ('arm.yaml', 'arm.yaml: is a specification, and no Python; `verify arm.yaml` reads it'),
    ],
)
def test_a_file_that_is_no_python_by_its_name(
    run: Run, tmp_path: Path, name: str, told: str
) -> None:
    """Plain words would parse, and nothing be found in them."""
    (tmp_path / name).write_text('hello\n')
    outcome = run('check', name)
    assert_refused(outcome, told)
    assert (outcome.out, len(outcome.err.splitlines())) == ('', 1)


def test_a_script_need_not_end_in_py(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'talker').write_text('import rclpy\n')
    assert run('check', 'talker').status == 0


@pytest.mark.parametrize('word', ['chek', 'verfy'])
def test_a_command_that_is_misspelt(run: Run, word: str) -> None:
    outcome = run(word, 'node.py')
    meant = {'chek': 'check', 'verfy': 'verify'}[word]
    assert_refused(
        outcome, f'{word}: no such file or directory, and no command; did you mean {meant!r}?'
    )


def test_one_broken_file_does_not_hide_the_others(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'broken.py').write_text('import rclpy\ndef f(:\n')
    (tmp_path / 'node.py').write_text(NODE.read_text())
    outcome = run('spec', '.')
    assert outcome.status == 0
    assert 'broken.py:2' in outcome.err
    assert 'callback_groups:' in outcome.out


def test_unreadable_file(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'secret.py').write_text('import rclpy\n')
    (tmp_path / 'secret.py').chmod(0)
    outcome = run('secret.py', prefix=WITHOUT_PRIVILEGE if os.geteuid() == 0 else ())
    assert_refused(outcome, 'secret.py', 'ermission denied')


def test_empty_file_holds_no_node(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'nothing.py').write_text('')
    outcome = run('nothing.py')
    told = 'nothing to check: no rclpy node with a callback found\n'
    assert (outcome.status, outcome.err) == (0, told)


def test_five_megabytes_of_generated_code(run: Run, tmp_path: Path) -> None:
    body = ''.join(f'x{i} = {{"key": [{i}, {i} + 1, "text"]}}\n' for i in range(150_000))
    (tmp_path / 'big.py').write_text(NODE.read_text() + '\n' + body)
    outcome = run('spec', 'big.py')
    assert 'Traceback' not in outcome.err
    assert 'callback_groups:' in outcome.out or 'big.py' in outcome.err


@pytest.mark.parametrize(
    ('text', 'parts'),
    [
        ('', ('model.xml',)),
        ('<html><body/></html>', ('model.xml:1',)),
        ('<nta><declaration>', ('model.xml:1',)),
        ('no xml at all', ('model.xml:1',)),
        (MODEL.replace('int[0,3] v;', 'clock x;'), ('model.xml:2', 'clock')),
        (MODEL.replace('int[0,3] v;', 'double d;'), ('model.xml:2', 'double')),
        (MODEL.replace('T();', 'T(3);'), ('model.xml:4',)),
    ],
)
def test_model_that_cannot_be_used(
    run: Run, tmp_path: Path, text: str, parts: tuple[str, ...]
) -> None:
    (tmp_path / 'model.xml').write_text(text)
    (tmp_path / 'q.q').write_text('A[] not deadlock\n')
    outcome = run('verify', 'model.xml', 'q.q')
    assert_refused(outcome, *parts)
    assert len(outcome.err.splitlines()) == 1


@pytest.mark.parametrize(
    ('query', 'part'),
    [
        ('E<> nobody.a', 'nobody'),
        ('E<> p.b', 'b'),
        ('E<> (p.a', 'q.q:1'),
        ('A[] p.a == ', 'q.q:1'),
    ],
)
def test_query_that_cannot_be_used(run: Run, tmp_path: Path, query: str, part: str) -> None:
    (tmp_path / 'model.xml').write_text(MODEL)
    (tmp_path / 'q.q').write_text(query + '\n')
    assert_refused(run('verify', 'model.xml', 'q.q'), part)


def test_model_without_queries(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'model.xml').write_text(MODEL)
    assert_refused(run('verify', 'model.xml'), 'no query found', 'name a .q file')


@pytest.mark.parametrize('command', ['model', 'check'])
def test_output_folder_that_is_a_file(run: Run, tmp_path: Path, command: str) -> None:
    (tmp_path / 'taken').write_text('mine')
    assert_refused(run(command, NODE, '-o', 'taken'), 'taken')
    assert (tmp_path / 'taken').read_text() == 'mine'


@pytest.mark.parametrize(
    'arguments',
    [('verify', 'x.yaml', '--threads', '0'), ('check', '--nonsense'), ('verify',), ()],
)
def test_wrong_usage(run: Run, arguments: tuple[str, ...]) -> None:
    assert run(*arguments).status == 2
