# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 doctor`: its output and exit status, extensions, and a graph with faults."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import socket
import subprocess
import sys
import time

import pytest
from ros2cli.cli import main
from ros2cli.entry import Entry
from ros2doctor.api import DoctorCheck, DoctorReport, Report, Result
from ros2doctor.verb import hello
from ros2doctor.verb.hello import MulticastGroup, table

Ros2 = Callable[..., subprocess.CompletedProcess[str]]
HERE = 'test_ros2doctor_command_extensions'
PATIENCE_S = 100.0


class FineCheck(DoctorCheck):
    """A check that finds nothing."""

    def category(self) -> str:
        """Return the name."""
        return 'fine'

    def check(self) -> Result:
        """Return nothing."""
        return Result()


class WarningCheck(DoctorCheck):
    """A check that warns."""

    def category(self) -> str:
        """Return the name."""
        return 'shaky'

    def check(self) -> Result:
        """Return a warning, as a check of another package does."""
        result = Result()
        result.add_warning('It creaks')
        return result


class ErrorCheck(DoctorCheck):
    """A check that finds an error."""

    def category(self) -> str:
        """Return the name."""
        return 'broken'

    def check(self) -> Result:
        """Return an error."""
        result = Result()
        result.add_error('It is broken', 'nothing works', 'glue it')
        return result


class FailingCheck(DoctorCheck):
    """A check with a mistake in itself."""

    def category(self) -> str:
        """Return the name."""
        return 'careless'

    def check(self) -> Result:
        """Fail."""
        raise ZeroDivisionError('division by zero')


class FailingReport(DoctorReport):
    """A report with a mistake in itself."""

    def category(self) -> str:
        """Return the name."""
        return 'careless'

    def report(self) -> Report:
        """Fail."""
        raise ZeroDivisionError('division by zero')


class BrokenReport(DoctorReport):
    """A report."""

    def category(self) -> str:
        """Return the name."""
        return 'broken'

    def report(self) -> Report:
        """Return two lines."""
        report = Report('PARTS')
        report.add_to_report('arm', 1)
        report.add_to_report('finger', 'none')
        return report


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Return a function that replaces all checks, and leaves one report."""
    monkeypatch.setitem(sys.modules, HERE, sys.modules[__name__])
    monkeypatch.setattr('ros2doctor.api.examining.entries_of_group', lambda group: {})

    def replace(*names: str) -> None:
        table = {name: Entry(f'{HERE}:{name}', '') for name in names}
        monkeypatch.setattr('ros2doctor.api.examining.CHECKS', table)
        report = {'broken': Entry(f'{HERE}:BrokenReport', '')}
        monkeypatch.setattr('ros2doctor.api.examining.REPORTS', report)

    return replace


def test_all_is_well(checks: Callable[..., None], capsys: pytest.CaptureFixture[str]) -> None:
    """Without findings there is one sentence."""
    checks('FineCheck', 'FineCheck2')
    with pytest.warns(UserWarning, match='FineCheck2'):
        assert main(['doctor']) == 0
    assert capsys.readouterr().out == '\nAll 1 checks passed\n\n'


def test_warning_is_no_failure(
    checks: Callable[..., None], capsys: pytest.CaptureFixture[str]
) -> None:
    """A warning is shown; it is a failure only with --include-warnings."""
    checks('FineCheck', 'WarningCheck')
    assert main(['doctor']) == 0
    output = '\nWARNING (shaky): It creaks\n'
    assert capsys.readouterr().out == f'{output}\nAll 2 checks passed\n\n'
    assert main(['wtf', '-iw']) == 1
    failure = '\n1/2 check(s) failed\n\nFailed modules: shaky\n\n'
    assert capsys.readouterr().out == output + failure


def test_error_is_a_failure(
    checks: Callable[..., None], capsys: pytest.CaptureFixture[str]
) -> None:
    """An error comes with why it matters and what mends it; the report follows if asked for."""
    checks('ErrorCheck', 'FineCheck')
    assert main(['doctor', '-rf']) == 1
    assert capsys.readouterr().out == (
        '\nERROR (broken): It is broken\n'
        '    why it matters: nothing works\n'
        '    to fix it: glue it\n'
        '\n1/2 check(s) failed\n\nFailed modules: broken\n\n'
        '\n   PARTS\narm    : 1\nfinger : none\n'
    )


def test_report_has_all(checks: Callable[..., None], capsys: pytest.CaptureFixture[str]) -> None:
    """The report has all sections and all findings, and has succeeded in any case."""
    checks('ErrorCheck')
    assert main(['doctor', '--report']) == 0
    output = capsys.readouterr().out
    assert '\n   PARTS\narm    : 1\n' in output
    assert '\n   FINDINGS\n\nERROR (broken): It is broken\n' in output


def test_failing_check(
    checks: Callable[..., None],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A check or report with a mistake is named, and the others still run."""
    checks('FailingCheck', 'ErrorCheck')
    report = {'careless': Entry(f'{HERE}:FailingReport', '')}
    monkeypatch.setattr('ros2doctor.api.examining.REPORTS', report)
    assert main(['doctor', '-rf']) == 1
    assert capsys.readouterr().out == (
        '\nERROR (careless): the check itself failed: ZeroDivisionError: division by zero\n'
        '    why it matters: its subject was not checked\n'
        '\nERROR (broken): It is broken\n'
        '    why it matters: nothing works\n'
        '    to fix it: glue it\n'
        '\n2/2 check(s) failed\n\nFailed modules: broken careless\n\n'
        '\n   CARELESS\nnot available : ZeroDivisionError: division by zero\n'
    )


