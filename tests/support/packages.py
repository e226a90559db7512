"""ROS 2 packages for tests: a node that deadlocks, its mended twin, and a manifest."""

from __future__ import annotations

from pathlib import Path

EXAMPLE = Path(__file__).parents[2] / 'launch_free_examples' / 'service_deadlock' / 'node.py'
DEADLOCK = EXAMPLE.read_text(encoding='utf-8')
MENDED = DEADLOCK.replace('self.client.call(', 'self.client.call_async(')
MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>An arm.</description>
  <maintainer email="somebody@example.org">Somebody</maintainer>
  <license>Apache-2.0</license>
  <export><build_type>ament_python</build_type></export>
</package>
"""


def make_package(folder: Path, name: str, node: str) -> None:
    """Write an ament_python package with one node, ``NAME/node.py``."""
    (folder / name).mkdir(parents=True)
    (folder / name / '__init__.py').touch()
    (folder / name / 'node.py').write_text(node, encoding='utf-8')
    (folder / 'package.xml').write_text(MANIFEST.format(name=name), encoding='utf-8')
