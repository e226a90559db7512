"""
Finding and reading verifyta, by a stand-in program that prints what the real one prints.

Layout of verdicts and runs as in Jack0Chan/PyUPPAAL (``verifyta.py``, 4.1.26) and Djekkoo/
UPPAAL-trace-parser (samples); complaints about licences as users of 5.0.0 quote them.
"""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

from ros2cc_extract.checker.api import Query, Verdict
from ros2cc_extract.errors import ToolNotFoundError
from ros2cc_extract.verify.given_queries import load_queries, verify_model
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Checker, Options
from ros2cc_extract.verify.uppaal.verifyta import LicenceError, find_verifyta, run_verifyta
from ros2cc_extract.verify.uppaal.verifyta_processes import Runs
from ros2cc_extract.verify.uppaal.verifyta_trace import read_runs
from tests.support.published import document
from tests.support.small import automaton

HEAD = r"""#!/bin/sh
for last; do :; done
printf 'Options for the verification:\n  Generating no trace\n  Search order is breadth first\n'
"""
VERDICTS = (
    HEAD
    + r"""n=0
while read -r formula; do
  n=$((n + 1))
  printf '\nVerifying formula %d at line %d\n' $n $n
  case "$formula" in
    *not*) printf '\033[2K -- Formula is NOT satisfied.\n' ;;
    *may*) printf '\033[2K -- Formula MAY be satisfied.\n' ;;
    *) printf '\033[2K -- Formula is satisfied.\n' ;;
  esac
  printf ' -- States stored : 16 states\n -- Resident memory used : 6144 KiB\n'
done < "$last"
exit 7
"""
)


def program(folder: Path, script: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / 'verifyta'
    path.write_text(script)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.mark.parametrize('runs', Runs)
def test_verdicts_are_read_from_the_text(tmp_path: Path, runs: Runs) -> None:
    answers = run_verifyta(
        program(tmp_path, VERDICTS), b'<nta/>', ['a', 'not b', 'may c'], runs=runs
    )
    assert [(a.verdict, a.states, a.peak_mb) for a in answers] == [
        (Verdict.SATISFIED, 16, 6.0),
        (Verdict.NOT_SATISFIED, 16, 6.0),
        (Verdict.UNDECIDED, 16, 6.0),
    ]


@pytest.mark.parametrize(
    'complaint',
    [
        'license key is not set.',
        'License does not cover verifier.',
        'Failed to retrieve licensee.',
    ],
)
def test_a_missing_licence_is_explained(tmp_path: Path, complaint: str) -> None:
    script = HEAD + f"echo '{complaint}' >&2\nexit 1\n"
    with pytest.raises(LicenceError, match=f'without a licence .{complaint}.*verifyta --lease'):
        run_verifyta(program(tmp_path, script), b'<nta/>', ['a'])


def test_a_refused_model_is_told_in_its_own_words(tmp_path: Path) -> None:
    script = HEAD + "echo '[error] syntax error' >&2\nexit 1\n"
    with pytest.raises(ToolNotFoundError, match=r'gave no verdict: .error. syntax error'):
        run_verifyta(program(tmp_path, script), b'<nta/>', ['a'])


def test_a_time_limit_leaves_the_rest_undecided(tmp_path: Path) -> None:
    script = HEAD + "echo 'Verifying formula 1 at line 1'\necho ' -- Formula is satisfied.'\n"
    script += 'exec sleep 60\n'
    answers = run_verifyta(program(tmp_path, script), b'<nta/>', ['a', 'b'], seconds=1)
    assert [answer.verdict for answer in answers] == [Verdict.SATISFIED, Verdict.UNDECIDED]
    assert answers[1].reason == 'time limit'


def test_it_is_looked_for_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('UPPAAL_HOME', raising=False)
    monkeypatch.setenv('PATH', str(tmp_path / 'path'))
    monkeypatch.setenv('HOME', str(tmp_path / 'home'))
    with pytest.raises(ToolNotFoundError, match='verifyta not found in UPPAAL_HOME, PATH or /opt'):
        find_verifyta()
    usual = program(tmp_path / 'home' / 'uppaal-5.0.0' / 'bin', VERDICTS)
    assert find_verifyta() == usual
    on_path = program(tmp_path / 'path', VERDICTS)
    assert find_verifyta() == on_path
    at_home = program(tmp_path / 'uppaal' / 'bin-Linux', VERDICTS)
    monkeypatch.setenv('UPPAAL_HOME', str(tmp_path / 'uppaal'))
    assert find_verifyta() == at_home
    given = program(tmp_path / 'given', VERDICTS)
    assert find_verifyta(given) == given


def test_a_given_path_that_is_no_program_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ToolNotFoundError, match='is no program'):
        find_verifyta(tmp_path)


