# SPDX-License-Identifier: Apache-2.0
"""Start processes with an environment, undisturbed by signals meanwhile, and end them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
import contextlib
import multiprocessing
from multiprocessing.process import BaseProcess
from multiprocessing.resource_tracker import ensure_running
import os
import signal
from typing import Any

PATIENCE_S = 2.0
"""How long a process is given to end by itself."""
CONTEXT = multiprocessing.get_context('spawn')
_ENDING = {signal.SIGINT, signal.SIGTERM}


def start(
    target: Callable[..., None], arguments: tuple[Any, ...], environment: Mapping[str, str]
) -> BaseProcess:
    """
    Start a process, which ends with this one; it begins with `let_signals_through`.

    Parameters
    ----------
    target, arguments
        What it calls.
    environment
        Environment variables of the process, in addition to those of this one.

    """
    process = CONTEXT.Process(target=target, args=arguments, daemon=True)
    with _environment(environment), _uninterrupted():
        process.start()
    return process


def let_signals_through() -> None:
    """Let signals reach this process again, which `start` has deferred."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDING)


def end(process: BaseProcess) -> None:
    """
    End a process, at once if it does not do so by itself.

    Parameters
    ----------
    process
        The process.

    """
    process.terminate()
    process.join(PATIENCE_S)
    if process.is_alive():
        process.kill()
        process.join()


def ending_text(process: BaseProcess) -> str:
    """
    Describe how a process has ended.

    Parameters
    ----------
    process
        The process, which has ended or is just doing so.

    """
    process.join(PATIENCE_S)
    if process.exitcode is not None and process.exitcode < 0:
        return f'was ended by {signal.Signals(-process.exitcode).name}'
    return f'ended with status {process.exitcode}'


@contextlib.contextmanager
def _environment(variables: Mapping[str, str]) -> Iterator[None]:
    """Set environment variables while a process starts."""
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextlib.contextmanager
def _uninterrupted() -> Iterator[None]:
    """Defer Ctrl-C and SIGTERM while a process starts: one that half starts leaves a traceback."""
    ensure_running()  # when Python starts this process of its own, it lets all signals through
    arrived: list[int] = []
    handlers = {
        number: signal.signal(number, lambda number, frame: arrived.append(number))
        for number in _ENDING
    }
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)  # the new process has it, too
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for taken in arrived:
            signal.raise_signal(taken)
