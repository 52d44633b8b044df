# SPDX-License-Identifier: Apache-2.0
"""Run what is shown in pictures: programs that print the address of their page, and `ros2`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
import re
import signal
import subprocess
import tempfile
import time

__all__ = ['ros2', 'started']

TIMEOUT_S = 60.0
ADDRESS = re.compile(r'(?:RViz is|The turtles are) at (http://\S+)')
FAULT = re.compile(r'\[(?:WARN|ERROR|FATAL)\]|Traceback')


def ros2(*command: str) -> None:
    """
    Run a command of `ros2`, without its output.

    Parameters
    ----------
    *command
        What follows `ros2`.

    """
    subprocess.run(['ros2', *command], check=True, stdout=subprocess.DEVNULL)


@contextmanager
def started(*command: str) -> Iterator[str]:
    """
    Run a command of `ros2` for the time of a `with`, then print its warnings and errors.

    Parameters
    ----------
    *command
        What follows `ros2`.

    Yields
    ------
    str
        The URL of its page.

    Raises
    ------
    SystemExit
        It does not print an address within `TIMEOUT_S`.

    """
    with tempfile.NamedTemporaryFile() as output:
        process = subprocess.Popen(['ros2', *command], stdout=output, stderr=subprocess.STDOUT)
        try:
            yield _address_in(Path(output.name))
        finally:
            process.send_signal(signal.SIGINT)
            process.wait()
            _print_faults(Path(output.name))


def _address_in(output: Path) -> str:
    """Wait until an address is in the output of a program, or raise SystemExit."""
    end_s = time.monotonic() + TIMEOUT_S
    while time.monotonic() < end_s:
        if found := ADDRESS.search(output.read_text()):
            return found[1]
        time.sleep(0.1)
    raise SystemExit(f'The program did not print the address of a page:\n{output.read_text()}')


def _print_faults(output: Path) -> None:
    """Print the lines of a program's output that are warnings or errors."""
    for line in output.read_text().splitlines():
        if FAULT.search(line):
            print(line)
