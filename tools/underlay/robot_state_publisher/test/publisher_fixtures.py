# SPDX-License-Identifier: Apache-2.0
"""Fixtures of both publishers: a domain, the node as a process, and a node that looks at it."""

from collections.abc import Iterator
import os
from pathlib import Path
from typing import Any

from domain_coordinator import domain_id
from publisher_probe import Probe, Programs
import pytest

__all__ = ['domain', 'probe', 'programs']


@pytest.fixture
def domain() -> Iterator[int]:
    """Reserve a domain."""
    with domain_id() as domain:
        yield domain


@pytest.fixture
def probe(domain: int) -> Iterator[Any]:
    """Return a node in the domain of the test."""
    with Probe(domain) as probe:
        yield probe


@pytest.fixture
def programs(domain: int, tmp_path: Path) -> Iterator[Any]:
    """Return what starts programs in the domain of the test, and ends them after it."""
    environment = {
        **os.environ,
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    }
    with Programs(environment, tmp_path) as programs:
        yield programs