def test_report_or_failed_ones() -> None:
    """The two kinds of reports exclude each other."""
    assert main(['doctor', '-r', '-rf']) == 2


def test_checks_of_others(
    checks: Callable[..., None],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A check of another distribution is found by its entry point."""
    checks('FineCheck')
    entry = {'other': Entry(f'{HERE}:ErrorCheck', '')}
    monkeypatch.setattr(
        'ros2doctor.api.examining.entries_of_group',
        lambda group: entry if group == 'ros2doctor.checks' else {},
    )
    assert main(['doctor']) == 1
    assert '1/2 check(s) failed' in capsys.readouterr().out


@pytest.fixture
def faulty_graph(ros_environment_variables: dict[str, str]) -> Iterator[None]:
    """Run nodes that do not understand each other."""
    process = subprocess.Popen(
        [sys.executable, str(Path(__file__).with_name('faulty_graph.py'))],
        env=ros_environment_variables,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == 'ready\n'
        yield
    finally:
        process.terminate()
        process.communicate(timeout=PATIENCE_S)


@pytest.mark.usefixtures('faulty_graph')
def test_faults_of_a_graph(ros2: Ros2, tmp_path: Path) -> None:
    """A real graph is examined: quality of service, names and frames; the report lists it."""
    end = time.monotonic() + PATIENCE_S
    expected = (
        "ERROR (qos): on '/image', the QoS that '/camera' offers does not satisfy '/viewer'",
        "WARNING (nodes): 2 nodes have the name '/viewer'",
        'ERROR (clock): use_sim_time is true, but there is no publisher on /clock: /walker\n',
        "WARNING (frames): on '/tf' there are 2 frame trees, with the roots map, base_link",
    )
    result = ros2('doctor', '--exclude-packages', cwd=tmp_path)
    while not all(text in result.stdout for text in expected) and time.monotonic() < end:
        result = ros2('doctor', '--exclude-packages', cwd=tmp_path)
    for text in expected:
        assert text in result.stdout
    assert result.returncode == 1
    assert 'Failed modules: ' in result.stdout
    assert 'start a publisher of /clock first' in result.stdout
    assert 'other machines' not in result.stdout
    report = ros2('doctor', '--report', cwd=tmp_path)
    assert report.returncode == 0
    for title in ('PLATFORM INFORMATION', 'NETWORK CONFIGURATION', 'PACKAGE VERSIONS'):
        assert f'\n   {title}\n' in report.stdout


def test_rclpy_that_ends_the_process(ros2: Ros2, tmp_path: Path) -> None:
    """Where rclpy ends each process that imports it, the doctor still says so."""
    result = ros2(
        'doctor', '-ep', cwd=tmp_path, extra={'RMW_IMPLEMENTATION': 'rmw_nobody_has_this'}
    )
    assert result.returncode == 1
    assert "RMW_IMPLEMENTATION is 'rmw_nobody_has_this', for which PyPI has no wheel" in (
        result.stdout
    )
    assert 'ERROR (rclpy): rclpy does not start: ' in result.stdout
    assert 'the running nodes were not examined' in result.stdout
    assert '2/14 check(s) failed\n\nFailed modules: environment rclpy\n' in result.stdout


@pytest.mark.parametrize(
    ('variables', 'sentence'),
    [
        (
            {'ROS_DOMAIN_ID': 'x'},
            "ERROR (network): ROS_DOMAIN_ID is 'x', which is not a whole number",
        ),
        (
            {'ROS_DISTRO': 'humble'},
            "ERROR (environment): ROS_DISTRO is 'humble' instead of 'jazzy'",
        ),
        (
            {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'near'},
            "ERROR (network): ROS_AUTOMATIC_DISCOVERY_RANGE is 'near', which is not one of "
            'SUBNET, ',
        ),
    ],
)
def test_real_faults_of_the_shell(
    variables: dict[str, str], sentence: str, ros2: Ros2, tmp_path: Path
) -> None:
    """A wrong variable of the shell is found by the command itself, which still ends."""
    result = ros2('doctor', '-ep', cwd=tmp_path, extra=variables)
    assert result.returncode == 1
    assert f'\n{sentence}' in result.stdout
    assert 'Traceback' not in result.stdout + result.stderr


def test_another_python_in_front(ros2: Ros2, tmp_path: Path) -> None:
    """Where PATH leads to another Python, that is the one thing to say about programs."""
    (tmp_path / 'python3').symlink_to(sys.executable)
    path = f'{tmp_path}{os.pathsep}{os.environ["PATH"]}'
    result = ros2('doctor', '-ep', cwd=tmp_path, extra={'PATH': path})
    assert result.returncode == 1
    assert (
        f"\nERROR (environment): `python3` is '{tmp_path}/python3', outside of " in result.stdout
    )
    assert result.stdout.count('ERROR') == 1


def test_hello_hears_itself(ros2: Ros2) -> None:
    """A lone host hears its own greetings on the topic."""
    result = ros2('doctor', 'hello', '--once', '--print-period', '2')
    lines = result.stdout.splitlines()
    assert result.returncode == 0
    assert 'MULTIMACHINE COMMUNICATION SUMMARY' in lines
    [own] = [line for line in lines if '(this process)' in line]
    assert int(own.split()[-2]) > 0


def test_hello_without_its_port(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A port that another program uses for itself is named; greetings go on by topic."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(('', 0))
        monkeypatch.setattr(hello, 'PORT', other.getsockname()[1])
        with MulticastGroup(1) as group:
            group.send('a/1')
            assert list(group.received()) == []
    words = 'multicast does not work on this machine: Address already in use\n'
    assert capsys.readouterr().out == words


def test_hello_table() -> None:
    """Each process has a line with what came by topic and by multicast."""
    from collections import Counter

    text = table('/hear', Counter({'a/1': 10, 'b/2': 3}), Counter({'a/1': 9}), 'a/1')
    assert text.splitlines()[2:] == [
        'a/1 (this process)    10               9',
        'b/2                    3               0',
    ]
