# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain, a node in it that listens and asks, and programs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
import sys

from domain_coordinator import domain_id
import pytest

TOOLS = Path(__file__).parents[3]
sys.path[:0] = [
    str(TOOLS / 'test'),
    str(TOOLS / 'underlay' / 'robot_state_publisher' / 'test'),
    str(Path(__file__).parent),
]

from programs import Program  # noqa: E402
from publisher_probe import Probe  # noqa: E402


@pytest.fixture(scope='module')
def domain() -> Iterator[int]:
    """Reserve a domain for the programs of a file."""
    with domain_id() as number, pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_DOMAIN_ID', str(number))
        patch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield number


@pytest.fixture(scope='module')
def probe(domain: int) -> Iterator[Probe]:
    """Return a node in the domain."""
    with Probe(domain) as probe:
        yield probe


@pytest.fixture
def start(domain: int, tmp_path: Path) -> Iterator[Callable[..., Program]]:
    """Return what starts a `ros2` command, which ends with the test."""
    programs: list[Program] = []

    def start(*words: str) -> Program:
        programs.append(Program(['ros2', *words], tmp_path / str(len(programs))))
        return programs[-1]

    yield start
    for program in programs:
        program.clean_up()
