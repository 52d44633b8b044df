# SPDX-License-Identifier: Apache-2.0
"""The command launch_test, and the plugin of pytest."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from launch_testing.junitxml import unittestResultsToXml
from launch_testing.launch_test import main
from launch_testing.test_result import Outcome, TestResult
import pytest

File = Callable[..., Path]
Command = Callable[..., Any]

PYTEST = ('pytest', '-p', 'no:cacheprovider', '--strict-markers', '-q')
SAMPLE = """
@pytest.mark.launch_test
@launch_testing.parametrize('code', [0, 3])
def generate_test_description(code):
    return LaunchDescription([
        DeclareLaunchArgument('word', default_value='hello', description='A word.'),
        ExecuteProcess(cmd=['echo', LaunchConfiguration('word')]),
        KeepAliveProc(),
        ReadyToTest(),
    ])

class TestIt(unittest.TestCase):
    def test_word(self, proc_output, test_args):
        proc_output.assertWaitFor(test_args['word'], timeout=100)
    def test_code(self, code):
        assert code == 0, 'wrong code'
"""


def test_command(launch_file: File, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The status tells whether all went well; the report has a suite for each run."""
    report = tmp_path / 'report.xml'
    path = launch_file(SAMPLE)
    assert main([str(path), 'word:=bye', '--package-name', 'p', '--junit-xml', str(report)]) == 1
    assert 'AssertionError: wrong code' in capfd.readouterr().err
    root = ElementTree.parse(report).getroot()
    assert (root.get('tests'), root.get('failures'), root.get('errors')) == ('4', '1', '0')
    assert [suite.get('name') for suite in root] == [
        'sample_launch[code=0]',
        'sample_launch[code=3]',
    ]
    case = root[1][0]
    assert case.get('classname') == 'p.sample_launch.sample_launch[code=3].TestIt'
    assert case[0].get('message') == 'AssertionError: wrong code'


def test_show_args(launch_file: File, capsys: pytest.CaptureFixture[str]) -> None:
    """The arguments of the launch description are listed, and nothing runs."""
    assert main([str(launch_file(SAMPLE)), '--show-args']) == 0
    assert capsys.readouterr().out == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n"
        "    'word':\n        A word.\n        (default: 'hello')\n"
    )


def test_command_errors(launch_file: File, capsys: pytest.CaptureFixture[str]) -> None:
    """Wrong files and arguments are told in a sentence."""
    with pytest.raises(SystemExit):
        main(['/nowhere.py'])
    assert "the launch test '/nowhere.py' does not exist" in capsys.readouterr().err
    assert main([str(launch_file('')), '-v']) == 1
    assert main([str(launch_file(SAMPLE)), 'word=x']) == 1
    assert capsys.readouterr().err.splitlines()[1:] == [
        "launch_test: malformed launch argument 'word=x', expected format '<name>:=<value>'"
    ]


def test_report_holds_any_text() -> None:
    """Control characters, which XML forbids, do not spoil the report."""
    result = TestResult(None, True, 1)
    result.outcomes = [
        Outcome('C', 't', 'error', 'a\x1bb', 0.5),
        Outcome('C', 's', 'skipped', '', 0),
    ]
    tree = unittestResultsToXml(test_results={'run': result})
    root = ElementTree.fromstring(ElementTree.tostring(tree.getroot()))
    assert root[0][0][0].text == 'a?b' and root[0].get('skipped') == '1'


def test_pytest(launch_file: File, command: Command, tmp_path: Path) -> None:
    """Each run is an item of pytest; its single tests are in the report, and why one failed."""
    path = launch_file(SAMPLE, 'test_sample.py')
    result = command(*PYTEST, path, '--junit-xml', 'report.xml')
    assert '1 failed, 1 passed' in result.stdout, result.stdout + result.stderr
    assert 'TestIt.test_code\nTraceback' in result.stdout and 'wrong code' in result.stdout
    cases = list(ElementTree.parse(tmp_path / 'report.xml').getroot().iter('testcase'))
    assert [case.get('name') for case in cases] == ['test_sample[code=0]', 'test_sample[code=3]']
    assert {each.get('name'): each.get('value') for each in cases[1].iter('property')} == {
        'TestIt.test_word': 'passed',
        'TestIt.test_code': 'failed',
    }


def test_pytest_arguments_and_selection(launch_file: File, command: Command) -> None:
    """Arguments reach the launch description, and a run can be selected."""
    path = launch_file(SAMPLE, 'test_sample.py')
    result = command(*PYTEST, f'{path}::test_sample[code=0]', '--launch-args', 'word:=bye')
    assert '1 passed' in result.stdout, result.stdout


def test_pytest_restores_the_environment(launch_file: File, command: Command) -> None:
    """What a launch sets in the environment does not reach other tests."""
    set_it = """
import os
from launch.actions import SetEnvironmentVariable

@pytest.mark.launch_test
def generate_test_description():
    os.environ['LEAKED'] = 'x'
    leak = SetEnvironmentVariable('LEAKED', 'y')
    return LaunchDescription([leak, KeepAliveProc(), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_it(self): assert os.environ['LEAKED'] == 'y'
"""
    first = launch_file(set_it, 'test_a.py')
    second = launch_file(
        "def test_it():\n    import os; assert 'LEAKED' not in os.environ\n", 'test_b.py'
    )
    result = command(*PYTEST, first, second)
    assert '2 passed' in result.stdout, result.stdout


def test_pytest_leaves_other_files_alone(launch_file: File, command: Command) -> None:
    """A file with another function of that name, or only a mark, is an ordinary one."""
    text = '# pytest.mark.launch_test\ndef test_it(): pass\n'
    result = command(*PYTEST, launch_file(text, 'test_sample.py'))
    assert '1 passed' in result.stdout


def test_pytest_costs_nothing_if_unused(tmp_path: Path, command: Command) -> None:
    """Nothing of launch is imported for ordinary tests."""
    path = tmp_path / 'test_plain.py'
    path.write_text(
        'import sys\n\ndef test_it():\n'
        "    assert not {'launch.action', 'launch_testing.loader', 'rclpy'} & set(sys.modules)\n"
    )
    result = command(*PYTEST, path)
    assert '1 passed' in result.stdout, result.stdout
