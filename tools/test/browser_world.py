# SPDX-License-Identifier: Apache-2.0
"""Programs that serve pages, in a domain of their own, with what listens beside them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os
from pathlib import Path
import re

from domain_coordinator import domain_id
from programs import Program, wait_until
from ros_side import ros_side, RosSide

__all__ = ['STRAINED', 'World', 'memory_mb', 'pid_of', 'url_of', 'world']

STRAINED = 'A browser sent an unexpected message'
STARTED = re.compile(r'\[(\w+)-\d+\]: process started with pid \[(\d+)\]')
BAD = (
    'Traceback',
    'has died',
    'has raised an error',
    'has been stopped',
    'never retrieved',
    'A connection has failed',
)


class World:
    """Programs that were started, and a node beside them."""

    def __init__(self, folder: Path, domain: int, ros: RosSide) -> None:
        """Begin without programs."""
        self.ros = ros
        self.programs: list[Program] = []
        self._folder = folder
        self._environment = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
            'ROS_HOME': str(folder / 'ros_home'),
            'HOME': str(folder),
        }

    def start(self, *command: str) -> Program:
        """Start a program."""
        output = self._folder / f'output-{len(self.programs)}.txt'
        self.programs.append(Program(list(command), output, self._environment))
        return self.programs[-1]

    def launch(self, *arguments: str) -> Program:
        """Start `ros2 launch`."""
        return self.start('ros2', 'launch', *arguments)

    def complaints(self) -> list[str]:
        """Return the lines that say that something is wrong with a program."""
        lines = [line for program in self.programs for line in program.output.splitlines()]
        return [line for line in lines if any(bad in line for bad in BAD)]

    def clean_up(self) -> None:
        """End all programs."""
        for program in self.programs:
            program.clean_up()


def url_of(program: Program) -> str:
    """Return the address of RViz that a program prints."""
    pattern = re.compile(r'RViz is at (http://\S+)')
    wait_until(lambda: pattern.search(program.output), 100.0, lambda: program.output)
    return pattern.findall(program.output)[-1]


def pid_of(program: Program, name: str) -> int:
    """Return the id of a process that a launch has started."""
    return next(int(pid) for each, pid in STARTED.findall(program.output) if each == name)


def memory_mb(pid: int) -> float:
    """Return how much memory a process uses."""
    with open(f'/proc/{pid}/status') as file:
        text = file.read()
    return int(re.search(r'VmRSS:\s*(\d+)', text)[1]) / 1024.0


@contextmanager
def world(folder: Path) -> Iterator[World]:
    """Give a domain without programs, which end with it at the latest."""
    with domain_id() as domain, ros_side(domain) as ros:
        made = World(folder, domain, ros)
        try:
            yield made
        finally:
            made.clean_up()
