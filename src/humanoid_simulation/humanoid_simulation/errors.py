# SPDX-License-Identifier: Apache-2.0
"""The errors of this package."""

from __future__ import annotations


class SimulationError(Exception):
    """Tell in sentences what the simulator refuses, or why it cannot go on."""
