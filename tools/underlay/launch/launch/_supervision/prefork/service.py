# SPDX-License-Identifier: Apache-2.0
"""Request loop of the template process."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import gc
from importlib import import_module
import marshal
import os
import socket
import time
from types import CodeType
from typing import Any, NoReturn

from launch._supervision.prefork.linux import Cloning
from launch._supervision.prefork.starting_point import enter, forget_packages, main_module

Become = Callable[[], tuple[CodeType, dict[str, Any]]]

_ADOPTION_S = 5.0


def serve(descriptor: int, preloader: str, scripts: Sequence[str]) -> Become:
    """
    Import the modules of programs, and clone this process on request; return in clones only.

    Parameters
    ----------
    descriptor
        The descriptor of the connection to the launch.
    preloader
        The name of the module that imports what the programs need.
    scripts
        The paths of the programs.

    Returns
    -------
    callable
        Returns the code of the program and its names, for `exec`.

    """
    control = socket.socket(fileno=descriptor)
    try:
        return _serve(control, preloader, scripts)
    except Exception as error:
        _give_up(control, f'failed {error!r}')


def _serve(control: socket.socket, preloader: str, scripts: Sequence[str]) -> Become:
    _refuse_threads()
    library = import_module(preloader)
    library.preload(scripts)
    gc.collect()
    gc.freeze()
    control.send(b'loaded')
    _settle(control, library)
    cloning = Cloning()
    control.send(b'ready')
    while True:
        message, descriptors, _, _ = socket.recv_fds(control, 16, 4)
        if not message:
            _exit_at_once(0)
        if _clone(cloning, descriptors):
            control.close()
            return _begin(descriptors, library)


def _settle(control: socket.socket, library: Any) -> None:
    """
    Continue in a single-threaded copy that the launch has adopted.

    The fork removes the threads that libraries have started at import.
    """
    words = control.recv(32).split()
    if not words:
        _exit_at_once(0)
    origin, launch = os.getpid(), int(words[1])
    library.before_fork()
    if os.fork() != 0:
        _exit_at_once(0)
    end_s = time.monotonic() + _ADOPTION_S
    while os.getppid() == origin and time.monotonic() < end_s:
        time.sleep(0.0005)
    if os.getppid() != launch:
        raise OSError('the template was not adopted by the launch')


def _refuse_threads() -> None:
    """Raise an error if Python itself has started threads, which a fork would lose."""
    count = len(os.listdir('/proc/self/task'))
    if count != 1:
        raise OSError(f'Python itself has started with {count} threads')


def _clone(cloning: Cloning, descriptors: list[int]) -> bool:
    """Clone this process and send its id to the launch; return whether this is the clone."""
    pid = cloning.make_sibling()
    if pid == 0:
        return True
    try:
        os.write(descriptors[-1], b'%d\n' % pid)
    except OSError:
        pass  # the launch is no longer waiting
    for descriptor in descriptors:
        os.close(descriptor)
    return False


def _begin(descriptors: list[int], library: Any) -> Become:
    """Set up the process for a program, and wait for the launch to start it."""
    stdin, stdout, stderr, starter = descriptors
    with socket.socket(fileno=starter) as connection:
        try:
            program = marshal.loads(_receive(connection))  # noqa: S302
            enter(program, (stdin, stdout, stderr))
            library.after_fork()
            connection.send(b'+')
        except Exception as error:
            _give_up(connection, f'failed {error!r}')
        if not connection.recv(1):
            _exit_at_once(0)
    forget_packages({name.partition('.')[0] for name in (__name__, library.__name__)})
    return lambda: main_module(program['command'][0])


def _receive(connection: socket.socket) -> bytes:
    """Receive a length-prefixed message."""
    with connection.makefile('rb') as file:
        return file.read(int(file.readline()))


def _give_up(connection: socket.socket, reason: str) -> NoReturn:
    """Report the reason and exit; the launch then executes programs as usual."""
    try:
        connection.send(reason.encode('utf-8', 'replace')[:1000])
    except OSError:
        pass
    _exit_at_once(1)


def _exit_at_once(status: int) -> NoReturn:
    """Exit without the clean-up of the interpreter, parts of which belong to the launch."""
    os._exit(status)
