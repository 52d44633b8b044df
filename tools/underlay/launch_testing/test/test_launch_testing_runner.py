# SPDX-License-Identifier: Apache-2.0
"""How launch tests run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import re
import time
from typing import Any

from launch_testing.observation import Observation
from launch_testing.test_runner import SingleRun
import pytest

RunTest = Callable[..., Any]

GOOD = """
def generate_test_description():
    talker = TALKER
    return LaunchDescription([
        DeclareLaunchArgument('word', default_value='none', description='A word.'),
        talker,
        ExecuteProcess(cmd=['echo', LaunchConfiguration('word')]),
        KeepAliveProc(),
        ReadyToTest(),
    ]), {'talker': talker}

class TestIt(unittest.TestCase):
    def test_output(self, proc_output, proc_info, talker, test_args):
        proc_output.assertWaitFor('hello', process=talker, timeout=100)
        proc_output.assertWaitFor('oops', process=self.talker, timeout=100, stream='stderr')
        proc_output.assertWaitFor(test_args['word'], process='echo', timeout=100)
        proc_info.assertWaitForShutdown(process='echo', timeout=100)
        assert not proc_info.waitForShutdown(talker, timeout=0.01)

@launch_testing.post_shutdown_test()
class TestAfter(unittest.TestCase):
    def test_end(self, proc_info, proc_output, talker):
        assertExitCodes(proc_info)
        with assertSequentialStdout(proc_output, talker) as checker:
            checker.assertInStdout('hello')
            checker.assertInStdout('bye')
"""


def test_success(run: RunTest) -> None:
    """Tests run while the processes do, and others after their end in order."""
    outcome = run(GOOD, 'word:=something')
    assert outcome.outcomes == [('test_output', 'passed'), ('test_end', 'passed')], outcome.text
    assert outcome.result.wasSuccessful()


PASSIVE = """
class TestIt(unittest.TestCase):
    def test_a(self): pass
    def test_b(self, proc_output): proc_output.assertWaitFor('never', timeout=1000)
    def test_c(self): pass
"""


ENDS = """
def generate_test_description():
    return LaunchDescription([ReadyToTest(), ExecuteProcess(cmd=['sh', '-c', 'echo a; exit 3'])])
"""


def check_end(outcome: Any) -> None:
    """Check that tests have ended with the processes, and that their last output is shown."""
    text = outcome.result.outcomes[-1].message
    assert not outcome.result.wasSuccessful()
    assert text.startswith('All processes of the launch ended before the tests were done.')
    assert re.search(r'sh-\d+: ended with exit code 3\n  The last output of .*\n    a$', text)
    assert 'test_c' not in dict(outcome.outcomes)


def test_end_before_the_tests_are_done(run: RunTest) -> None:
    """When all processes have ended, tests end, and the last output is shown."""
    check_end(run(ENDS + PASSIVE))


def test_end_before_the_first_test(run: RunTest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also if all processes end before the thread of the tests has noticed that they may begin."""
    work = SingleRun._work

    def work_late(self: SingleRun) -> None:
        while not self._observation.is_closed:
            time.sleep(0.01)
        work(self)

    monkeypatch.setattr(SingleRun, '_work', work_late)
    check_end(run(ENDS + PASSIVE))


