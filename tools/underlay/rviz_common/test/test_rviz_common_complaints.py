# SPDX-License-Identifier: Apache-2.0
"""Check what the page says about the connections of browsers, and what it does not."""

from __future__ import annotations

import pytest
from rviz_common.page.complaints import LOGGER
from websockets.exceptions import ConnectionClosedError, InvalidMessage


@pytest.mark.parametrize(
    'error', [ConnectionClosedError(None, None), InvalidMessage('did not receive HTTP')]
)
def test_who_goes_is_no_fault(error: Exception, caplog: pytest.LogCaptureFixture) -> None:
    """A browser that goes without a word, or was never one, is not reported."""
    LOGGER.error('connection handler failed', exc_info=error)
    assert caplog.messages == []


def test_other_failures(caplog: pytest.LogCaptureFixture) -> None:
    """Any other failure is reported in one sentence, without a traceback."""
    LOGGER.error('connection handler failed', exc_info=RuntimeError('no more memory'))
    assert len(caplog.messages) == 1
    assert caplog.messages[0].startswith('A connection has failed: ')
    assert 'no more memory' in caplog.messages[0]
    assert caplog.records[0].exc_info is None
