# SPDX-License-Identifier: Apache-2.0
"""The fixtures that the tests of both publishers share."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))

from publisher_fixtures import domain, probe, programs  # noqa: E402

__all__ = ['domain', 'probe', 'programs']
