# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain, and a node in it that listens."""

from pathlib import Path
import sys

TESTS = Path(__file__).parents[2]
sys.path[:0] = [str(TESTS / 'robot_state_publisher/test'), str(TESTS.parent / 'test')]

from publisher_fixtures import domain, probe  # noqa: E402

__all__ = ['domain', 'probe']
