# SPDX-License-Identifier: Apache-2.0
"""What the file formats besides Python share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch.frontend.invalid_frontend_launch_file_error import InvalidFrontendLaunchFileError

__all__ = [
    'InvalidFrontendLaunchFileError',
]

__getattr__, __dir__ = lazy_exports(__name__, __all__)
