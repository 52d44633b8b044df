# SPDX-License-Identifier: Apache-2.0
"""The error of a launch file that cannot be parsed."""

from __future__ import annotations

from launch.invalid_launch_file_error import InvalidLaunchFileError


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """A launch file has a syntax error or an unknown format."""

    def __init__(self, text: str = '') -> None:
        """Create the error; without a message it states that the format is unknown."""
        super().__init__()
        self.is_about_content = bool(text)
        if text:
            self.args = (text,)
