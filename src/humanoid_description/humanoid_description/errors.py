# SPDX-License-Identifier: Apache-2.0
"""The errors of this package."""

from __future__ import annotations


class DescriptionError(Exception):
    """A robot model cannot be made or loaded; the message gives the reason."""
