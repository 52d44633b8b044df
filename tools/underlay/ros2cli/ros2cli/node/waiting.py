# SPDX-License-Identifier: Apache-2.0
"""Wait for something in the graph."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from ros2cli.patience import Patience

PERIOD_S = 0.05


def wait_until(
    node: Any,
    is_true: Callable[[], object],
    patience: Patience | None,
    timeout_s: float = float('inf'),
) -> bool:
    """Spin until something is true or the time is over, with or without a word about it."""
    end = time.monotonic() + timeout_s
    while not is_true():
        if time.monotonic() > end:
            return False
        if patience:
            patience.check()
        node.spin_once(PERIOD_S)
    return True


def spin_until(node: Any, end_s: float) -> None:
    """Do the work that is due until a moment of the monotonic clock; look at it at least once."""
    while True:
        left_s = end_s - time.monotonic()
        node.spin_once(max(0.0, left_s))
        if left_s <= 0.0:
            return
