"""
What a process may be started in, and every subcommand with something to do.

An environment is a prefix of the command line, and variables. Where it needs rights that are not
given here, it is left out.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from ros2cc_extract.confirm.schedules import write_schedule
from ros2cc_extract.explore.scenario import write_found
from tests.attack.hostile import MODELS
from tests.attack.hostile_replays import SCHEDULE, recorded
from tests.support.packages import DEADLOCK, MANIFEST
from tests.unit.conform.test_conform_command import SPEC, trace_lines
from tests.unit.explore.test_explore_scenarios import FOUND, SCENARIO

UNPRIVILEGED = '+dac_read_search'
NOBODY = (
    *('setpriv', '--reuid=1234', '--regid=1234', '--clear-groups'),
    *(f'--{each}=-all,{UNPRIVILEGED}' for each in ('inh-caps', 'ambient-caps', 'bounding-set')),
)
"""A user that has no name, no home and no right to write, as of ``docker run -u 1234``."""


def shell(script: str) -> tuple[str, ...]:
    return 'bash', '-c', script, 'shell'


def redirected(streams: str) -> tuple[str, ...]:
    return shell(f'exec "$@" {streams}')


@dataclass(frozen=True)
class Surroundings:
    """
    One environment.

    :param changes: whether the result may be another one, which is then reported in one line.
    :param as_root: whether only root can make it.
    """

    prefix: tuple[str, ...] = ()
    variables: Mapping[str, str] = field(default_factory=dict)
    changes: bool = False
    as_root: bool = False


ENVIRONMENTS = {
    'usual': Surroundings(),
    'little memory': Surroundings(('prlimit', '--as=300000000'), changes=True),
    'few descriptors': Surroundings(('prlimit', '--nofile=16'), changes=True),
    'no more processes': Surroundings(
        (*NOBODY, 'prlimit', '--nproc=1'), changes=True, as_root=True
    ),
    'small files only': Surroundings(('prlimit', '--fsize=100'), changes=True),
    'small stack': Surroundings(('prlimit', '--stack=262144')),
    'no /dev/shm': Surroundings(
        ('unshare', '-m', *shell('umount -l /dev/shm && exec "$@"')), as_root=True
    ),
    'nothing to write to': Surroundings(
        (
            'unshare',
            '-m',
            *shell('mount --bind . . && mount -o remount,bind,ro . && cd "$PWD" && exec "$@"'),
        ),
        changes=True,
        as_root=True,
    ),
    'user 1234': Surroundings(
        (*NOBODY, 'env', '-u', 'HOME', '-u', 'XDG_CACHE_HOME'), changes=True, as_root=True
    ),
    'no home': Surroundings(('env', '-u', 'HOME', '-u', 'XDG_CACHE_HOME')),
    'a home that is a file': Surroundings(
        variables={'HOME': '/dev/null', 'XDG_CACHE_HOME': '/dev/null'}
    ),
    'no folder for temporary files': Surroundings(variables={'TMPDIR': '/nowhere'}),
    'no programs': Surroundings(variables={'PATH': '/nowhere'}, changes=True),
    'no variables': Surroundings(('env', '-i')),
    'closed stdin': Surroundings(redirected('<&-')),
    'closed stdout': Surroundings(redirected('>&-'), changes=True),
    'full stdout': Surroundings(redirected('>/dev/full'), changes=True),
    'closed stderr': Surroundings(redirected('2>&-')),
    'full stderr': Surroundings(redirected('2>/dev/full')),
    'nothing open': Surroundings(redirected('<&- >&- 2>&-'), changes=True),
    'a reader that leaves': Surroundings(
        shell('"$@" | head -c 1 >/dev/null; exit ${PIPESTATUS[0]}'), changes=True
    ),
    'no folder': Surroundings(shell('rm -r "$PWD"; exec "$@"'), changes=True),
    'Latin-1': Surroundings(variables={'PYTHONIOENCODING': 'latin-1', 'LC_ALL': 'C'}),
    'ASCII': Surroundings(
        variables={'PYTHONIOENCODING': 'ascii:strict', 'PYTHONUTF8': '0', 'LC_ALL': 'POSIX'}
    ),
    'a locale that is not there': Surroundings(variables={'LC_ALL': 'xx_YY.zz', 'LANG': '\udcff'}),
    'dumb and narrow': Surroundings(variables={'TERM': 'dumb', 'COLUMNS': '40'}),
    'no width': Surroundings(
        variables={'COLUMNS': '0', 'LINES': '-1', 'TERM': '', 'FORCE_COLOR': '1'}
    ),
    'bytes that are no text': Surroundings(
        variables={'XDG_CACHE_HOME': '/tmp/\udcff', 'USER': '\udcff', 'TERM': '\udcff'}
    ),
    'interrupts ignored': Surroundings(shell('trap \'\' INT TERM HUP PIPE; exec "$@"')),
    'children not waited for': Surroundings(shell('trap \'\' CHLD; exec "$@"')),
    'optimised': Surroundings(variables={'PYTHONOPTIMIZE': '2', 'PYTHONDONTWRITEBYTECODE': '1'}),
    'warnings': Surroundings(variables={'PYTHONWARNINGS': 'error', 'PYTHONDEVMODE': '0'}),
    'no hash seed': Surroundings(variables={'PYTHONHASHSEED': '0', 'PYTHONUNBUFFERED': '1'}),
}
SUBCOMMANDS: dict[str, tuple[str, ...]] = {
    'help': ('--help',),
    'check': ('check', 'node.py'),
    'check, html': ('check', 'node.py', '--output-format', 'html'),
    'check, diff': ('check', 'node.py', '--diff-base', 'HEAD'),
    'spec': ('spec', 'node.py'),
    'model': ('model', 'node.py', '-o', 'out'),
    'verify': ('verify', 'node.py'),
    'verify a model': ('verify', 'model.xml'),
    'explain': ('explain', 'CC101'),
    'run': ('run', '-o', 'out.yaml', '--', '/bin/true'),
    'env': ('env', '-o', 'out'),
    'collect': ('collect', 'live', '-o', 'out.yaml'),
    'attach': ('attach', '4194304'),
    'conform': ('conform', 'trace.jsonl', 'good.yaml'),
    'diff': ('diff', 'good.yaml', 'good.yaml'),
    'init': ('init', '.'),
    'merge': ('merge', 'good.yaml', 'good.yaml'),
    'system': ('system', 'arm.launch.xml'),
    'system, html': ('system', '.', '--output-format', 'html'),
    'check a launch file': ('check', 'arm.launch.xml'),
    'upgrade': ('upgrade', '--from', 'jazzy', '--to', 'kilted', 'node.py'),
    'fleet': ('fleet', '.', '-o', 'out'),
    'why': ('why', '4194304'),
    'confirm': ('confirm', 'node.py', '--python', '/bin/false'),
    'confirm, again': ('confirm', '--replay', 'confirm.json', '--python', '/bin/echo'),
    'explore': ('explore', '--python', '/bin/echo', '--', '/bin/true'),
    'explore, again': ('explore', '--replay', 'explore.json'),
    'surrogates': ('check', 'nowhere\udcff\udc80.py'),
}


def fill(folder: Path) -> None:
    """Everything that the subcommands read; the name is in every language."""
    folder.mkdir(parents=True)
    (folder / 'node.py').write_text(DEADLOCK.replace("'map_ready'", "'karte_überall_→'"), 'utf-8')
    (folder / 'good.yaml').write_text(SPEC)
    (folder / 'trace.jsonl').write_text(''.join(f'{line}\n' for line in trace_lines()))
    shutil.copy(MODELS[0], folder / 'model.xml')
    (folder / 'package.xml').write_text(MANIFEST.format(name='arm'))
    (folder / 'arm.launch.xml').write_text('<launch><node pkg="arm" exec="node.py"/></launch>')
    (folder / 'CMakeLists.txt').write_text('install(PROGRAMS node.py DESTINATION lib/arm)')
    (folder / 'confirm.json').write_text(write_schedule(SCHEDULE))
    (folder / 'explore.json').write_text(write_found(FOUND, SCENARIO, None))
    (folder / 'live').mkdir()
    (folder / 'live' / '7-1.json').write_text(json.dumps(recorded()))
    folder.chmod(0o755)


@cache
def is_possible(name: str) -> bool:
    """Whether such an environment can be made here."""
    surroundings = ENVIRONMENTS[name]
    if surroundings.as_root and os.geteuid() != 0:
        return False
    if not surroundings.prefix or (surroundings.changes and not surroundings.as_root):
        return True
    tried = subprocess.run(
        [*surroundings.prefix, 'true'], cwd='/usr', capture_output=True, check=False
    )
    return tried.returncode == 0 or name == 'nothing to write to'
