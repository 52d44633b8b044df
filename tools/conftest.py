# SPDX-License-Identifier: Apache-2.0
"""
What all tests of tools/ need: that Ctrl-C works in the processes which they start.

A shell that starts the tests in the background lets them ignore it, and all that they start.
"""

from collections.abc import Iterator
import gc
import signal

import pytest

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def linters_collect_no_nodes(request: pytest.FixtureRequest) -> Iterator[None]:
    """Keep forked linters from ending what earlier tests left of rclpy: that ends in a crash."""
    if not request.path.name.endswith('_style.py'):
        yield
        return
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()
