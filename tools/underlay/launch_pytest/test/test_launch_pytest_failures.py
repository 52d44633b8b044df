# SPDX-License-Identifier: Apache-2.0
"""How failures of tests and launches are told."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Run = Callable[..., Any]


def test_failing_launch(run: Run) -> None:
    """A launch that fails before it is ready is an error, with its text."""
    report = run("""
@launch_pytest.fixture
def broken():
    return LaunchDescription([OpaqueFunction(function=lambda context: 1 / 0)])

@pytest.mark.launch(fixture=broken)
def test_it(): pass
""")
    assert report.outcomes == [('test_it', 'ERROR')]
    assert '\nThe launch failed before it was ready: division by zero\n' in report.text


def test_teardown_after_failures(run: Run) -> None:
    """A fixture is torn down even if its launch fails at the start or at the shutdown."""
    report = run("""
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnShutdown

FAIL = OpaqueFunction(function=lambda context: 1 / 0)

@launch_pytest.fixture
def broken():
    yield LaunchDescription([FAIL])
    print('broken is torn down')

@launch_pytest.fixture
def broken_later():
    yield LaunchDescription([RegisterEventHandler(OnShutdown(on_shutdown=[FAIL]))])
    print('broken_later is torn down')

@pytest.mark.launch(fixture=broken)
def test_start(): pass

@pytest.mark.launch(fixture=broken_later)
def test_end(): pass
""")
    assert ('test_start', 'ERROR') in report.outcomes, report.text
    assert ('test_end', 'ERROR') in report.outcomes, report.text
    for name in ('broken', 'broken_later'):
        assert f'\n{name} is torn down\n' in report.text, report.text


def test_launch_that_fails_meanwhile(run: Run) -> None:
    """A launch that fails during a test lets it fail at once."""
    report = run("""
@launch_pytest.fixture
def late():
    fail = OpaqueFunction(function=lambda context: 1 / 0)
    return LaunchDescription([TimerAction(period=0.2, actions=[fail])])

@pytest.mark.launch(fixture=late)
async def test_it(): await asyncio.sleep(1000)
""")
    assert ('test_it', 'FAILED') in report.outcomes, report.text
    assert 'The launch failed before the tests were done: division by zero' in report.text


def test_failing_test(run: Run) -> None:
    """The report of a failure shows how the processes are, and their last output."""
    report = run("""
@pytest.mark.launch(fixture=it)
def test_it(it, launch_context):
    assert said(it[1], launch_context)
    tools.assert_output_sync(launch_context, it[1], lambda output: 'never' in output, 0.01)

@pytest.mark.launch(fixture=it)
async def test_validation(it, launch_context):
    def validate(output):
        assert output == 'nothing'
    await tools.assert_stderr(launch_context, it[1], validate, 0.01)
""")
    assert report.outcomes == [('test_it', 'FAILED'), ('test_validation', 'FAILED')]
    assert "the standard output of 'sh-1' is not what the test waits for:\nE   " in report.text
    assert "  The last output of 'sh-1':\n    hello" in report.text
    assert "== 'nothing'" in report.text


def test_first_part_fails(run: Run) -> None:
    """A test that did not come to its yield is not continued."""
    report = run("""
@pytest.mark.launch(fixture=shared)
def test_it(shared):
    assert 1 == 2
    yield

@pytest.mark.launch(fixture=it)
def test_twice():
    yield
    yield
""")
    assert report.outcomes == [
        ('test_it', 'FAILED'),
        ('test_it[shutdown]', 'SKIPPED'),
        ('test_twice', 'FAILED'),
    ], report.text
    assert 'a launch test can have only one yield' in report.text


def test_misuse(run: Run) -> None:
    """What is used in the wrong way is told in a sentence."""
    report = run("""
@launch_pytest.fixture
def nothing(): return 5

@pytest.mark.launch(fixture=nothing)
def test_wrong_value(): pass

def test_unmarked(launch_context): pass

@pytest.mark.launch(fixture=it)
async def test_blocking(it, launch_context):
    tools.wait_for_exit_sync(launch_context, it[1])
""")
    assert [outcome for _, outcome in report.outcomes] == ['ERROR', 'ERROR', 'FAILED']
    for text in (
        'nothing() must return a LaunchDescription, or a sequence that begins with one',
        "the fixture 'launch_context' is for tests with @pytest.mark.launch(fixture=...)",
        'functions with _sync cannot be used in asynchronous tests',
    ):
        assert text in report.text


def test_mark_without_fixture(run: Run) -> None:
    """The mark needs a fixture of the right kind."""
    report = run("""
@pytest.mark.launch
def test_it(): pass
""")
    assert "test_it: pytest.mark.launch needs 'fixture=...'" in report.text


def test_interrupt(run: Run) -> None:
    """Ctrl-C ends the launch, the test and pytest."""
    report = run("""
@pytest.mark.launch(fixture=it)
def test_it(it, launch_context):
    os.kill(os.getpid(), signal.SIGINT)
    said(it[1], launch_context, 'never')

def test_other(): pass
""")
    assert 'KeyboardInterrupt' in report.text and 'test_other PASSED' not in report.text
