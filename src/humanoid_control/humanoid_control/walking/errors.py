# SPDX-License-Identifier: Apache-2.0
"""Exceptions of the walking package."""


class WalkingError(ValueError):
    """An input that walking cannot handle; the message states which, and why."""
