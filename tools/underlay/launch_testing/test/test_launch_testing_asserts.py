# SPDX-License-Identifier: Apache-2.0
"""What tests can assert about processes."""

from __future__ import annotations

import re
from typing import Any

from launch_testing import ActiveIoHandler, ActiveProcInfoHandler, IoHandler, ProcInfoHandler
from launch_testing.asserts import (
    assertExitCodes,
    assertInStderr,
    assertInStdout,
    assertInStream,
    assertSequentialStdout,
    EXIT_SIGINT,
    NO_CMD_ARGS,
)
from launch_testing.util import NoMatchingProcessException, resolveProcesses
import pytest


@pytest.fixture
def talker(fake_process: Any) -> Any:
    """Return a process with an argument."""
    return fake_process('talker-1', '--fast')


@pytest.fixture
def listener(fake_process: Any) -> Any:
    """Return a process without arguments."""
    return fake_process('listener-2')


@pytest.fixture
def output(talker: Any, listener: Any) -> IoHandler:
    """Return what both have written."""
    handler = IoHandler()
    for event in (
        talker.wrote('one\ntw'),
        talker.wrote('oops\n', 2),
        talker.wrote('o\n\x1b[32mgreen\x1b[0m\n'),
        listener.wrote('heard\n'),
    ):
        handler.append(event)
    return handler


def test_text_over_several_reads(output: IoHandler, talker: Any) -> None:
    """A text is found although it came in two pieces, with another stream between."""
    assertInStdout(output, 'two', talker)
    assertInStdout(output, 'one\ntwo\n', 'talker')
    assertInStderr(output, re.compile('o+ps'), talker)


def test_streams_are_told_apart(output: IoHandler, talker: Any) -> None:
    """What is on one stream is not on the other; the error shows what there was."""
    with pytest.raises(AssertionError, match=r"'oops' was not found .* on stdout.\n") as caught:
        assertInStdout(output, 'oops', talker)
    assert "The last output of 'talker-1':\n    one" in str(caught.value)
    assertInStream(output, 'oops', talker)
    with pytest.raises(ValueError, match="'stdout' or 'stderr', not 'both'"):
        assertInStream(output, 'oops', talker, stream='both')


def test_colours_and_filters(output: IoHandler, talker: Any) -> None:
    """Colours are ignored unless they are asked for; a filter changes what is compared."""
    assertInStdout(output, '\ngreen\n', talker)
    assertInStdout(output, '\x1b[32mgreen', talker, strip_ansi_escape_sequences=False)
    assertInStdout(output, 'ONE', talker, output_filter=str.upper)


def test_lines_in_order(output: IoHandler, talker: Any) -> None:
    """A list is expected line by line, in order, with others between."""
    assertInStdout(output, ['one', re.compile('^gr')], talker)
    with pytest.raises(AssertionError):
        assertInStdout(output, ['green', 'one'], talker)


def test_any_process(output: IoHandler) -> None:
    """Without a process, any may have written it."""
    assertInStdout(output, 'heard', None)


def test_sequence(output: IoHandler, talker: Any) -> None:
    """Texts follow one another; the error tells what was found before."""
    with assertSequentialStdout(output, talker) as checker:
        checker.assertInStdout('one')
        checker.assertInStdout(re.compile('gr..n'))
        with pytest.raises(AssertionError, match=r"'two' .* after \['one', 'gr..n'\]"):
            checker.assertInStdout('two')


def test_resolution(output: IoHandler, talker: Any, listener: Any) -> None:
    """A process is an action, a part of a name, perhaps with arguments, or all of them."""
    assert resolveProcesses(output, process='lis') == [listener]
    assert resolveProcesses(output, process=talker, cmd_args='--fast') == [talker]
    assert resolveProcesses(output, process='e', cmd_args=NO_CMD_ARGS) == [listener]
    assert resolveProcesses(output, process='e', cmd_args=['--fast']) == [talker]
    assert resolveProcesses(output) == [talker, listener]
    assert resolveProcesses(output, process='e', strict_proc_matching=False) == [talker, listener]


