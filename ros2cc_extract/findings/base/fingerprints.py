"""What identifies a finding across edits that move lines; for SARIF, baselines and comparisons."""

from __future__ import annotations

import hashlib
import posixpath
from collections import Counter
from collections.abc import Iterable

from ros2cc_extract.findings.base.model import Finding


def fingerprints(findings: Iterable[Finding], root: str = '') -> list[str]:
    """
    Give one fingerprint per finding, made of code, file, unit and subjects.

    Findings alike in these are counted in their order, so that none hides another.

    :param root: absolute path of the repository; files below it are taken relative to it.
    """
    seen: Counter[str] = Counter()
    found = []
    for finding in findings:
        file = relative(finding.place.file, root)
        parts = (finding.code, file, finding.unit or '', *finding.subjects)
        digest = hashlib.sha256('\0'.join(parts).encode('utf-8', 'surrogatepass')).hexdigest()[:32]
        seen[digest] += 1
        found.append(f'{digest}:{seen[digest]}')
    return found


def relative(file: str, root: str = '') -> str:
    """
    Give ``file`` relative to ``root``, both as text; a file elsewhere stays as it is.

    :param root: absolute path of the repository; empty when files are relative to it already.
    """
    path = posixpath.normpath(file.replace('\\', '/'))
    base = posixpath.normpath(root.replace('\\', '/')).rstrip('/') if root else ''
    return path[len(base) + 1 :] if base and path.startswith(f'{base}/') else path
