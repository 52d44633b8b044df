# SPDX-License-Identifier: Apache-2.0
"""Recover recordings that are damaged or whose recorder was killed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
import glob
from itertools import chain, count
import os
import re
from typing import NamedTuple

from mcap.records import Channel, Message, Schema
from ros2bag.storage import BagError
from ros2bag.storage.bag_writer import RESERVE_NAME
from ros2bag.storage.damage import damage_told
from ros2bag.storage.definitions import Definition
from ros2bag.storage.description import describe_file, read_metadata, topic_of
from ros2bag.storage.mcap_file import is_being_written, McapFile
from ros2bag.storage.metadata import FILE_NAME, merged, metadata_to_text
from ros2bag.storage.salvage import Content, Salvage
from ros2bag.storage.sqlite_file import SUFFIX

__all__ = ['RecoveredFile', 'recover', 'write_metadata']

BROKEN_SUFFIX = '.broken'
NEW_SUFFIX = '.recovered'
NUMBER = re.compile(r'(\d+)')
CHUNK_BYTES = 1024 * 1024


class RecoveredFile(NamedTuple):
    """The outcome of the recovery of a file."""

    path: str
    message_count: int
    kept_path: str = ''
    damaged_parts: int = 0
    objection: str = ''

    @property
    def was_broken(self) -> bool:
        """Whether the file was rewritten; the original is at `kept_path`."""
        return bool(self.kept_path)


def recover(
    folder: str, progress: Callable[[str, float], None] = lambda path, share: None
) -> list[RecoveredFile]:
    """
    Salvage the messages of broken files, and rewrite `metadata.yaml`.

    Broken files are kept with the suffix `.broken`.

    Parameters
    ----------
    folder
        The folder of the bag.
    progress
        Called with the path of a file and the fraction (0 to 1) of it that has been read.

    Returns
    -------
    list of RecoveredFile
        The outcome of each file, in the order of their numbers.

    Raises
    ------
    BagError
        The folder has no MCAP file or an invalid one, is being recorded to, or cannot be written.

    """
    outcomes = [_recover_file(path, progress) for path in _paths(folder, ['.mcap'])]
    write_metadata(folder)
    _remove(os.path.join(folder, RESERVE_NAME))
    return outcomes


def write_metadata(folder: str) -> int:
    """
    Rewrite `metadata.yaml` from the indices of the files.

    Parameters
    ----------
    folder
        The folder of the bag.

    Returns
    -------
    int
        The number of messages in all files.

    Raises
    ------
    BagError
        The folder has no file of a recording, or a file has no index, is damaged or is being
        recorded to.

    """
    metadata = merged([describe_file(path) for path in _paths(folder, ['.mcap', SUFFIX])])
    metadata = replace(metadata, custom_data=_custom_data(folder))
    path = os.path.join(folder, FILE_NAME)
    new_path = f'{path}{NEW_SUFFIX}'
    with open(new_path, 'w', encoding='utf-8') as stream:
        stream.write(metadata_to_text(metadata))
    os.replace(new_path, path)
    return metadata.span.message_count


def _custom_data(folder: str) -> Mapping[str, str]:
    """Return the custom data of `metadata.yaml`, if it can be read."""
    try:
        return read_metadata(folder).custom_data
    except BagError:
        return {}


def _paths(folder: str, suffixes: Sequence[str]) -> list[str]:
    """Return the files in the order of their numbers; raise BagError if there is nothing to do."""
    if not os.path.isdir(folder):
        raise BagError(f"'{folder}' is not a folder: name the folder of a recording")
    start = os.path.join(glob.escape(folder), '*')
    paths = [path for suffix in suffixes for path in glob.glob(start + suffix)]
    if not paths:
        wanted = ' or '.join(suffixes)
        raise BagError(f"'{folder}' has no {wanted} file: is it the folder of a recording?")
    for path in paths:
        if not path.endswith(SUFFIX) and is_being_written(path):
            raise BagError(f"'{path}' is still being recorded: end the recording first")
    return sorted(paths, key=_numbers_in)


def _numbers_in(path: str) -> list[tuple[int, str]]:
    """Return a natural sort key, which sorts 2 before 10."""
    parts = NUMBER.split(os.path.basename(path))
    return [(int(part), '') if part.isdigit() else (0, part) for part in parts]


def _recover_file(path: str, progress: Callable[[str, float], None]) -> RecoveredFile:
    def tell(share: float) -> None:
        progress(path, share)

    survey = Survey(path, tell)
    if survey.is_whole:
        return RecoveredFile(path, survey.message_count)
    new_path = f'{path}{NEW_SUFFIX}'
    _remove(new_path)
    try:
        count = copy_messages(path, survey, new_path, tell)
    except OSError as error:
        _remove(new_path)
        raise BagError(
            f"'{new_path}' cannot be written: {error.strerror}. The recording is unchanged"
        ) from error
    kept_path = _free_path(f'{path}{BROKEN_SUFFIX}')
    os.replace(path, kept_path)
    os.replace(new_path, path)
    return RecoveredFile(path, count, kept_path, survey.damaged_parts, survey.objection)


def _remove(path: str) -> None:
    if os.path.exists(path):
        os.unlink(path)


def _free_path(path: str) -> str:
    """Return a path that does not exist yet."""
    numbered = (f'{path}{number}' for number in count(2))
    return next(each for each in chain([path], numbered) if not os.path.exists(each))


class Survey:
    """
    Content summary of an MCAP file, read once from start to end, and whether it is intact.

    Parameters
    ----------
    path
        The file.
    progress
        Called with the fraction (0 to 1) of the file that has been read.

    Attributes
    ----------
    schemas, channels
        By their IDs; the first record with an ID counts.
    message_count
        The number of readable messages.
    compression
        The compression of the chunks: `none`, `lz4` or `zstd`.
    damaged_parts, objection
        As in `Salvage`.
    is_whole
        Whether nothing is damaged, and the index counts the same messages.

    Raises
    ------
    BagError
        The file is missing, unreadable or not MCAP.

    """

    def __init__(self, path: str, progress: Callable[[float], None]) -> None:
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}
        self.message_count = 0
        salvage = Salvage(path)
        with damage_told(path):
            for record in salvage.records(progress):
                self._note(record)
        self.compression = salvage.compression or 'none'
        self.damaged_parts = salvage.damaged_parts
        self.objection = salvage.objection
        self.is_whole = salvage.is_sound and self.message_count == _counted(path)

    def _note(self, record: Content) -> None:
        if isinstance(record, Message):
            self.message_count += 1
        elif isinstance(record, Schema):
            self.schemas.setdefault(record.id, record)
        else:
            self.channels.setdefault(record.id, record)


def _counted(path: str) -> int:
    """Return the message count of the index; -1 without an index."""
    try:
        return describe_file(path).span.message_count
    except BagError:
        return -1


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
