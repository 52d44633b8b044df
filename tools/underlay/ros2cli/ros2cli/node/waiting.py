# SPDX-License-Identifier: Apache-2.0
"""Spin a node while waiting."""

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
    """
    Spin a node until a condition is true.

    Parameters
    ----------
    node
        The node.
    is_true
        The condition, which is checked between callbacks.
    patience
        Reports the wait to the user; None for no report.
    timeout_s
        The timeout in s.

    Returns
    -------
    bool
        Whether it became true in time.

    """
    end = time.monotonic() + timeout_s
    while not is_true():
        if time.monotonic() > end:
            return False
        if patience:
            patience.check()
        node.spin_once(PERIOD_S)
    return True


def spin_until(node: Any, end_s: float) -> None:
    """
    Spin a node until a point in time, at least once.

    Parameters
    ----------
    node
        The node.
    end_s
        The end time, in s of the monotonic clock.

    """
    while True:
        left_s = end_s - time.monotonic()
        node.spin_once(max(0.0, left_s))
        if left_s <= 0.0:
            return