def test_no_test_begins_after_the_end(
    run: RunTest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also if the runner is held up just when the wait of the current test has ended."""
    close = Observation.close

    def close_slowly(observation: Observation) -> None:
        close(observation)
        time.sleep(0.5)

    monkeypatch.setattr(Observation, 'close', close_slowly)
    waits = f'until [ -e "{tmp_path}/begun" ]; do sleep 0.05; done'
    outcome = run(
        f"""
def generate_test_description():
    return LaunchDescription([ReadyToTest(), ExecuteProcess(cmd=['sh', '-c', {waits!r}])])

class TestIt(unittest.TestCase):
    def test_b(self, proc_output):
        open({str(tmp_path / 'begun')!r}, 'w').close()
        proc_output.assertWaitFor('never', timeout=1000)
    def test_c(self): pass
"""
    )
    assert 'test_b' in dict(outcome.outcomes)
    assert 'test_c' not in dict(outcome.outcomes)


def test_keep_alive(run: RunTest) -> None:
    """A launch that is kept alive stays without processes."""
    outcome = run(
        """
@launch_testing.markers.keep_alive
def generate_test_description():
    return LaunchDescription([ExecuteProcess(cmd=['true']), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_a(self, proc_info): proc_info.assertWaitForShutdown('true', timeout=100)
    def test_b(self, proc_info): pass
"""
    )
    assert outcome.outcomes == [('test_a', 'passed'), ('test_b', 'passed')]


def test_failing_launch(run: RunTest) -> None:
    """An error of the launch is told with its text; no test after the end runs."""
    outcome = run(
        """
def generate_test_description():
    return LaunchDescription([OpaqueFunction(function=lambda context: 1 / 0), ReadyToTest()])
"""
        + PASSIVE
    )
    (problem,) = outcome.result.problems()
    assert problem.message.startswith('The launch failed before it was ready: division by zero')
    assert problem.message.endswith('No process was started.')


def test_lines_of_a_failing_launch(run: RunTest, capfd: pytest.CaptureFixture[str]) -> None:
    """The error of a launch names lines of the test, none of the one who runs it."""
    run(
        """
def generate_test_description():
    return LaunchDescription([ExecuteProcess(cmd=[LaunchConfiguration('typo')]), ReadyToTest()])
"""
    )
    text = capfd.readouterr().out
    assert '(ExecuteProcess)' in text and 'included from' not in text


def test_never_ready(run: RunTest) -> None:
    """A launch that does not become ready in time is shut down, and the reason is told."""
    outcome = run(
        """
def generate_test_description():
    return LaunchDescription([KeepAliveProc()])
"""
        + PASSIVE,
        ready_timeout_s=0.3,
    )
    (problem,) = outcome.result.problems()
    assert 'was not ready after 0.3 s: its description must contain the action' in problem.message


def test_every_ready_to_test_is_awaited(run: RunTest) -> None:
    """Tests begin when the last of several actions was visited."""
    outcome = run(
        """
def generate_test_description():
    late = TimerAction(period=0.2, actions=[ExecuteProcess(cmd=['true']), ReadyToTest()])
    return LaunchDescription([KeepAliveProc(), ReadyToTest(), late])

class TestIt(unittest.TestCase):
    def test_a(self, proc_info): proc_info.assertWaitForStartup('true', timeout=5)
"""
    )
    assert outcome.result.wasSuccessful(), outcome.text


def test_failing_tests(run: RunTest) -> None:
    """Failures, errors and skips are told apart, and those of one phase do not hide the other."""
    outcome = run(
        """
def generate_test_description():
    return LaunchDescription([KeepAliveProc(), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_a(self): assert 1 == 2
    def test_b(self): raise RuntimeError('b')
    @unittest.skip('c')
    def test_c(self): pass
    def test_d(self):
        with self.subTest('d'): self.fail('d')
    @unittest.expectedFailure
    def test_e(self): pass
    @unittest.expectedFailure
    def test_f(self): self.fail('f')

@launch_testing.post_shutdown_test()
class TestAfter(unittest.TestCase):
    def test_z(self): pass
"""
    )
    assert outcome.outcomes == [
        ('test_a', 'failed'),
        ('test_b', 'error'),
        ('test_c', 'skipped'),
        ('test_d', 'failed'),
        ('test_e', 'failed'),
        ('test_f', 'passed'),
        ('test_z', 'passed'),
    ]


def test_unknown_argument(run: RunTest) -> None:
    """A test that asks for what nobody has is told so."""
    outcome = run(
        """
def generate_test_description():
    return LaunchDescription([KeepAliveProc(), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_a(self, proc_inf): pass
"""
    )
    (problem,) = outcome.result.problems()
    assert problem.message.endswith("Did you mean 'proc_info'?")


def test_interrupt(run: RunTest) -> None:
    """Ctrl-C ends the launch and the tests."""
    with pytest.raises(KeyboardInterrupt):
        run(
            """
import os, signal

def generate_test_description():
    return LaunchDescription([KeepAliveProc(), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_a(self, proc_output):
        os.kill(os.getpid(), signal.SIGINT)
        proc_output.assertWaitFor('never', timeout=1000)
"""
        )


def test_processes_in_a_test(run: RunTest) -> None:
    """A test may start further processes, look at them, and end them."""
    outcome = run(
        """
from launch_testing.tools import expect_output, launch_process

def generate_test_description():
    return LaunchDescription([KeepAliveProc(), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_end(self, launch_service, proc_info, proc_output):
        action = ExecuteProcess(cmd=['sh', '-c', 'echo a; echo b >&2; exit 3'])
        with launch_process(launch_service, action, proc_info, proc_output) as process:
            assert process.wait_for_shutdown(timeout=100)
        assert process.terminated and process.exit_code == 3
        assert (process.stdout, process.stderr) == ('a\\n', 'b\\n')

    def test_stop(self, launch_service, proc_info, proc_output):
        with launch_process(
            launch_service, TALKER, proc_info, proc_output, output_filter=str.upper
        ) as process:
            assert process.wait_for_output(lambda text: 'HELLO' in text, timeout=100)
            assert process.running
            with self.assertRaises(RuntimeError): process.exit_code
        assert process.exit_code == 0
        assert expect_output(expected_lines=['HELLO', 'BYE'], text=process.stdout, strict=True)
"""
    )
    assert outcome.result.wasSuccessful(), outcome.text


def test_ready_by_output(run: RunTest) -> None:
    """A process may tell by its output when the tests begin."""
    outcome = run(
        """
from launch.actions import RegisterEventHandler
from launch_testing.event_handlers import StdoutReadyListener

def generate_test_description():
    talker = TALKER
    listener = StdoutReadyListener(
        target_action=talker, ready_txt='hello', actions=[ReadyToTest()])
    return LaunchDescription([RegisterEventHandler(listener), talker])

class TestIt(unittest.TestCase):
    def test_a(self, proc_output): assertInStdout(proc_output, 'hello', 'talker')
"""
    )
    assert outcome.result.wasSuccessful(), outcome.text
