"""The help text of a rule, on a terminal and as a page of the documentation."""

from __future__ import annotations

from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.findings.rules.registry import BY_CODE, BY_SLUG, RULES


def explain(code: str) -> str:
    """
    Give the page of a rule, by its code or its slug.

    :raises InputError: when there is no such rule.
    """
    rule = BY_CODE.get(code.upper()) or BY_SLUG.get(code.lower())
    if rule is None:
        raise InputError(f'no rule {code!r}', None, f'the rules are {", ".join(sorted(BY_CODE))}')
    return page(rule)


def page(rule: Rule) -> str:
    """Write the Markdown page of a rule."""
    return f"""\
# {rule.code} {rule.slug}: {rule.title}

Severity: {rule.severity.value}

## What

{rule.what}

## Why

{rule.why}

## Example

```{rule.language}
{rule.bad.rstrip()}
```

Mended:

```python
{rule.good.rstrip()}
```

## How to mend

{rule.mend}

A finding that is meant to be so: `# ros2cc: ignore[{rule.code}] reason` on its line.
"""


def index() -> str:
    """Write the Markdown page that lists all rules."""
    rows = [
        f'| [{rule.code}]({rule.code}.md) | {rule.slug} | {rule.title} | {rule.severity.value} |'
        for rule in RULES
    ]
    return '\n'.join(
        [
            '# Rules',
            '',
            'Errors and warnings make the exit status 1, notes never do. A finding is given only',
            'when the facts it rests on are known; what is not known is listed as CC501. A file',
            'that cannot be read is reported as CC500 and leaves the exit status to the others,',
            'unless `--strict` is given or there are no others.',
            '',
            '| code | name | reports | severity |',
            '|---|---|---|---|',
            *rows,
            '',
        ]
    )


def pages() -> dict[str, str]:
    """All pages of ``docs/rules``, by file name."""
    return {'README.md': index(), **{f'{rule.code}.md': page(rule) for rule in RULES}}
