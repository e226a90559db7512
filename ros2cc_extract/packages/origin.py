"""
What a job of another repository is to install: never a mere name.

The package index gives a name to the first that takes it. What is written into a job therefore
names a commit, or a wheel by its content or in the repository itself.
"""

from __future__ import annotations

import re
from importlib import metadata
from typing import Any

from ros2cc_extract.errors import InputError
from ros2cc_extract.json_text import read_json

DISTRIBUTION = 'ros2cc-extract'
MEND = (
    "name a commit, --install 'git+https://HOST/OWNER/ros2cc-extract@COMMIT' with all digits of "
    "it; a wheel, --install 'https://HOST/NAME.whl#sha256=DIGEST'; or one in the repository, "
    '--install path/NAME.whl'
)
_ADDRESS = r'[\w.~%:/@+,=-]+'
_PINNED = re.compile(
    rf'git\+(https|ssh)://{_ADDRESS}@([0-9a-f]{{40}}|[0-9a-f]{{64}})(#[\w./=&-]+)?'
    rf'|https://{_ADDRESS}\.whl#sha256=[0-9a-f]{{64}}'
    r'|(?!-)[\w./+-]+\.whl',
    re.ASCII,
)


def pinned_source(given: str | None) -> str:
    """
    What pip is to install: ``given``, by default what was installed here.

    :raises InputError: when that does not say exactly what is installed.
    """
    if given is not None:
        if _PINNED.fullmatch(given) is None:
            raise InputError(f'{given!r} does not say exactly what is installed', None, MEND)
        return given
    source = _source_of(_direct_url())
    if source is None or _PINNED.fullmatch(source) is None:
        what = 'what was installed here is in no place from which a job could install it'
        raise InputError(what, None, MEND)
    return source


def _direct_url() -> dict[str, Any]:
    """Where this tool was installed from (PEP 610); empty where pip has not kept it."""
    try:
        text = metadata.distribution(DISTRIBUTION).read_text('direct_url.json')
        data = read_json(text or '{}')
    except (metadata.PackageNotFoundError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def _source_of(origin: dict[str, Any]) -> str | None:
    url = str(origin.get('url', ''))
    commit = origin.get('vcs_info', {}).get('commit_id')
    if commit:
        return f'git+{url}@{commit}'
    digest = origin.get('archive_info', {}).get('hashes', {}).get('sha256')
    return f'{url}#sha256={digest}' if digest else None
