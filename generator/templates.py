"""
Renders template files; what they are compiled to is kept where Python keeps its byte code.

Compiling the templates takes longer than rendering and reading a small model. The user's cache
is no place for the results, because nothing in it may run. ``__pycache__`` beside this module is
one: a user that can write there can already change this program.
"""

from __future__ import annotations

import importlib.util
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import jinja2
from jinja2.bccache import Bucket, FileSystemBytecodeCache

OPTIONS = {'trim_blocks': True, 'lstrip_blocks': True, 'keep_trailing_newline': True}


def environment() -> jinja2.Environment:
    """Make the environment that renders the files below ``profiles/``."""
    options: dict[str, Any] = OPTIONS
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / 'profiles'),
        autoescape=lambda name: name is not None and name.endswith('.xml.j2'),
        undefined=jinja2.StrictUndefined,
        auto_reload=False,
        bytecode_cache=KeptBytecode(Path(importlib.util.cache_from_source(__file__)).parent),
        **options,
    )


class KeptBytecode(FileSystemBytecodeCache):
    """Templates compiled earlier; one that cannot be read or written is compiled anew."""

    def __init__(self, folder: Path) -> None:
        super().__init__(str(folder), f'template-{sys.implementation.cache_tag}-%s.cache')

    def get_source_checksum(self, source: str) -> str:
        """Also of what else decides how a template is compiled."""
        return super().get_source_checksum(f'{jinja2.__version__} {OPTIONS}\n{source}')

    def load_bytecode(self, bucket: Bucket) -> None:
        """A damaged file counts as none."""
        try:
            super().load_bytecode(bucket)
        except Exception:  # pickle may raise anything
            bucket.reset()

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Only where Python writes byte code, too."""
        if not sys.dont_write_bytecode:
            with suppress(OSError):
                super().dump_bytecode(bucket)
