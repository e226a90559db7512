"""JUnit XML as ament linters write it."""

from __future__ import annotations

from xml.etree import ElementTree

from report_samples import FINDINGS, NOTE

from ros2cc_extract.report.machine.junit import junit

FILES = ['src/arm node.py', 'other.py', 'clean.py']


def test_a_case_fails_per_finding_and_passes_per_clean_file() -> None:
    suite = ElementTree.fromstring(junit(FINDINGS, FILES, 'arm_driver'))
    assert suite.attrib == {
        'name': 'arm_driver.ros2cc',
        'tests': '4',
        'errors': '0',
        'failures': '2',
        'time': '0',
    }
    cases = {case.get('name'): case.find('failure') is not None for case in suite.iter('testcase')}
    assert cases == {
        'CC101 (src/arm node.py:40:9)': True,
        'CC301 (src/arm node.py:30:9)': True,
        'clean.py': False,
        'other.py': False,
    }


def test_the_failure_holds_chain_and_help() -> None:
    suite = ElementTree.fromstring(junit(FINDINGS, FILES, 'arm_driver'))
    failure = suite.find('testcase/failure')
    assert failure is not None
    assert failure.text == (
        'src/arm node.py:40:9: CC101 drive waits for "plan": <for ever>, 100 %\n'
        'src/arm node.py:20:9: drive calls from here\n'
        'src/arm node.py:10:9: client is created here\n'
        'help: give the client a group'
    )


def test_notes_do_not_fail_and_what_xml_forbids_is_escaped() -> None:
    suite = ElementTree.fromstring(junit([NOTE], [], 'arm'))
    assert suite.get('failures') == '0'
    assert (suite.findtext('system-out') or '').endswith('\\na parameter\\x00')


def test_the_last_line_stands_behind_the_notes() -> None:
    suite = ElementTree.fromstring(junit([NOTE], [], 'arm', line='Found 1 note in 1 file'))
    lines = (suite.findtext('system-out') or '').splitlines()
    assert lines[-1] == 'Found 1 note in 1 file'
    clean = ElementTree.fromstring(junit([], [], 'arm', line='No problems found in 1 file'))
    assert clean.findtext('system-out') == 'No problems found in 1 file'
