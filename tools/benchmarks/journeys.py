# SPDX-License-Identifier: Apache-2.0
"""Count the files and functions of this project that a launched node and a tick of the walk pass.

Who wants to understand one of these journeys reads as many files: `--list` names them. What
happens while a module is imported does not count, nor does what other processes execute. There is
no ROS in the tick: controller and physics run in lockstep.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from functools import cache
import inspect
import os
from pathlib import Path
import sys
import tempfile
import threading
from types import CodeType, FrameType
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
PLACES = ('src', 'tools/underlay')
LAUNCH_FILE = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='tracetools', executable='status')])
"""
SPEED_M_S = 0.3
WALKED_S = 3.0
"""How long the robot walks before its ticks count."""


@dataclass(frozen=True, order=True)
class Function:
    """A function of this project."""

    file: str
    """Path in this workspace, also of a function that was executed in an installed copy."""
    line: int
    name: str


@dataclass(frozen=True)
class Journey:
    """The functions that something passes on its way."""

    title: str
    functions: frozenset[Function]

    @property
    def files(self) -> list[str]:
        """Return the files of the functions, sorted."""
        return sorted({function.file for function in self.functions})

    def __str__(self) -> str:
        """Return the columns of HEADER."""
        return f'{len(self.files):>6}{len(self.functions):>11}  {self.title}'


HEADER = f'{"files":>6}{"functions":>11}  journey'


class Recorder:
    """Profile function that records what is executed, except while a module is imported."""

    def __init__(self) -> None:
        self._codes: set[CodeType] = set()
        self._imports: Counter[int] = Counter()

    def __call__(self, frame: FrameType, event: str, argument: Any) -> None:
        """
        Handle an event, as a function for `sys.setprofile`.

        Parameters
        ----------
        frame, event, argument
            As `sys.setprofile` describes them.

        """
        if event not in ('call', 'return'):
            return
        code, thread = frame.f_code, threading.get_ident()
        if code.co_name == '<module>':
            self._imports[thread] += 1 if event == 'call' else -1
        elif event == 'call' and not self._imports[thread]:
            self._codes.add(code)

    @contextmanager
    def recording(self) -> Iterator[None]:
        """Record what this thread, and those that it starts, execute in a `with` block."""
        threading.setprofile(self)
        sys.setprofile(self)
        try:
            yield
        finally:
            sys.setprofile(None)
            threading.setprofile(None)

    def functions(self) -> frozenset[Function]:
        """Return the recorded functions of this project, each once."""
        return frozenset(
            Function(file, code.co_firstlineno, code.co_name)
            for code in self._codes
            if _is_function(code) and (file := own_file(code.co_filename))
        )


def main() -> None:
    """Make the journeys and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--only', choices=JOURNEYS, help='make only this journey')
    parser.add_argument('--list', action='store_true', help='list the files and their functions')
    options = parser.parse_args()
    print(HEADER)
    for name in [options.only] if options.only else JOURNEYS:
        for journey in JOURNEYS[name]():
            print(journey, flush=True)
            if options.list:
                print_functions(journey.functions)


def print_functions(functions: Iterable[Function]) -> None:
    """
    Print functions below their files.

    Parameters
    ----------
    functions
        The functions.

    """
    file = ''
    for function in sorted(functions):
        if function.file != file:
            file = function.file
            print(f'\n{file}')
        print(f'    {function.line:>4} {function.name}')
    print()


def launch() -> Iterator[Journey]:
    """
    Launch a node that ends at once, from the include of the launch file to the end of the launch.

    Yields
    ------
    Journey
        The way through the process of the launch.

    """
    from launch import LaunchDescription, LaunchService
    from launch.actions import IncludeLaunchDescription

    recorder = Recorder()
    with tempfile.TemporaryDirectory() as folder, open(os.devnull, 'w') as nowhere:
        os.environ['ROS_LOG_DIR'] = folder
        file = Path(folder) / 'journey.launch.py'
        file.write_text(LAUNCH_FILE)
        with recorder.recording(), redirect_stdout(nowhere):
            service = LaunchService()
            service.include_launch_description(
                LaunchDescription([IncludeLaunchDescription(str(file))])
            )
            status = service.run()
    if status != 0:
        raise SystemExit(f'The launch has ended with {status}.')
    yield Journey('launch of one node, from the include to its end', recorder.functions())


def tick() -> Iterator[Journey]:
    """
    Let the robot walk, then record each tick of two steps, from the command to the torques.

    Yields
    ------
    Journey
        The way of all ticks together, then of the one that passes most files.

    """
    from humanoid_control.hosting.control_loop import ControlLoop
    from humanoid_control.walking import VelocityCommand
    from humanoid_simulation.testing.lockstep_robot import LockstepRobot

    robot = LockstepRobot()
    robot.wait(1.0)
    robot.drive(SPEED_M_S)
    if not robot.wait(WALKED_S):
        raise SystemExit('The robot has fallen.')
    control = robot.walking.control
    loop = ControlLoop(robot.backend, {'': control})
    cycle_s = 2.0 * robot.walking.walker.parameters.timing.step_s
    ticks = []
    for _ in range(round(cycle_s / robot.backend.period_s)):
        control.walk(VelocityCommand(SPEED_M_S))
        recorder = Recorder()
        with recorder.recording():
            loop.tick()
        ticks.append(recorder.functions())
    passed = frozenset(function for each in ticks for function in each)
    yield Journey(f'tick of the walk, all {len(ticks)} of two steps', passed)
    yield max(
        (Journey('tick of the walk, the longest', each) for each in ticks),
        key=lambda journey: len(journey.files),
    )


def own_file(name: str) -> str:
    """
    Find the file of this workspace that is executed.

    Parameters
    ----------
    name
        The name of the executed file, which may be an installed copy.

    Returns
    -------
    str
        Its path in this workspace; empty if it is not one of this project.

    """
    path = Path(name)
    if any(path.is_relative_to(ROOT / place) for place in PLACES):
        return str(path.relative_to(ROOT))
    _, found, rest = name.rpartition('/site-packages/')
    package, _, module = rest.partition('/')
    return f'{folder}/{module}' if found and (folder := _packages().get(package)) else ''


def _is_function(code: CodeType) -> bool:
    """Check whether code is of a function, not of a class, a comprehension or a generator."""
    is_named = not code.co_name.startswith('<') or code.co_name == '<lambda>'
    return is_named and bool(code.co_flags & inspect.CO_OPTIMIZED)


@cache
def _packages() -> dict[str, str]:
    """Return the folders in this workspace of all packages that can be imported, by name."""
    inits = (init for place in PLACES for init in (ROOT / place).rglob('__init__.py'))
    folders = (init.parent for init in inits)
    return {
        folder.name: str(folder.relative_to(ROOT))
        for folder in folders
        if not (folder.parent / '__init__.py').exists()
    }


JOURNEYS = {'launch': launch, 'tick': tick}


if __name__ == '__main__':
    main()
