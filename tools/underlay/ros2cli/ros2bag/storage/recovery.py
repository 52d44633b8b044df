# SPDX-License-Identifier: Apache-2.0
"""Make a recording readable again whose recorder was killed, or which is damaged."""

from __future__ import annotations

from collections.abc import Callable
import glob
import os
import re
from typing import NamedTuple

from mcap.records import Channel, Message, Schema
from ros2bag.storage.definitions import Definition
from ros2bag.storage.errors import BagError
from ros2bag.storage.mcap_file import McapFile
from ros2bag.storage.mcap_summary import BrokenFile, describe_file, topic_of
from ros2bag.storage.metadata_yaml import FILE_NAME, metadata_to_text
from ros2bag.storage.patient_file import is_being_written
from ros2bag.storage.reserve import FILE_NAME as RESERVE_NAME
from ros2bag.storage.salvage import Salvage
from ros2bag.storage.summary import merged

__all__ = ['RecoveredFile', 'recover', 'write_metadata']

BROKEN_SUFFIX = '.broken'
NEW_SUFFIX = '.recovered'
CHUNK_BYTES = 1024 * 1024
NUMBER = re.compile(r'(\d+)')


class RecoveredFile(NamedTuple):
    """What was done with a file of the recording."""

    path: str
    message_count: int
    was_broken: bool
    damaged_chunks: int = 0


def recover(
    folder: str, progress: Callable[[str, float], None] = lambda path, share: None
) -> list[RecoveredFile]:
    """Save what broken files have, and write `metadata.yaml`; the broken files are kept."""
    outcomes = [_recover_file(path, progress) for path in _paths(folder)]
    write_metadata(folder)
    reserve = os.path.join(folder, RESERVE_NAME)
    if os.path.exists(reserve):
        os.unlink(reserve)
    return outcomes


def write_metadata(folder: str) -> int:
    """Write `metadata.yaml` as the files say, and return the number of their messages."""
    metadata = merged([describe_file(path) for path in _paths(folder)])
    path = os.path.join(folder, FILE_NAME)
    new_path = f'{path}{NEW_SUFFIX}'
    with open(new_path, 'w', encoding='utf-8') as stream:
        stream.write(metadata_to_text(metadata))
    os.replace(new_path, path)
    return metadata.span.message_count


def _paths(folder: str) -> list[str]:
    """Return the files in the order of their numbers; BagError if there is nothing to do."""
    if not os.path.isdir(folder):
        raise BagError(f"'{folder}' is not a folder: name the folder of a recording")
    paths = glob.glob(os.path.join(glob.escape(folder), '*.mcap'))
    if not paths:
        raise BagError(f"'{folder}' has no .mcap file: is it the folder of a recording?")
    for path in paths:
        if is_being_written(path):
            raise BagError(f"'{path}' is still being recorded: end the recording first")
    return sorted(paths, key=_numbers_in)


def _numbers_in(path: str) -> list[tuple[int, str]]:
    """Return a key that sorts 2 before 10."""
    parts = NUMBER.split(os.path.basename(path))
    return [(int(part), '') if part.isdigit() else (0, part) for part in parts]


def _recover_file(path: str, progress: Callable[[str, float], None]) -> RecoveredFile:
    try:
        return RecoveredFile(path, describe_file(path).span.message_count, was_broken=False)
    except BrokenFile:
        return _rewrite(path, progress)


def _rewrite(path: str, progress: Callable[[str, float], None]) -> RecoveredFile:
    new_path = f'{path}{NEW_SUFFIX}'
    if os.path.exists(new_path):
        os.unlink(new_path)
    salvage = Salvage(path)
    try:
        count = _copy(salvage, new_path, os.path.basename(path), lambda s: progress(path, s))
    except OSError as error:
        if os.path.exists(new_path):
            os.unlink(new_path)
        raise BagError(
            f"'{new_path}' cannot be written: {error.strerror}. The recording is as it was"
        ) from error
    os.replace(path, f'{path}{BROKEN_SUFFIX}')
    os.replace(new_path, path)
    return RecoveredFile(path, count, was_broken=True, damaged_chunks=salvage.damaged_chunks)


def _copy(salvage: Salvage, path: str, name: str, progress: Callable[[float], None]) -> int:
    """Write what a file has to a new one, and return the number of messages."""
    copier: _Copier | None = None
    for record in salvage.records(progress):
        copier = copier or _Copier(path, name, salvage.compression or 'none')
        copier.add(record)
    copier = copier or _Copier(path, name, 'none')
    try:
        copier.file.finish()
    finally:
        copier.file.close()
    return copier.file.message_count


class _Copier:
    """Writes records of one file to another."""

    def __init__(self, path: str, name: str, compression: str) -> None:
        self.file = McapFile(path, name=name, compression=compression, chunk_bytes=CHUNK_BYTES)
        self._schemas: dict[int, Schema] = {}
        self._names: dict[int, str] = {}

    def add(self, record: Schema | Channel | Message) -> None:
        """Write a record; what belongs to a lost schema or channel is lost too."""
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            self._add_channel(record)
        elif record.channel_id in self._names:
            name = self._names[record.channel_id]
            self.file.write(
                name, record.data, record.log_time, record.publish_time, record.sequence
            )

    def _add_channel(self, channel: Channel) -> None:
        schema = self._schemas.get(channel.schema_id)
        if schema is not None and channel.id not in self._names:
            self._names[channel.id] = channel.topic
            definition = Definition(schema.encoding, schema.data.decode(errors='replace'))
            self.file.add_topic(topic_of(channel, schema.name), definition)
