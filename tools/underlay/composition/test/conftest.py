# SPDX-License-Identifier: Apache-2.0
"""The fixtures: a domain, programs in it, and a node that looks at them."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parents[2] / 'robot_state_publisher/test'))

from publisher_fixtures import domain, probe, programs  # noqa: E402

__all__ = ['domain', 'probe', 'programs']
