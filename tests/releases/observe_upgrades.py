"""
What whole nodes do on each release: those of ``upgrades/``, which know nothing of being observed.

``python -m tests.releases.observe_upgrades RELEASE...`` runs each for some seconds and writes down
in ``observed_upgrades.yaml`` which lines it printed, in the order of their first time, and how it
ended: ``runs`` when it was still there, the name of an exception, or ``ends``.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import yaml

from tests.conformance.releases import RELEASES, VARIABLE, built
from tests.conformance.suite import Release, own_environment
from tests.releases.observe import FOLDER, HERE, WHEELS

OBSERVED = HERE / 'observed_upgrades.yaml'
NODES = sorted((HERE / 'upgrades').glob('*.py'))
WATCHED_S = 10
AT_ONCE = 4
CPUS = re.compile(r'CPUs: (\d+)')
"""A line of the docstring of a node that is to have so many."""

Seen = list[str]
"""Lines of a node, each once, and how it ended."""


def read_observed() -> dict[str, dict[str, Seen]]:
    """What was observed: node by node, for each release."""
    read: dict[str, dict[str, Seen]] = yaml.safe_load(OBSERVED.read_text())
    return read


def observe(python: str, release: Release | None) -> Iterator[tuple[str, Seen]]:
    """Run the nodes on one release."""
    with ThreadPoolExecutor(AT_ONCE) as threads:
        seen = threads.map(lambda node: watched(python, node, release), NODES)
        yield from zip((node.stem for node in NODES), seen, strict=True)


def watched(python: str, node: Path, release: Release | None) -> Seen:
    """Run a node until it ends, or its time is over."""
    cpus = CPUS.search(node.read_text())
    pinned = ['taskset', '-c', f'0-{int(cpus[1]) - 1}'] if cpus else []
    with own_environment() as environment:
        given = environment if release is None else release.over(environment)
        with subprocess.Popen(
            [*pinned, python, str(node)],
            env=given,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as process:
            try:
                out, err = process.communicate(timeout=WATCHED_S)
                end = _end(err) if process.returncode else 'ends'
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                out, err = process.communicate()
                end = 'runs'
    return [*dict.fromkeys(out.splitlines()), end]


def _end(err: str) -> str:
    names = re.findall(r'^(?:\w+\.)*(\w+)(?::.*)?$', err, re.MULTILINE)
    return names[-1] if names else 'fails'


def main() -> None:
    observed = read_observed() if OBSERVED.exists() else {}
    for version in sys.argv[1:] or (*WHEELS, *RELEASES):
        if version in WHEELS:
            python, release = WHEELS[version], None
        else:
            python, release = built(version, Path(os.environ.get(VARIABLE, '')), FOLDER)
        for name, seen in observe(python, release):
            observed.setdefault(name, {})[version] = seen
            print(version, name, seen, flush=True)
        OBSERVED.write_text(yaml.safe_dump(observed, sort_keys=True))


if __name__ == '__main__':
    main()
