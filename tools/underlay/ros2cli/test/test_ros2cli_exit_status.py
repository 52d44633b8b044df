# SPDX-License-Identifier: Apache-2.0
"""Tests of the translation from results and exceptions to exit statuses."""

from collections.abc import Callable, Iterator
import os
import signal
import sys
import threading

import pytest
import rclpy
from rclpy.executors import ExternalShutdownException
from ros2cli.cli import run_to_status
from ros2cli.node.direct import DirectNode, interrupts_deferred


def raising(error: BaseException) -> Callable[[], int]:
    """Return a function that raises an exception."""

    def call() -> int:
        raise error

    return call


@pytest.fixture(autouse=True)
def usual_interrupt() -> Iterator[None]:
    """Begin each test as a process does, and leave no trace of an interrupt in the next one."""
    previous = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, previous)


@pytest.mark.parametrize(('result', 'status'), [(None, 0), (0, 0), (3, 3), (-9, -9)])
def test_number_is_status(result: int | None, status: int) -> None:
    """A number is the status, and nothing is success."""
    assert run_to_status(lambda: result) == status


@pytest.mark.parametrize('call', [lambda: 'no luck', raising(RuntimeError('no luck'))])
def test_text_is_error(
    call: Callable[[], str],
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A text that is returned, or carried by a RuntimeError, goes to stderr with status 1."""
    assert run_to_status(call) == 1
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ('', 'no luck\n')


def test_interrupt_is_silent(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Ctrl-C has the status of its signal, prints nothing, and a second one does no harm."""
    handlers = []
    monkeypatch.setattr('signal.signal', lambda *words: handlers.append(words))
    assert run_to_status(raising(KeyboardInterrupt())) == 2
    assert capsys.readouterr() == ('', '')
    assert handlers == [(signal.SIGINT, signal.SIG_IGN)]


def test_interrupt_leaves_no_warning(recwarn: pytest.WarningsRecorder) -> None:
    """A coroutine which is interrupted before it starts is not complained about."""

    async def never() -> None:
        """Do nothing."""

    def interrupted() -> int:
        coroutine = never()
        assert coroutine is not None
        raise KeyboardInterrupt

    assert run_to_status(interrupted) == 2
    assert not recwarn.list


def test_interrupt_of_an_import_is_silent(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C while a C library is imported is an ImportError, and yet nothing but Ctrl-C."""
    error = ImportError('initialization failed')
    error.__cause__ = KeyboardInterrupt()
    monkeypatch.setattr('signal.signal', lambda *words: None)
    assert run_to_status(raising(error)) == 2
    assert capsys.readouterr() == ('', '')


def test_exit_of_parser_is_status() -> None:
    """The exit of the argument parser keeps its status."""
    assert run_to_status(raising(SystemExit(2))) == 2


def test_unexpected_error_is_raised() -> None:
    """An error that nobody foresaw keeps its traceback."""
    with pytest.raises(ZeroDivisionError):
        run_to_status(raising(ZeroDivisionError()))


def test_external_shutdown_has_status_of_sigterm() -> None:
    """The exception by which rclpy reports SIGTERM has the status of that signal."""
    assert 'rclpy.executors' in sys.modules
    assert run_to_status(raising(ExternalShutdownException())) == 15


def test_interrupt_comes_after_the_block() -> None:
    """Ctrl-C does not leave half of the work undone, but ends the command then."""
    done = []
    with pytest.raises(KeyboardInterrupt):
        with interrupts_deferred():
            signal.raise_signal(signal.SIGINT)
            done.append('all')
    assert done == ['all']
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_uninterrupted_block_raises_nothing() -> None:
    """Without Ctrl-C the block is as good as none."""
    with interrupts_deferred():
        pass
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.parametrize(
    ('number', 'error'),
    [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, ExternalShutdownException)],
)
def test_signal_that_python_hears_of_after_rclpy(
    number: signal.Signals, error: type[BaseException], domain: int
) -> None:
    """rclpy may be shut down before Python knows the signal: the command ends as it should."""
    before = signal.getsignal(signal.SIGTERM)
    late = threading.Timer(0.1, os.kill, (os.getpid(), number))
    with pytest.raises(error):
        with DirectNode(None):
            rclpy.shutdown()
            late.start()
            raise ExternalShutdownException
    late.join()
    assert signal.getsignal(signal.SIGTERM) is before
