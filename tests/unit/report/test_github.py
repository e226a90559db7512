"""GitHub annotations and the step summary."""

from __future__ import annotations

from dataclasses import replace

from report_samples import CALL, NOTE, RACE, at

from ros2cc_extract.report.machine.github import MOST_ROWS, step_summary, workflow_commands


def test_an_annotation_is_one_escaped_line() -> None:
    assert workflow_commands([CALL]) == (
        '::error file=src/arm node.py,line=40,col=9,title=CC101::'
        'drive waits for "plan": <for ever>, 100 %25%0A'
        'src/arm node.py:20: drive calls from here%0A'
        'src/arm node.py:10: client is created here%0A'
        'help: give the client a group\n'
    )


def test_properties_escape_what_separates_them() -> None:
    text = workflow_commands([replace(RACE, place=at(3, 'a,b:c.py'))])
    assert text.startswith('::warning file=a%2Cb%3Ac.py,line=3,col=9,title=CC301::')


def test_ten_of_a_kind_the_most_important_first() -> None:
    races = [replace(RACE, place=at(line)) for line in range(30, 10, -1)]
    first = replace(RACE, code='CC201', place=at(99))
    lines = workflow_commands([*races, first, CALL]).splitlines()
    assert len(lines) == 11
    assert lines[0].startswith('::error ')
    assert 'title=CC201' in lines[1]
    assert 'line=11,' in lines[2]


def test_the_summary_holds_all_findings_with_the_notes_folded() -> None:
    assert step_summary([NOTE, RACE, CALL], {'files': 2, 'errors': 1}) == (
        '## ros2cc-extract\n\n'
        'Found 1 error in 2 files\n\n'
        'CC101: 1, CC301: 1\n\n'
        '| | code | place | what | help |\n'
        '|---|---|---|---|---|\n'
        '| 🔴 | CC101 | `src/arm node.py:40` | drive waits for "plan": &lt;for ever>, 100 % | '
        'give the client a group |\n'
        '| 🟠 | CC301 | `src/arm node.py:30` | tick updates Arm.count \\| too |  |\n\n'
        '<details><summary>1 note: CC501: 1</summary>\n\n'
        '| | code | place | what | help |\n'
        '|---|---|---|---|---|\n'
        '| 🔵 | CC501 | `other.py` | topic of tick not resolved:\\\\na parameter\\\\x00 |  |\n\n'
        '</details>\n'
    )


def test_a_summary_too_long_for_github_ends_with_a_number() -> None:
    races = [replace(RACE, place=at(line)) for line in range(1, 600)]
    text = step_summary([*races, NOTE], {'files': 2})
    assert text.count('\n| 🟠 |') == MOST_ROWS
    assert '\n99 more: see the log, or --output-format json.\n' in text
    assert text.endswith(
        '<details><summary>1 note: CC501: 1</summary>\n\n'
        '1 more: see the log, or --output-format json.\n\n</details>\n'
    )


def test_the_summary_says_when_there_is_nothing() -> None:
    assert step_summary([], {'files': 2, 'units': 1}).endswith('No problems found in 2 files\n')
