# SPDX-License-Identifier: Apache-2.0
"""Print a report about a topic once a second."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from ros2cli.patience import Patience

PERIOD_S = 1.0


def report_for_ever(node: Any, topic: str, report: Callable[[], str]) -> None:
    """Print what `report()` returns, if anything; say so when there is nothing for long."""
    patience = Patience(f"messages on '{topic}'")
    while True:
        _collect(node)
        text = report()
        if text:
            print(text)
        else:
            patience.check()


def _collect(node: Any) -> None:
    end = time.monotonic() + PERIOD_S
    while time.monotonic() < end:
        node.spin_once(max(0.0, end - time.monotonic()))
