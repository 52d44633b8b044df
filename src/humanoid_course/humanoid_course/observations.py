# SPDX-License-Identifier: Apache-2.0
"""What was seen of a student's packages: how they were built, what nodes and launch files did."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
import re
from typing import Protocol

from humanoid_course.workspace import Package

INTERRUPT_TIMEOUT_S = 13.0
"""How long a program may take to end after Ctrl-C; a launch kills its nodes after 5 + 5 s."""
FIRST_MESSAGES = 5
"""Messages of a topic that show whether it is published steadily, and whether it is random."""
MODEL_MARK = '_renamed_by_the_check'
"""Added to the names of the robots in the installed models, so that copies are told from them."""


@dataclass(frozen=True)
class Build:
    """
    How colcon built the packages, and what it installed.

    problem: why the build failed, if so; unlisted: packages that the ament index does not list;
    executables: names below `lib/NAME` by package; stray_executables: programs in `bin`, where
    `ros2 run` does not look; models: robot models below `share/NAME` by package.
    """

    problem: str = ''
    unlisted: tuple[str, ...] = ()
    executables: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    stray_executables: tuple[str, ...] = ()
    models: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class Endpoint:
    """A publisher or subscription: the full name of its node, and its type."""

    node: str
    kind: str


@dataclass(frozen=True)
class Run:
    """
    What a program did until it was interrupted as by Ctrl-C.

    status: exit status if it ended by itself before; output: its beginning and its end;
    publishers, subscriptions: by topic; nodes: full names, one for each node; values: numbers or
    texts received, by topic; counts: messages received, by topic; parameters: those that are
    texts, by `NAME of NODE`; left: the commands of what was
    still running when it should have ended, and had to be killed; last_words: its output after
    the interrupt.
    """

    command: str
    status: int | None = None
    output: str = ''
    nodes: tuple[str, ...] = ()
    publishers: Mapping[str, tuple[Endpoint, ...]] = field(default_factory=dict)
    subscriptions: Mapping[str, tuple[Endpoint, ...]] = field(default_factory=dict)
    values: Mapping[str, tuple[float | str, ...]] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)
    parameters: Mapping[str, str] = field(default_factory=dict)
    left: tuple[str, ...] = ()
    last_words: str = ''

    @property
    def ran(self) -> bool:
        """Whether it was still running when it was interrupted."""
        return self.status is None


@dataclass(frozen=True)
class Stimulus:
    """What a node wrote before, between and after two kinds of readings that it was sent."""

    run: Run
    kind: str = ''
    cold: float = 0.0
    hot: float = 0.0
    lines_when_cold: tuple[str, ...] = ()
    lines_when_hot: tuple[str, ...] = ()


def line_pattern(line: str) -> str:
    """
    Return what two lines have in common that differ in their numbers.

    Parameters
    ----------
    line
        A line of output.

    """
    return re.sub(r'[-+]?\d+(?:\.\d+)?', '#', line).strip()


class Submission(Protocol):
    """The packages of a student, as the checks see them; each observation is made once."""

    @property
    def packages(self) -> Sequence[Package]:
        """Return the packages, in the order in which the exercise names them."""

    @property
    def known_packages(self) -> frozenset[str]:
        """Return the names of the ROS packages that are installed or in the workspace."""

    def build(self) -> Build:
        """Build the packages into a temporary folder."""

    def run_publisher(self, executable: str, topic: str) -> Run:
        """
        Run a node of the first package, and receive what it publishes.

        Parameters
        ----------
        executable
            The name of its executable.
        topic
            The topic on which readings are expected.

        """

    def run_listener(self, executable: str, topic: str) -> Stimulus:
        """
        Run a node of the first package, and send it readings.

        Parameters
        ----------
        executable
            The name of its executable.
        topic
            The topic to which it is expected to subscribe.

        """

    def launch(self, is_enough: Callable[[Run], bool]) -> Run:
        """
        Run the launch file of the first package; a run without a command if none is installed.

        Parameters
        ----------
        is_enough
            Whether what was seen so far shows that the launch file is right.

        """
