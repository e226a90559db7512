"""The tutorial as a program: carries it out and writes down what its commands print."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from tests.support.repositories import environment

PAGE = Path(__file__).parents[2] / 'docs' / 'tutorial.md'
_BLOCK = re.compile(r'^```(\w+) ?(\S*)\n(.*?)^```$', re.MULTILINE | re.DOTALL)
_COMMAND = re.compile(r'^\$ (.*)$', re.MULTILINE)


def carried_out(page: str, folder: Path) -> str:
    """
    Write the page's files into ``folder``, apply its changes, run its commands.

    :return: the page with what they print now.
    """

    def step(block: re.Match[str]) -> str:
        kind, name, text = block.groups()
        if kind == 'console':
            return (
                '```console\n'
                + ''.join(_run(each, folder) for each in _COMMAND.findall(text))
                + '```'
            )
        if kind == 'diff':
            subprocess.run(['git', 'apply'], cwd=folder, input=text, text=True, check=True)
        else:
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(text, encoding='utf-8')
        return block[0]

    subprocess.run(['git', 'init', '--quiet'], cwd=folder, check=True)
    return _BLOCK.sub(step, page)


def _run(command: str, folder: Path) -> str:
    printed = subprocess.run(
        ['bash', '-c', command],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    ).stdout
    return f'$ {command}\n{printed}'