LOCK = automaton(
    'P',
    """idle sees critical
    idle -> sees; guard: !taken
    sees -> critical; do: taken = true
    critical -> idle; do: taken = false""",
)
SAFE = 'A[] not (P0.critical and P1.critical)'
LIVE = 'P0.sees --> P0.critical'
STATE = 'State:\n( P0.%s P1.%s )\ntaken=%d #depth=0 \n\n'
MOVE = 'Transitions:\n  %s->%s { 1, tau, 1 }\n\n'
BOTH_IN = (
    STATE % ('idle', 'idle', 0)
    + MOVE % ('P0.idle', 'P0.sees')
    + STATE % ('sees', 'idle', 0)
    + MOVE % ('P1.idle', 'P1.sees')
    + STATE % ('sees', 'sees', 0)
    + MOVE % ('P0.sees', 'P0.critical')
    + STATE % ('critical', 'sees', 1)
    + MOVE % ('P1.sees', 'P1.critical')
    + STATE % ('critical', 'critical', 1)
)
ROUND = (
    STATE % ('idle', 'idle', 0)
    + MOVE % ('P0.idle', 'P0.sees')
    + STATE % ('sees', 'idle', 0)
    + MOVE % ('P1.idle', 'P1.sees')
    + STATE % ('sees', 'sees', 0)
    + MOVE % ('P1.sees', 'P1.critical')
    + STATE % ('sees', 'critical', 1)
    + MOVE % ('P1.critical', 'P1.idle')
    + STATE % ('sees', 'idle', 0)
)
VERDICT = "printf '\\nVerifying formula %d at line %d\\n -- Formula is %s.\\n%s'\n"
SHOWN = 'Showing counter example.\\n'


def verified(folder: Path, printed: str, *verdicts: tuple[str, str]) -> Verification:
    """Verify the lock by a program that prints runs and, by query, verdict and announcement."""
    script = HEAD + ''.join(
        VERDICT % (n, n, verdict, shown) for n, (verdict, shown) in enumerate(verdicts, 1)
    )
    script += f"cat >&2 <<'END'\n{printed}END\n"
    model = folder / 'lock.xml'
    system = 'P0 = P(); P1 = P(); system P0, P1;'
    model.write_text(document('bool taken;', LOCK, system))
    queries = folder / 'lock.q'
    queries.write_text(''.join(f'{formula}\n' for formula in (SAFE, LIVE)[: len(verdicts)]))
    options = Options(checker=Checker.VERIFYTA, verifyta=program(folder / 'bin', script))
    return verify_model(model, load_queries(queries), options)


def test_a_printed_run_is_replayed_and_told(tmp_path: Path) -> None:
    found = verified(tmp_path, BOTH_IN, ('NOT satisfied', SHOWN))
    (result,) = found.results
    assert (found.engine, result.verdict, found.notes) == (
        'verifyta',
        Verdict.NOT_SATISFIED,
        (),
    )
    assert result.evidence is not None
    assert [m.sentences[0].text for m in result.evidence.moments] == [
        'P0: idle -> sees',
        'P1: idle -> sees',
        'P0: sees -> critical',
        'P1: sees -> critical',
    ]


