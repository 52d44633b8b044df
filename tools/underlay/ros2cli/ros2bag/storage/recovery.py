# SPDX-License-Identifier: Apache-2.0
"""Recovery of recordings that are damaged or whose recorder was killed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
import glob
from itertools import chain, count
import os
import re
from typing import NamedTuple

from ros2bag.storage.bag_reader import read_metadata
from ros2bag.storage.copying import copy_messages
from ros2bag.storage.errors import BagError
from ros2bag.storage.mcap_summary import describe_file
from ros2bag.storage.metadata_yaml import FILE_NAME, metadata_to_text
from ros2bag.storage.patient_file import is_being_written
from ros2bag.storage.reserve import FILE_NAME as RESERVE_NAME
from ros2bag.storage.summary import merged
from ros2bag.storage.survey import Survey

__all__ = ['RecoveredFile', 'recover', 'write_metadata']

BROKEN_SUFFIX = '.broken'
NEW_SUFFIX = '.recovered'
NUMBER = re.compile(r'(\d+)')


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
    outcomes = [_recover_file(path, progress) for path in _paths(folder)]
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
        The folder has no MCAP file, or a file has no index, is damaged or is being recorded to.

    """
    metadata = merged([describe_file(path) for path in _paths(folder)])
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


def _paths(folder: str) -> list[str]:
    """Return the files in the order of their numbers; raise BagError if there is nothing to do."""
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
            f"'{new_path}' cannot be written: {error.strerror}. The recording is as it was"
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
