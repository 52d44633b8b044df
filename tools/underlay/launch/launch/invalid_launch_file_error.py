# SPDX-License-Identifier: Apache-2.0
"""The error of a launch file that no loader could read."""

from __future__ import annotations

from collections.abc import Sequence


class InvalidLaunchFileError(Exception):
    """No loader could read a launch file; the text tells what each of them found."""

    def __init__(self, extension: str = '', *, likely_errors: Sequence[BaseException] = ()):
        """Create the error of a file with this extension from what each loader raised."""
        self.extension = extension.lstrip('.')
        self.likely_errors = tuple(likely_errors)
        super().__init__(self._text())

    def _text(self) -> str:
        if not self.likely_errors:
            return 'The launch file may have a syntax error, or its format is unknown'
        if len(self.likely_errors) == 1:
            return str(self.likely_errors[0])
        head = f'Caught multiple exceptions when trying to load file of format [{self.extension}]:'
        texts = [f'{type(error).__name__}: {error}' for error in self.likely_errors]
        lines = [' - ' + text.replace('\n', '\n   ') for text in texts]
        return '\n'.join([head, *lines])
