"""Whole models, byte for byte; ``README.md`` says how to renew them."""

import os
from pathlib import Path

import pytest

from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.yaml.yaml_io import load_specs

MODELS = Path(__file__).parent / 'models'
CASES = sorted(folder.name for folder in MODELS.iterdir() if folder.is_dir())


def render_files(folder: Path) -> dict[str, str]:
    """Everything we write for the unit of ``folder``, by file name."""
    (spec,) = load_specs(folder / 'spec.yaml')
    files: dict[str, str] = {}
    for text in Text:
        model = render(close(spec), text=text)
        files |= {f'{text.value}.xml': model.xml, f'{text.value}.q': model.q, **model.published}
    rclpy = render(close(spec), profile=Profile.RCLPY)
    return files | {'rclpy.xml': rclpy.xml, 'rclpy.q': rclpy.q}


@pytest.mark.parametrize('case', CASES)
def test_models_are_as_recorded(case: str):
    folder = MODELS / case
    rendered = render_files(folder)
    if os.environ.get('RENEW_GOLDEN'):
        for name, content in rendered.items():
            (folder / name).write_text(content, encoding='utf-8')
    recorded = {
        path.name: path.read_text(encoding='utf-8')
        for path in folder.iterdir()
        if path.name != 'spec.yaml'
    }
    assert rendered == recorded
