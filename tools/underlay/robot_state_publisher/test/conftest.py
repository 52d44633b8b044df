# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain of one's own, the node as a process, and a node that looks at it."""

from collections.abc import Iterator
import os
from pathlib import Path
import sys
from typing import Any

from domain_coordinator import domain_id
import pytest

# For what several test modules share.
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def domain() -> Iterator[int]:
    """Reserve a domain."""
    with domain_id() as domain:
        yield domain


@pytest.fixture
def probe(domain: int) -> Iterator[Any]:
    """Return a node in the domain of the test."""
    from publisher_probe import Probe

    with Probe(domain) as probe:
        yield probe


@pytest.fixture
def programs(domain: int, tmp_path: Path) -> Iterator[Any]:
    """Return what starts programs in the domain of the test, and ends them after it."""
    from publisher_probe import Programs

    environment = {
        **os.environ,
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    }
    with Programs(environment, tmp_path) as programs:
        yield programs
