# SPDX-License-Identifier: Apache-2.0
"""What the tests of the tools share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
import sys

from domain_coordinator import domain_id
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / 'tools' / name) for name in ('setup', 'test', 'reference', 'site')]

from programs import Program  # noqa: E402


@pytest.fixture
def root() -> Path:
    """Return the workspace's folder."""
    return ROOT


@pytest.fixture
def own_domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Reserve a DDS domain, on this machine only, for the programs that a test starts."""
    with domain_id() as number:
        monkeypatch.setenv('ROS_DOMAIN_ID', str(number))
        monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield number


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Program]]:
    """Return a function that starts a program, which ends with the test at the latest."""
    programs: list[Program] = []

    def _start(*command: str, env: dict[str, str] | None = None) -> Program:
        output = tmp_path / f'output-{len(programs)}.txt'
        programs.append(Program(list(command), output, env))
        return programs[-1]

    yield _start
    for program in programs:
        program.clean_up()
