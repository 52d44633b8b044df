# SPDX-License-Identifier: Apache-2.0
"""Copy the messages of a broken file to a new one."""

from __future__ import annotations

from collections.abc import Callable
import os

from mcap.records import Channel, Message
from ros2bag.storage.definitions import Definition
from ros2bag.storage.mcap_file import McapFile
from ros2bag.storage.mcap_summary import topic_of
from ros2bag.storage.salvage import Salvage
from ros2bag.storage.survey import Survey

__all__ = ['copy_messages']

CHUNK_BYTES = 1024 * 1024


def copy_messages(
    path: str, survey: Survey, new_path: str, progress: Callable[[float], None]
) -> int:
    """
    Copy the messages of a broken MCAP file to a new, complete one.

    Messages whose schema or channel is lost cannot be copied.

    Parameters
    ----------
    path
        The broken file.
    survey
        The schemas, channels and compression found in it.
    new_path
        The file to create.
    progress
        Called with the fraction (0 to 1) of the broken file that has been read.

    Returns
    -------
    int
        The number of copied messages.

    Raises
    ------
    OSError
        The new file exists already or cannot be written.

    """
    name, compression = os.path.basename(path), survey.compression
    file = McapFile(new_path, name=name, compression=compression, chunk_bytes=CHUNK_BYTES)
    try:
        copier = _Copier(file, survey)
        for record in Salvage(path).records(progress):
            if isinstance(record, Channel | Message):
                copier.add(record)
        file.finish()
    finally:
        file.close()
    return file.message_count


class _Copier:
    """Copier of channels and messages from one file to another."""

    def __init__(self, file: McapFile, survey: Survey) -> None:
        self._file = file
        self._survey = survey
        self._names: dict[int, str] = {}

    def add(self, record: Channel | Message) -> None:
        """Write a record; skip it if its schema or channel is lost."""
        number = record.id if isinstance(record, Channel) else record.channel_id
        if number not in self._names:
            self._names[number] = self._add_topic(number)
        if isinstance(record, Message) and self._names[number]:
            self._file.write(
                self._names[number],
                record.data,
                record.log_time,
                record.publish_time,
                record.sequence,
            )

    def _add_topic(self, number: int) -> str:
        """Register the topic of a channel, and return its name, or '' if it is lost."""
        channel = self._survey.channels.get(number)
        schema = self._survey.schemas.get(channel.schema_id) if channel else None
        if channel is None or schema is None:
            return ''
        definition = Definition(schema.encoding, schema.data.decode(errors='replace'))
        self._file.add_topic(topic_of(channel, schema.name), definition)
        return channel.topic
