# SPDX-License-Identifier: Apache-2.0
"""The kinds of tests, and their order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Run = Callable[..., Any]


def test_kinds_of_functions(run: Run) -> None:
    """Tests may be synchronous or not, and go on after the shutdown."""
    report = run("""
@pytest.mark.launch(fixture=it)
def test_plain(it, launch_context):
    assert said(it[1], launch_context)
    assert it[1].return_code is None

@pytest.mark.launch(fixture=it)
async def test_async(it, launch_context):
    await tools.assert_output(launch_context, it[1], lambda output: 'hello' in output, 30)

@pytest.mark.launch(fixture=it)
def test_generator(it, launch_context):
    assert said(it[1], launch_context)
    yield
    assert it[1].return_code == 0
    assert it[1].get_stdout() == 'hello\\nbye\\n'

@pytest.mark.launch(fixture=it)
async def test_async_generator(it, launch_context):
    assert await tools.wait_for_stderr(launch_context, it[1], lambda text: 'oops' in text, 30)
    yield
    assert it[1].return_code == 0

@pytest.mark.launch(fixture=it, shutdown=True)
def test_after(it):
    assert it[1].return_code is not None

@pytest.mark.launch(fixture=it, shutdown=True)
async def test_async_after(it):
    await asyncio.sleep(0)
    assert it[1].return_code is not None

@pytest.mark.launch(fixture=it)
def test_service(launch_service, launch_context):
    assert launch_service.context is launch_context

@pytest.mark.launch(fixture=it)
def test_skip():
    pytest.skip('for a reason')
""")
    assert [outcome for _, outcome in report.outcomes] == ['PASSED'] * 7 + ['SKIPPED'], report.text


def test_shared_launch(run: Run) -> None:
    """On a launch for several tests, those after the shutdown come last."""
    report = run("""
@pytest.mark.launch(fixture=shared, shutdown=True)
def test_end(shared):
    assert shared[1].return_code == 0

@pytest.mark.launch(fixture=shared)
def test_parts(shared, launch_context):
    assert said(shared[1], launch_context)
    yield
    assert 'bye' in shared[1].get_stdout()

def test_other(): pass

@pytest.mark.parametrize('number', [1, 2])
@pytest.mark.launch(fixture=shared)
def test_more(shared, number):
    assert shared[1].return_code is None

def test_last(): pass
""")
    assert report.outcomes == [
        ('test_parts', 'PASSED'),
        ('test_other', 'PASSED'),
        ('test_more[1]', 'PASSED'),
        ('test_more[2]', 'PASSED'),
        ('test_end', 'PASSED'),
        ('test_parts[shutdown]', 'PASSED'),
        ('test_last', 'PASSED'),
    ], report.text


def test_marked_class(run: Run) -> None:
    """A class may be marked as a whole, and have a fixture of its own."""
    report = run("""
@pytest.mark.launch(fixture=it)
class TestAll:
    def test_first(self, it): assert it[1].return_code is None
    def test_second(self, launch_context): assert launch_context.asyncio_loop is not None

class TestOwn:
    @launch_pytest.fixture(scope='class', params=['a', 'b'])
    def own(self, request):
        process = ExecuteProcess(cmd=['echo', request.param], cached_output=True)
        return LaunchDescription([process]), process

    @pytest.mark.launch(fixture=own)
    def test_it(self, own, request, launch_context):
        wanted = request.node.callspec.params['own']
        assert said(own[1], launch_context, wanted)
""")
    assert report.outcomes == [
        ('TestAll::test_first', 'PASSED'),
        ('TestAll::test_second', 'PASSED'),
        ('TestOwn::test_it[a]', 'PASSED'),
        ('TestOwn::test_it[b]', 'PASSED'),
    ], report.text


def test_launch_that_ends_by_itself(run: Run) -> None:
    """Without the automatic shutdown, the launch ends with its processes."""
    report = run("""
@launch_pytest.fixture(auto_shutdown=False)
def short():
    process = ExecuteProcess(cmd=['sh', '-c', 'sleep 0.1; exit 3'])
    return LaunchDescription([process]), process

@pytest.mark.launch(fixture=short, shutdown=True)
def test_it(short):
    assert short[1].return_code == 3
""")
    assert report.outcomes == [('test_it', 'PASSED')], report.text


def test_readiness(run: Run) -> None:
    """Tests begin when the action was visited, however late."""
    report = run("""
@launch_pytest.fixture
def late():
    process = talker()
    return LaunchDescription([TimerAction(period=0.2, actions=[process, ReadyToTest()])]), process

@pytest.mark.launch(fixture=late)
def test_it(late, launch_context):
    assert late[1].process_details is not None
    assert tools.wait_for_start_sync(launch_context, late[1], timeout=100)
    named = {'launch_context': launch_context, 'execute_process_action': late[1]}
    assert not tools.wait_for_exit_sync(**named, timeout=0.01)
""")
    assert report.outcomes == [('test_it', 'PASSED')], report.text


def test_nothing_is_imported_for_others(run: Run) -> None:
    """Ordinary tests do not pay for the plugin."""
    report = run("""
import subprocess, sys

def test_it(tmp_path):
    (tmp_path / 'test_plain.py').write_text(
        'import sys\\ndef test_it(): assert "launch_pytest._fixture" not in sys.modules')
    command = [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', tmp_path]
    subprocess.run(command, check=True)
""")
    assert report.outcomes == [('test_it', 'PASSED')], report.text
