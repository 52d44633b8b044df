# SPDX-License-Identifier: Apache-2.0
"""Check what happens when no process can be started."""

from __future__ import annotations

import errno
import logging
import os

from humanoid_simulation.camera.process_keeper import Patience, ProcessKeeper
from humanoid_simulation.camera.render_process import RenderProcess
import pytest


def test_no_room_for_a_process(caplog: pytest.LogCaptureFixture) -> None:
    """A computer that cannot start processes has no cameras, which is said once."""
    tried: list[str] = []

    def refuse(method: str) -> RenderProcess:
        tried.append(method)
        raise OSError(errno.ENOMEM, os.strerror(errno.ENOMEM))

    keeper = ProcessKeeper(refuse, ['egl', 'rays'], logging.getLogger('keeper'), Patience())
    for _ in range(5):
        keeper.tend(0.0)
    assert tried == ['egl', 'rays'] and not keeper.can_draw
    (said,) = caplog.messages
    assert 'cameras are off' in said and 'Cannot allocate memory' in said
    keeper.close()
