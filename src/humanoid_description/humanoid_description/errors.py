# SPDX-License-Identifier: Apache-2.0
"""The errors of this package."""

from __future__ import annotations


class DescriptionError(Exception):
    """Tell in sentences why there is no model."""
