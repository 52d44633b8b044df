# SPDX-License-Identifier: Apache-2.0
"""
Limit uploads of browsers, which viser keeps in memory until a file is complete.

A browser announces a file with its size and the count of its parts, then sends the parts without
waiting for an answer. Any client of the page can announce any number of files, of any size: parts
of a file that was rejected, or that was never announced, are dropped as they arrive.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from viser._messages import FileTransferPart, FileTransferStartUpload

__all__ = ['LARGEST_UPLOAD_BYTES', 'Uploads']

LARGEST_UPLOAD_BYTES = 10_000_000
"""The maximum size of a file; a configuration has a few thousand bytes."""
MOST_PARTS = 200
MOST_AT_ONCE = 4
MEGA = 1_000_000

Refusal = Callable[[FileTransferStartUpload, str], None]


@dataclass
class _Upload:
    """An upload in progress: its owner, and the parts that are still missing."""

    owner: object
    bytes_left: int
    parts_left: set[int] = field(default_factory=set)


class Uploads:
    """Admits files to a page: each of limited size, and few at a time."""

    def __init__(self) -> None:
        self._running: dict[str, _Upload] = {}
        self.on_refusal: Refusal = lambda start, sentence: None
        """Called in the page's thread with the announcement of a rejected file and the reason."""

    def admits(self, message: object, owner: object) -> bool:
        """
        Check whether to handle a message; messages that belong to no upload always are.

        Parameters
        ----------
        message
            A message of viser, decoded.
        owner
            The connection that it arrived on; `leave` drops its uploads.

        """
        if isinstance(message, FileTransferStartUpload):
            return self._starts(message, owner)
        if isinstance(message, FileTransferPart):
            return self._continues(message, owner)
        return True

    def leave(self, owner: object) -> None:
        """
        Drop the uploads of a connection that has ended.

        Parameters
        ----------
        owner
            The connection, as given to `admits`.

        """
        for key in [key for key, each in self._running.items() if each.owner is owner]:
            del self._running[key]

    def _starts(self, start: FileTransferStartUpload, owner: object) -> bool:
        reason = self._objection(start, owner)
        if reason:
            self.on_refusal(start, reason)
            return False
        if start.part_count:
            parts = set(range(start.part_count))
            self._running[start.transfer_uuid] = _Upload(owner, start.size_bytes, parts)
        return True

    def _objection(self, start: FileTransferStartUpload, owner: object) -> str:
        """Return the reason why a file is rejected, or ''."""
        if start.size_bytes > LARGEST_UPLOAD_BYTES:
            return (
                f'The file has {start.size_bytes / MEGA:.1f} MB, but the limit for files '
                f'loaded here is {LARGEST_UPLOAD_BYTES // MEGA} MB. Choose a file that RViz has '
                'saved.'
            )
        if not (0 <= start.size_bytes and 0 <= start.part_count <= MOST_PARTS):
            return 'The size of the file is not valid. Reload the page, and try again.'
        is_known = start.transfer_uuid in self._running
        if is_known or any(each.owner is owner for each in self._running.values()):
            return 'This page is already uploading a file. Wait for it, or reload the page.'
        if len(self._running) >= MOST_AT_ONCE:
            return f'{MOST_AT_ONCE} files are already being uploaded. Try again in a moment.'
        return ''

    def _continues(self, part: FileTransferPart, owner: object) -> bool:
        upload = self._running.get(part.transfer_uuid)
        if upload is None or upload.owner is not owner or part.part_index not in upload.parts_left:
            return False
        upload.parts_left.remove(part.part_index)
        upload.bytes_left -= len(part.content)
        if upload.bytes_left < 0:
            return False  # with parts missing from now on, the file is never completed
        if not upload.parts_left:
            del self._running[part.transfer_uuid]
        return True
