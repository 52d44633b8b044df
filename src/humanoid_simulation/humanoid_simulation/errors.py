# SPDX-License-Identifier: Apache-2.0
"""The errors of this package."""

from __future__ import annotations


class SimulationError(Exception):
    """A request that the simulator rejects, or a failure; its message is meant for users."""
