# SPDX-License-Identifier: Apache-2.0
"""Recordings whose recorder was killed, and damage to every part of them."""

from __future__ import annotations

import contextlib
from pathlib import Path

from bag_samples import MS, start_bag, string, texts, topic
import pytest
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.recovery import recover

COUNT = 40
CHUNK_COUNT = 4


def unfinished_bag(
    folder: Path, monkeypatch: pytest.MonkeyPatch, compression: str = 'none'
) -> Path:
    """Leave a recording as its killed recorder does: a file without an end, and the reserve."""
    monkeypatch.setattr('ros2bag.storage.mcap_file.CHUNK_TIME_S', 0.0)
    writer = start_bag(folder, topic('/ticks'), compression=compression)
    for number in range(COUNT):
        writer.write(string('/ticks', str(number), number * MS))
        if number % CHUNK_COUNT == CHUNK_COUNT - 1:
            writer.flush_if_due()
    writer._file.close()
    monkeypatch.undo()
    return folder / f'{folder.name}_0.mcap'


def damage_everywhere(
    folder: Path, monkeypatch: pytest.MonkeyPatch, size: int, compression: str, step: int
) -> None:
    """Damage a recording from each `step`th byte on; assert what is read and what is saved."""
    path = unfinished_bag(folder, monkeypatch, compression=compression)
    monkeypatch.setattr('ros2bag.storage.recovery.CHUNK_BYTES', 150)
    recover(str(path.parent))
    content = path.read_bytes()
    (path.parent / 'metadata.yaml').unlink()
    wanted = [str(number) for number in range(COUNT)]
    for offset in range(3, len(content), step):
        damaged = bytearray(content)
        for place in range(offset, min(offset + size, len(content))):
            damaged[place] ^= 0x15
        path.write_bytes(damaged)
        with contextlib.suppress(BagError):
            assert texts(BagReader(str(path)).messages(), '/ticks') == wanted
        (outcome,) = recover(str(path.parent))
        saved = texts(BagReader(str(path.parent)).messages(), '/ticks')
        assert len(saved) >= COUNT - CHUNK_COUNT, (offset, outcome)
        assert saved == [text for text in wanted if text in saved]
