# SPDX-License-Identifier: Apache-2.0
"""Send files that are too large, too many, or not what was announced."""

from __future__ import annotations

import gc
import os
import resource
import threading
import time
from typing import Any

import msgspec
import pytest
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.page.message_filter import LARGEST_UPLOAD_BYTES, MOST_AT_ONCE, MOST_PARTS, Uploads
import viser
from viser._messages import FileTransferPart, FileTransferStartUpload
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol
import zstandard

MEGA = 1_000_000
PART = 500_000
OWNER = object()
CAMERA: dict[str, Any] = {
    'type': 'ViewerCameraMessage',
    'wxyz': [1, 0, 0, 0],
    'position': [3, 0, 1.5],
    'fov': 0.8,
    'near': 0.01,
    'far': 1000,
    'image_height': 600,
    'image_width': 800.0,
    'look_at': [0, 0, 0],
    'up_direction': [0, 0, 1],
}


def start(transfer: str, size: int, parts: int) -> FileTransferStartUpload:
    """Return the announcement of a file."""
    return FileTransferStartUpload('button', transfer, 'x.rviz', 'text/plain', parts, size)


def part(transfer: str, index: int, content: bytes) -> FileTransferPart:
    """Return a part of a file."""
    return FileTransferPart('button', transfer, index, content)


@pytest.fixture
def refused() -> list[str]:
    """Return the list of what was refused."""
    return []


@pytest.fixture
def uploads(refused: list[str]) -> Uploads:
    """Return a limit that keeps what it refuses."""
    uploads = Uploads()
    uploads.on_refusal = lambda start, sentence: refused.append(sentence)
    return uploads


def test_a_file_passes(uploads: Uploads, refused: list[str]) -> None:
    """A file passes in any order of its parts, each once, and then another one."""
    for transfer in ('a', 'b'):
        assert uploads.admits(start(transfer, 6, 2), OWNER)
        assert uploads.admits(part(transfer, 1, b'def'), OWNER)
        assert not uploads.admits(part(transfer, 1, b'def'), OWNER)
        assert uploads.admits(part(transfer, 0, b'abc'), OWNER)
        assert not uploads.admits(part(transfer, 0, b'abc'), OWNER)
    assert uploads.admits(start('empty', 0, 0), OWNER)
    assert uploads.admits('another message', OWNER)
    assert refused == []


@pytest.mark.parametrize(
    ('size', 'parts', 'reason'),
    [
        (LARGEST_UPLOAD_BYTES + 1, 1, 'The file has 10.0 MB, but the limit'),
        (10**12, 2, 'The file has 1000000.0 MB'),
        (-1, 1, 'is not valid'),
        (10, -1, 'is not valid'),
        (10, MOST_PARTS + 1, 'is not valid'),
    ],
)
def test_what_is_refused(
    uploads: Uploads, refused: list[str], size: int, parts: int, reason: str
) -> None:
    """A file that is too large is refused with a sentence, and its parts are dropped."""
    assert not uploads.admits(start('a', size, parts), OWNER)
    assert not uploads.admits(part('a', 0, b'abc'), OWNER)
    assert len(refused) == 1 and reason in refused[0]


def test_more_than_announced(uploads: Uploads) -> None:
    """What is beyond the announced size is dropped, and so is what was never announced."""
    assert uploads.admits(start('a', 5, 3), OWNER)
    assert uploads.admits(part('a', 0, b'abc'), OWNER)
    assert not uploads.admits(part('a', 1, b'def'), OWNER)
    assert not uploads.admits(part('a', 7, b''), OWNER)
    assert not uploads.admits(part('b', 0, b''), OWNER)


def test_few_at_a_time(uploads: Uploads, refused: list[str]) -> None:
    """Each page sends one file at a time, and all together few; who leaves makes room."""
    owners = [object() for _ in range(MOST_AT_ONCE)]
    for owner in owners:
        assert uploads.admits(start(str(id(owner)), 5, 1), owner)
        assert not uploads.admits(start('second', 5, 1), owner)
    assert not uploads.admits(start('late', 5, 1), OWNER)
    assert 'already uploading a file' in refused[0] and 'Try again' in refused[-1]
    assert not uploads.admits(part(str(id(owners[0])), 0, b'a'), owners[1])
    uploads.leave(owners[0])
    assert uploads.admits(start('late', 5, 1), OWNER)


def test_memory_stays_flat() -> None:
    """A browser that sends hundreds of megabytes costs the page next to nothing."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        button = page.viser.gui.add_upload_button('Load')
        refusals: list[str] = []
        page.uploads.on_refusal = lambda start, sentence: refusals.append(sentence)
        protocol = Subprotocol(f'viser-v{viser.__version__}')
        url = f'ws://127.0.0.1:{page.port}'
        with connect(url, subprotocols=[protocol], compression=None) as browser:
            browser.send(msgspec.msgpack.encode(CAMERA))
            flood(browser, button._impl.uuid, 20 * MEGA)  # so that buffers have their size
            before = peak_bytes()
            for _ in range(3):
                flood(browser, button._impl.uuid, 100 * MEGA)
            answered = threading.Event()
            box = page.viser.gui.add_number('n', 1.0)
            box.on_update(lambda event: answered.set())
            update = {'type': 'GuiUpdateMessage', 'uuid': box._impl.uuid, 'updates': {'value': 2}}
            browser.send(msgspec.msgpack.encode(update))
            assert answered.wait(60.0), 'the page answers no longer'
            assert peak_bytes() - before < 50 * MEGA
        assert len(refusals) == 4


def test_a_refused_file_is_not_called_uploaded() -> None:
    """A browser waits no longer for a file that was refused, and shows it as nothing."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        button = page.viser.gui.add_upload_button('Load')
        page.uploads.on_refusal = lambda start, sentence: page.end_upload(start)
        protocol = Subprotocol(f'viser-v{viser.__version__}')
        url = f'ws://127.0.0.1:{page.port}'
        with connect(url, subprotocols=[protocol], compression=None) as browser:
            browser.send(msgspec.msgpack.encode(CAMERA))
            end_s = time.monotonic() + 100.0
            while not page.viser.get_clients():
                assert time.monotonic() < end_s, 'nobody has come'
                time.sleep(0.01)
            flood(browser, button._impl.uuid, 20 * MEGA)
            received = b''
            while b'RemoveNotificationMessage' not in received:
                frame = browser.recv(timeout=100)
                assert isinstance(frame, bytes)
                end = 16 + int.from_bytes(frame[8:16], 'little')
                received += zstandard.decompress(frame[16:end])
    assert b'FileTransferPartAck' in received


def flood(browser: ClientConnection, button: str, size: int) -> None:
    """Send a file of a size in parts, as browsers do without waiting."""
    transfer = os.urandom(8).hex()
    count = size // PART
    common: dict[str, Any] = {'source_component_uuid': button, 'transfer_uuid': transfer}
    announced = {'filename': '../../x.rviz', 'mime_type': '', 'size_bytes': size}
    message = {'type': 'FileTransferStartUpload', 'part_count': count, **announced, **common}
    browser.send(msgspec.msgpack.encode(message))
    for index in range(count):
        piece = {'type': 'FileTransferPart', 'part_index': index, 'content': bytes(PART)}
        browser.send(msgspec.msgpack.encode({**piece, **common}))


def peak_bytes() -> int:
    """Return the most memory that this process has had."""
    gc.collect()
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
