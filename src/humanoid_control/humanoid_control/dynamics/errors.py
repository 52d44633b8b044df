# SPDX-License-Identifier: Apache-2.0
"""The errors of this package."""

from __future__ import annotations


class DynamicsError(Exception):
    """Tell in sentences why a robot or its state cannot be computed with."""
