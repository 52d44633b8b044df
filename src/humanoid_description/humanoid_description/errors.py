# SPDX-License-Identifier: Apache-2.0
"""The errors of this package."""

from __future__ import annotations

from humanoid_common.errors import UserError


class DescriptionError(UserError):
    """A robot model cannot be made or loaded; the message gives the reason."""