def test_each_printed_run_goes_to_the_query_that_announced_it(tmp_path: Path) -> None:
    found = verified(tmp_path, ROUND, ('NOT satisfied', ''), ('NOT satisfied', SHOWN))
    safe, live = found.results
    assert (safe.evidence, found.notes) == (None, ())
    assert live.evidence is not None
    assert (len(live.evidence.moments), live.evidence.cycle_from) == (4, 2)


def test_runs_are_dropped_when_it_is_not_clear_whose_they_are(tmp_path: Path) -> None:
    found = verified(tmp_path, ROUND, ('NOT satisfied', SHOWN), ('NOT satisfied', SHOWN))
    assert [result.evidence for result in found.results] == [None, None]


def test_a_printed_run_of_another_model_is_not_shown(tmp_path: Path) -> None:
    other = BOTH_IN.replace('taken=1', 'taken=0')
    found = verified(tmp_path, other, ('NOT satisfied', SHOWN))
    assert found.results[0].evidence is None
    assert found.notes == (
        'run of query 1 as verifyta printed it: step 3 is no transition of the model; '
        'the run must be one of this very model and query; not shown',
    )


def test_a_printed_run_that_shows_nothing_is_not_shown(tmp_path: Path) -> None:
    found = verified(tmp_path, ROUND, ('NOT satisfied', SHOWN))
    assert found.results[0].evidence is None
    assert 'its last state does not decide the query; ' in found.notes[0]


def test_a_model_that_only_verifyta_reads_gets_its_verdicts_alone(tmp_path: Path) -> None:
    script = HEAD + VERDICT % (1, 1, 'NOT satisfied', SHOWN) + f"printf '{BOTH_IN}' >&2\n"
    model = tmp_path / 'clock.xml'
    model.write_text(document('clock x; bool taken;', LOCK, 'system P;'))
    options = Options(checker=Checker.VERIFYTA, verifyta=program(tmp_path / 'bin', script))
    found = verify_model(model, [Query('A[] x < 5', '', None)], options)
    (result,) = found.results
    assert (result.verdict, result.evidence) == (Verdict.NOT_SATISFIED, None)
    assert 'clock.xml:3: ' in found.notes[0]
    assert found.notes[0].endswith('; so no run could be replayed')


def test_runs_of_several_versions_are_read() -> None:
    """With clocks and delays, without a colon, and with commas, as samples have it."""
    text = """
State
( P(0).idle Sys._id9 )
Sys.clk=0 t(0)-Sys.clk<=0, n = -3, row[1]=2 P(0).x=1

Delay: 5.5

State:
( P(0).idle Sys._id9 )
Sys.clk=5.5 n=-3 row[1]=2 P(0).x=1

Transitions:
  P(0).idle->P(0).busy { clk > min && !done, a!, 1 }
  Sys._id9->Sys._id9 { 1, a?, done := true }

State:
( P(0).busy Sys._id9 )
n=4 row[1]=2 P(0).x=1
"""
    ((first, last),) = read_runs(text)
    assert first.locations == {'P(0)': 'idle', 'Sys': '_id9'}
    assert first.variables == {'Sys.clk': 0, 'n': -3, 'row[1]': 2, 'P(0).x': 1}
    assert (last.locations['P(0)'], last.variables['n']) == ('busy', 4)


def test_runs_that_the_tracer_prints_are_read() -> None:
    text = """State: P(0).idle Sys._id9 n=0 row[1]=2 #t(0)-#time<=0 #time-#t(0)<=1

Transition: P(0).idle -> P(0).busy {1; a!; n = 1;} Sys._id9 -> Sys.on {1; a?; 1;}

State: P(0).busy Sys.on n=1 row[1]=2 #t(0)-#time<=0
"""
    ((first, last),) = read_runs(text)
    assert first.locations == {'P(0)': 'idle', 'Sys': '_id9'}
    assert (last.locations, last.variables) == (
        {'P(0)': 'busy', 'Sys': 'on'},
        {'n': 1, 'row[1]': 2},
    )
