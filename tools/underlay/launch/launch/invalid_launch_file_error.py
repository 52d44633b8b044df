# SPDX-License-Identifier: Apache-2.0
"""The errors of a launch file that no loader could read."""

from __future__ import annotations

from collections.abc import Sequence

from launch.failures import error_text


class InvalidLaunchFileError(Exception):
    """No loader could read a launch file; the message lists the error of each of them."""

    def __init__(self, extension: str = '', *, likely_errors: Sequence[BaseException] = ()):
        """Create the error for a file extension from the errors of all loaders."""
        self.extension = extension.lstrip('.')
        self.likely_errors = tuple(likely_errors)
        super().__init__(self._text())

    def _text(self) -> str:
        if not self.likely_errors:
            return 'The launch file may have a syntax error, or its format is unknown'
        if len(self.likely_errors) == 1:
            return error_text(self.likely_errors[0])
        head = f'Caught multiple exceptions when trying to load file of format [{self.extension}]:'
        texts = [f'{type(each).__name__}: {error_text(each)}' for each in self.likely_errors]
        lines = [' - ' + text.replace('\n', '\n   ') for text in texts]
        return '\n'.join([head, *lines])


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """A launch file has a syntax error or an unknown format."""

    def __init__(self, text: str = '') -> None:
        """Create the error; without a message it states that the format is unknown."""
        super().__init__()
        self.is_about_content = bool(text)
        if text:
            self.args = (text,)
