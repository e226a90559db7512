"""
What `expected.spec.yaml` and `expected.verdicts.yaml` of an example hold, and how to renew them.

    python -m tests.e2e.expected        # rewrites them, the README and the tutorial; read the diff

The specification is exactly what ``ros2cc-extract spec node.py`` prints in the example's folder.
The verdicts are those of profile ``paper`` for every unit, in the order of the queries.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.yaml.yaml_io import write_specs
from ros2cc_extract.verify.unit import verify_unit
from tests.e2e.tutorial import PAGE, carried_out

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted(path.parent for path in (ROOT / 'launch_free_examples').glob('*/node.py'))
README = ROOT / 'README.md'
SPEC_FILE = 'expected.spec.yaml'
VERDICT_FILE = 'expected.verdicts.yaml'


def scan_example(folder: Path) -> tuple[Spec, ...]:
    """Scan ``node.py`` with places relative to its folder."""
    return scan([folder / 'node.py'], root=folder).units


def spec_text(units: tuple[Spec, ...]) -> str:
    return write_specs(units)


def verdict_text(units: tuple[Spec, ...]) -> str:
    documents = [
        {
            'unit': unit.name,
            'profile': 'paper',
            'verdicts': [
                {'family': result.family, 'query': result.words, 'verdict': result.verdict.value}
                for result in verify_unit(close(unit)).results
            ],
        }
        for unit in units
    ]
    return yaml.safe_dump_all(documents, sort_keys=False, width=200)


def renew() -> None:
    for folder in EXAMPLES:
        units = scan_example(folder)
        (folder / SPEC_FILE).write_text(spec_text(units), encoding='utf-8')
        (folder / VERDICT_FILE).write_text(verdict_text(units), encoding='utf-8')


def demo_output() -> str:
    """Give what ``make demo`` prints on a machine without a terminal."""
    makefile = (ROOT / 'Makefile').read_text(encoding='utf-8')
    recipe = re.search(r'^demo:.*\n\t\$\(BIN\)/ros2cc-extract (\S+)', makefile, re.MULTILINE)
    assert recipe is not None
    done = subprocess.run(
        [sys.executable, '-m', 'ros2cc_extract.cli.main', recipe.group(1)],
        cwd=ROOT,
        env={name: value for name, value in os.environ.items() if name != 'COLUMNS'},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout


def shown_output() -> str:
    """Give what the README says that ``make demo`` prints."""
    after = README.read_text(encoding='utf-8').partition('$ make demo')[2]
    return after.split('```')[2].removeprefix('\n')


def renew_readme() -> None:
    text = README.read_text(encoding='utf-8')
    README.write_text(text.replace(shown_output(), demo_output(), 1), encoding='utf-8')


def renew_tutorial() -> None:
    with tempfile.TemporaryDirectory() as folder:
        page = carried_out(PAGE.read_text(encoding='utf-8'), Path(folder))
    PAGE.write_text(page, encoding='utf-8')


if __name__ == '__main__':
    renew()
    renew_readme()
    renew_tutorial()
