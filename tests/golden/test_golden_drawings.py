"""The pictures of ``docs/model.md`` are the drawings of the templates as they are."""

import os
from pathlib import Path

import pytest

from ros2cc_extract.generator.build import Text, render
from ros2cc_extract.generator.svg import draw
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.yaml_io import load_specs

IMAGES = Path(__file__).parents[2] / 'docs' / 'images'
SPEC = Path(__file__).parent / 'models' / 'services' / 'spec.yaml'


@pytest.mark.parametrize('text', Text)
def test_pictures_show_the_templates(text: Text):
    (spec,) = load_specs(SPEC)
    drawn = {
        f'paper_{text.value}_{name}.svg': picture
        for name, picture in draw(render(close(spec), text=text).xml).items()
    }
    if os.environ.get('RENEW_GOLDEN'):
        for name, picture in drawn.items():
            (IMAGES / name).write_text(picture, encoding='utf-8')
    assert drawn == {
        path.name: path.read_text(encoding='utf-8')
        for path in IMAGES.glob(f'paper_{text.value}_*.svg')
    }