def test_resolution_errors(output: IoHandler, fake_process: Any) -> None:
    """Errors name the processes that there are."""
    with pytest.raises(NoMatchingProcessException, match="'x'. There are: talker-1, listener-2"):
        resolveProcesses(output, process='x')
    with pytest.raises(NoMatchingProcessException, match='More than one process .*listener-2'):
        resolveProcesses(output, process='e')
    with pytest.raises(NoMatchingProcessException, match='No process is that of'):
        resolveProcesses(output, process=fake_process('other'))
    with pytest.raises(TypeError, match='not by 5, which is a int'):
        resolveProcesses(output, process=5)  # type: ignore[arg-type]


def test_handlers_as_containers(output: IoHandler, talker: Any) -> None:
    """Outputs are found by action and by name."""
    assert output.process_names() == ['talker-1', 'listener-2']
    assert len(output['talker']) == 3 and len(output[talker]) == 3 and len(list(output)) == 4


def test_exit_codes(talker: Any, listener: Any) -> None:
    """A signal counts in both notations; what did not end as it should is named."""
    info = ProcInfoHandler()
    info.append(talker.exited(-2))
    info.append(listener.exited(0))
    assertExitCodes(info, process=listener)
    assertExitCodes(info, [0, EXIT_SIGINT])
    assertExitCodes(info, {0, -2})
    with pytest.raises(AssertionError, match=r"'talker-1' ended with exit code -2 \(SIGINT\)"):
        assertExitCodes(info)
    with pytest.raises(TypeError, match='must be a list, not 0'):
        assertExitCodes(info, 0)  # type: ignore[arg-type]


def test_exit_code_of_running_process(talker: Any) -> None:
    """A process that runs has no exit code."""
    info = ProcInfoHandler()
    info.append(talker.started())
    assert info['talker'].pid == 1 and info.process_names() == ['talker-1']
    with pytest.raises(AssertionError, match="'talker-1' has not ended"):
        assertExitCodes(info)


def test_waiting(talker: Any) -> None:
    """Waiting ends at once if it is so already, and says in vain for what otherwise."""
    info, output = ActiveProcInfoHandler(), ActiveIoHandler()
    with pytest.raises(NoMatchingProcessException, match='There are: none'):
        info.assertWaitForStartup(talker, timeout=0.01)
    info.append(talker.started())
    output.append(talker.wrote('one'))
    info.assertWaitForStartup(process='talker', timeout=0.01)
    output.assertWaitFor('one', process=talker, timeout=0.01)
    assert not output.waitFor('two', timeout=0.01)
    with pytest.raises(AssertionError, match='waiting 0.01 s for the end of talker-1'):
        info.assertWaitForShutdown(talker, timeout=0.01)
    with pytest.raises(AssertionError, match="waiting 0.01 s for the output 'two'.\n.*\n    one"):
        output.assertWaitFor('two', talker, timeout=0.01)


def test_waiting_for_the_end_of_all(talker: Any) -> None:
    """All processes have ended only after one has started, or when the launch is over."""
    info = ActiveProcInfoHandler()
    assert not info.waitForShutdown(None, timeout=0.01)
    with pytest.raises(AssertionError, match='the end of any process: none has started'):
        info.assertWaitForShutdown(None, timeout=0.01)
    info.append(talker.started())
    assert not info.waitForShutdown(None, timeout=0.01)
    info.append(talker.exited(0))
    assert info.waitForShutdown(None, timeout=0.01)
    over = ActiveProcInfoHandler()
    over.close()
    assert over.waitForShutdown(None, timeout=1000)


def test_nobody_waits_for_what_is_over(talker: Any) -> None:
    """When the launch is over, waiting ends at once."""
    info = ActiveProcInfoHandler()
    info.append(talker.started())
    info.close()
    with pytest.raises(AssertionError, match='The launch ended while a test waited'):
        info.assertWaitForShutdown(talker, timeout=1000)
